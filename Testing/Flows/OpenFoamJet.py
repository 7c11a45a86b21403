# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Ladenburg's jet as OpenFOAM wrote it, p and T in the cells of a wedge: fringes of the full jet."""

import os

import numpy as np
from flow_testing import (DATA, EVERY_VOXEL, RefractiveIndex, Schlieren, check_baseline,
                          coordinates, one_dataset, image_array)
from paraview.simple import AngularPeriodicFilter, Calculator, OpenFOAMReader
from vtkmodules.util.numpy_support import vtk_to_numpy

K = 2.26e-4            # m^3/kg
WAVELENGTH = 546.1e-9  # m
AMBIENT = 1.184        # kg/m^3

case = OpenFOAMReader(FileName=os.path.join(DATA, "ladenburg_openfoam", "ladenburg.foam"))
case.MeshRegions = ["internalMesh"]
case.CellArrays = ["p", "T"]
case.UpdatePipeline(4.5e-4)
wedge = Calculator(case, AttributeType="Cell Data", ResultArrayName="rho",
                   Function="p/(287.1*T)")
wedge.UpdatePipeline()
# 72 wedges of 5 degrees about the x axis. (Rotated points as a view, the default, take longer.)
jet = AngularPeriodicFilter(wedge, RotationAngle=5, IterationMode="Maximum", Axis="Axis X",
                            ComputeRotationsOnTheFly=0)
jet.UpdatePipeline()

# Pixels 0.125 mm apart as the solver's cells are, their centres on the cells' centres along x.
schlieren = Schlieren(jet, Density=["CELLS", "rho"], GladstoneDaleConstant=K,
                      AmbientRefractivity=K * AMBIENT,
                      **EVERY_VOXEL, Outside="Passes", ImageSize=[240, 161], ParallelScale=0.125e-3 * 161 / 2)
x, y = coordinates(schlieren)
fringes = image_array(schlieren, "OpticalPathDifference") / WAVELENGTH
axis = len(y) // 2
assert abs(y[axis]) < 1e-9 and np.allclose(x, (np.arange(240) + 0.5) * 0.125e-3, atol=1e-8)

# The solver's own cells, summed along the radius: cell j reaches from j h to (j + 1) h.
cells = vtk_to_numpy(one_dataset(wedge).GetCellData().GetArray("rho")).astype(float)
solved = cells.reshape(2, 40, 240).reshape(80, 240)  # two blocks, the inner one first
straight = 2 * 0.125e-3 * K * (solved - AMBIENT).sum(axis=0) / WAVELENGTH
difference = np.abs(fringes[axis] - straight)[2:-2]
print(f"On the axis against sums of the cells: rms {np.sqrt(np.mean(difference**2)):.3f}, largest "
      f"{difference.max():.3f} of {straight.max():.2f} fringes")
assert np.sqrt(np.mean(difference**2)) < 0.01 * np.abs(straight).max()

# The fringe shifts that belong to this flow, of which two digits are known: within 1 % beyond that.
for place, expected in ((1, 8.65), (5, 2.45), (10, -0.34), (15, 3.13), (18, 4.85)):
    column = np.searchsorted(x, place * 1e-3 - 1e-9)
    shift = fringes[axis, column]
    print(f"x = {x[column] * 1e3:.4f} mm: {shift:.3f} fringes, expected {expected}; "
          f"the cells: {straight[column]:.3f}")
    assert abs(shift - expected) < 0.01 * abs(expected) + 0.005

# Off the axis: chords through shells of the solver's cells.
edges = 0.125e-3 * np.arange(81)
chords = np.sqrt(np.clip(edges**2 - y[:, None]**2, 0, None))
straight = 2 * np.diff(chords, axis=1) @ (K * (solved - AMBIENT)) / WAVELENGTH
difference = fringes - straight
print(f"Everywhere: rms {np.sqrt(np.mean(difference**2)):.3f} fringes")
assert np.sqrt(np.mean(difference**2)) < 0.005 * straight.max()

# The wedge's p and T through Ciddor's equations. Air of 15 C and 101325 Pa has N = 2.7789e-4 at
# 546.1 nm (Edlen 1966, Metrologia 2, 71); p / T of an ideal gas scales it, and how far air is from
# one, 0.2 % here, is what the two may differ.
moist = RefractiveIndex(wedge, IndexModel="Ciddor", Temperature=["CELLS", "T"],
                        Pressure=["CELLS", "p"], Wavelength=546.1)
plain = RefractiveIndex(wedge, Density=["CELLS", "rho"],
                        GladstoneDaleConstant=2.7789e-4 * 288.15 / 101325 * 287.1)
N, expected = (vtk_to_numpy(one_dataset(proxy).GetCellData().GetArray("Refractivity")).astype(float)
               for proxy in (moist, plain))
ratio = N / expected
print(f"Ciddor's N: {ratio.min():.5f} to {ratio.max():.5f} of the scaled one")
assert ratio.size == 80 * 240 and np.abs(ratio - 1).max() < 2e-3

schlieren.KnifeEdgeAngle = 90
check_baseline(schlieren, "OpenFoamJet")
