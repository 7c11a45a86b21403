# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The jet in numbers, through the filter as a script uses it: deflections and fringes."""

import os

import numpy as np
from paraview import servermanager
from paraview.simple import LoadPlugin, OpenDataFile
from vtkmodules.util.numpy_support import vtk_to_numpy

LoadPlugin(os.environ["SCHLIEREN_PLUGIN"], remote=False, ns=globals())

K = 2.26e-4          # m^3/kg
WAVELENGTH = 546.1e-9  # m
AMBIENT = 1.184      # kg/m^3

jet = OpenDataFile(os.path.join(os.environ["SCHLIEREN_SOURCE_DIR"], "Testing", "Data",
                                "ladenburg_jet_3d.vti"))
jet.UpdatePipeline()
# One ray through each column of the grid, in its middle: 240 x 129, 0.125 mm apart.
width, height = 240, 129
schlieren = Schlieren(Input=jet, Density=["POINTS", "rho"], GladstoneDaleConstant=K,  # noqa: F821
                      AmbientRefractivity=K * AMBIENT,
                      StepSize=1, HomogeneityTolerance=0, SamplesPerPixel=1,
                      ImageSize=[width, height], ParallelScale=0.125e-3 * height / 2)
schlieren.UpdatePipeline()
image = servermanager.Fetch(schlieren)


def rows(name):
    return vtk_to_numpy(image.GetPointData().GetArray(name)).reshape(height, width, -1)


x = image.GetOrigin()[0] + image.GetSpacing()[0] * np.arange(width)
assert abs(x[0] - 6.25e-5) < 1e-9 and abs(x[-1] - 0.0299375) < 1e-9, (x[0], x[-1])
axis = height // 2
fringes = rows("OpticalPathDifference")[..., 0] / WAVELENGTH
deflection = rows("Deflection")

# Straight sums through the same data, by the trapezoidal rule.
density = vtk_to_numpy(servermanager.Fetch(jet).GetPointData().GetArray("rho"))
excess = K * (density.reshape(129, 129, 240).astype(float) - AMBIENT)
excess[[0, -1]] /= 2
straight = excess.sum(axis=0) * 0.125e-3 / WAVELENGTH
difference = np.abs(fringes - straight)[1:-1, 1:-1]  # on the very edge light may leave sideways
print(f"Fringes against straight sums: rms {np.sqrt(np.mean(difference ** 2)):.4f}, "
      f"largest {difference.max():.4f}, of {np.abs(straight).max():.2f}")
assert np.sqrt(np.mean(difference ** 2)) < 0.02

# The fringe shifts that belong to this flow, at the sample just behind each whole millimetre.
for place, expected in ((1, 8.65), (5, 2.45), (10, -0.34), (15, 3.13), (18, 4.85)):
    column = np.searchsorted(x, place * 1e-3)
    shift = fringes[axis, column]
    print(f"x = {x[column] * 1e3:.4f} mm: {shift:.3f} fringes, expected {expected}")
    assert abs(shift - expected) < 0.02

# On the axis the strongest deflection is the Mach disc's, towards the dense side: downstream.
strongest = np.abs(deflection[axis, :, 0]).argmax()
print(f"Mach disc at {x[strongest] * 1e3:.3f} mm, deflection {deflection[axis, strongest, 0]:.2e}")
assert abs(x[strongest] - 0.01375) < 0.0004
assert deflection[axis, strongest, 0] > 0

# Above and below the axis the deflection along v is opposite; on it there is none.
v = deflection[..., 1]
scale = np.abs(v).max()
assert np.abs(v + v[::-1]).max() < 0.01 * scale, np.abs(v + v[::-1]).max() / scale
assert np.abs(v[axis]).max() < 0.01 * scale
# The jet is denser than the air around it: light bends down at its upper edge.
assert v[(np.arange(height) - axis) * 0.125e-3 > 0.0055][:, 40:120].mean() < 0
