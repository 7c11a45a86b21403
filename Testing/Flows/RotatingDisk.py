# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""A hot disk turning in a reactor, hexahedra with four species (Exodus): a mixture of gases."""

import os

import numpy as np
from flow_testing import (DATA, EVERY_VOXEL, Schlieren, check_baseline, coordinates, one_dataset,
                          image_array, sums_along)
from paraview.simple import Calculator, Cylinder, ExodusIIReader, Transform
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy

# Molar mass, kg/mol, and Gladstone-Dale constant, m^3/kg: see Documentation/density.md.
SPECIES = {"AsH3": (77.9454e-3, 2.53e-4), "CH4": (16.0425e-3, 6.15e-4),
           "GaMe3": (114.827e-3, 3.3e-4), "H2": (2.01588e-3, 1.54e-3)}
PRESSURE = 101325  # Pa, assumed

reactor = ExodusIIReader(FileName=[os.path.join(DATA, "disk_exodus", "disk_out_ref.ex2")])
reactor.PointVariables = ["Temp", *SPECIES]
reactor.UpdatePipeline()
moles = " + ".join(f"{name}/{mass}" for name, (mass, _) in SPECIES.items())  # in a kilogram
gas = Calculator(reactor, ResultArrayName="rho",
                 Function=f"{PRESSURE} / (8.314463 * Temp * ({moles}))")
gas.UpdatePipeline()

# Molar refractivities: what the mixture's N is without ever using its density.
data = one_dataset(gas)
arrays = {name: vtk_to_numpy(data.GetPointData().GetArray(name)).astype(float)
          for name in ("Temp", "rho", *SPECIES)}
amounts = {name: arrays[name] / mass for name, (mass, _) in SPECIES.items()}
whole = sum(amounts.values())
expected = sum(PRESSURE / (8.314463 * arrays["Temp"]) * amounts[name] / whole * mass * constant
               for name, (mass, constant) in SPECIES.items())
ambient = expected[arrays["Temp"] == arrays["Temp"].min()].mean()
print(f"n - 1 = {expected.min():.3e} to {expected.max():.3e}, {ambient:.3e} at the cold wall")

# The hot disk and what carries it, which the mesh leaves out: radius 3.81, from z = -10 up to 0.
disk = Transform(Cylinder(Radius=3.81, Height=10, Resolution=72))
disk.Transform.Rotate = [90, 0, 0]
disk.Transform.Translate = [0, 0, -5]
disk.UpdatePipeline()
assert np.allclose(disk.GetDataInformation().GetBounds()[4:], (-10, 0))

schlieren = Schlieren(Input=gas, Bodies=disk, IndexModel="Gladstone-Dale Mixture", Density=["POINTS", "rho"],
                      MixtureArrays=["AsH3", "CH4", "GaMe3"],
                      MixtureGases=[str(SPECIES[name][1]) for name in ("AsH3", "CH4", "GaMe3")],
                      BackgroundGas=str(SPECIES["H2"][1]), LengthScale=0.01,
                      Outside="Passes", AmbientRefractivity=ambient,
                      **EVERY_VOXEL, ImageSize=[160, 280], ViewDirection=[0, 1, 0],
                      ViewUp=[0, 0, 1])
x, z = coordinates(schlieren)
path = image_array(schlieren, "OpticalPathDifference") / 0.01
deflection = image_array(schlieren, "Deflection")
blocked = image_array(schlieren, "BlockedFraction")

# Sums along rays that VTK takes through the cells.
array = numpy_to_vtk(expected, deep=True)
array.SetName("N")
data.GetPointData().AddArray(array)
rows, columns = [index.ravel() for index in np.mgrid[4:280:6, 5:160:6]]
seen = (z[rows] > 0.3) & (abs(x[columns]) < 5)
rows, columns = rows[seen], columns[seen]
begin = np.stack([x[columns], np.full(rows.size, -5.75), z[rows]], axis=1)
total, length = sums_along(data, "N", begin, begin * [1, -1, 1], 301)
error = (path[rows, columns] - total + ambient * length) / -path.min()
rms, largest = np.sqrt(np.mean(error**2)), np.abs(error).max()
print(f"Optical paths against sums through the cells: rms {rms:.2%}, largest {largest:.2%}")
assert rms < 0.006 and largest < 0.025

# The disk blocks the light, all else lets it pass.
inside = np.ix_(z < -0.2, abs(x) < 3.6)
outside = np.ix_(z > 0.2, abs(x) < 6)
assert blocked[inside].min() == 1 and blocked[outside].max() == 0
# Above the hot disk light bends upwards, to the cold gas; left and right of it away from it.
u, v = deflection[..., 0], deflection[..., 1]
assert v[np.ix_((z > 0.3) & (z < 3), abs(x) < 3)].min() > 0
assert np.abs(u + u[:, ::-1]).max() < 0.02 * np.abs(u).max()
assert u[np.ix_((z > 0.3) & (z < 1), (x > 3.5) & (x < 5))].min() > 0

# The faint stripes are the mesh's cells, within which the gas is linear.
check_baseline(schlieren, "RotatingDisk")
