# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""An oblique shock of Mach 2.9 and its reflection (VTI): angles and densities that theory gives."""

import os

import numpy as np
from flow_testing import DATA, EVERY_VOXEL, Schlieren, check_baseline, coordinates, output, image_array
from paraview.simple import XMLImageDataReader
from vtkmodules.util.numpy_support import vtk_to_numpy

K = 2.26e-4
DENSITY = 1.225 / 1.4  # kg/m^3 for 1: air of the standard atmosphere ahead of the shock
GAMMA = 1.4

flow = XMLImageDataReader(FileName=[os.path.join(DATA, "oblique_shock_extruded.vti")])
flow.UpdatePipeline()
schlieren = Schlieren(flow, Density=["POINTS", "rho"], GladstoneDaleConstant=K,
                      DensityScale=DENSITY, LengthScale=0.1, AmbientRefractivity=K * DENSITY * 1.4, **EVERY_VOXEL,
                      ImageSize=[656, 160], FocalPoint=[2.05, 0.5, 0.5], ParallelScale=0.5)
x, y = coordinates(schlieren)
path = image_array(schlieren, "OpticalPathDifference")
deflection = image_array(schlieren, "Deflection")[..., :2]


def angle(ratio, mach):
    """Of a shock to the oncoming flow, from the ratio of the densities (Rankine-Hugoniot)."""
    normal = 2 * ratio / (GAMMA + 1 - ratio * (GAMMA - 1))
    return np.degrees(np.arcsin(np.sqrt(normal) / mach)), normal


# Behind the first shock the flow is turned down to the wall, behind the second along it again.
first, normal = angle(2.380 / 1.4, 2.9)
turn = np.degrees(np.arctan(2 / np.tan(np.radians(first)) * (normal - 1)
                            / (2.9**2 * (GAMMA + np.cos(np.radians(2 * first))) + 2)))
behind = np.sqrt((1 + (GAMMA - 1) / 2 * normal) / (GAMMA * normal - (GAMMA - 1) / 2)) / np.sin(
    np.radians(first - turn))
second = angle(3.762 / 2.380, behind)[0] - turn
print(f"In theory: {first:.2f} and {second:.2f} degrees to the wall, turned by {turn:.2f}")
assert abs(turn - 10.94) < 0.05



def solved(level):
    """The angle of a contour of the data's density to the wall."""
    image = output(flow)
    columns, lines, _ = image.GetDimensions()
    rho = vtk_to_numpy(image.GetPointData().GetArray("rho"))[:columns * lines]
    rho = rho.reshape(lines, columns)[12:31]
    after = (rho > level).argmax(axis=1)
    before = rho[np.arange(19), after - 1]
    fraction = (level - before) / (rho[np.arange(19), after] - before)
    return np.degrees(np.arctan(np.polyfit(after - 1 + fraction, np.arange(19), 1)[0]))


# In each row the shock lies where the light is deflected.
for name, rows, expected, sign, level in (("First", (y > 0.3) & (y < 0.75), -first, 1, 1.89),
                                          ("Second", (y > 0.3) & (y < 0.75), second, -1, 3.07)):
    strength = deflection[rows] @ [np.sin(np.radians(first if sign > 0 else second)),
                                   sign * np.cos(np.radians(first if sign > 0 else second))]
    strength[strength < 0.2 * strength.max()] = 0
    middle = strength @ x / strength.sum(axis=1)
    slope = np.polyfit(middle, y[rows], 1)[0]
    found = np.degrees(np.arctan(slope))
    # Across a shock light bends to the denser side, along the shock's normal: downstream.
    bent = (deflection[rows] * strength[..., None]).sum(axis=(0, 1))
    normal = np.degrees(np.arctan2(bent[1], bent[0]))
    print(f"{name} shock: {found:.2f} degrees, in the data {solved(level):.2f}; light bent towards "
          f"{normal:.2f}")
    assert abs(found - solved(level)) < 0.3
    assert abs(found - expected) < 1, "The shock is smeared over 8 cells, but not as much as that"
    assert abs(normal - (expected + 90 * sign)) < 1 and bent[0] > 0

# Between the shocks the density is uniform, and the light crosses 0.1 m of it.
for place, density in (((0.5, 0.3), 1.4), ((1.9, 0.7), 2.380), ((3.9, 0.2), 3.762)):
    near = np.ix_(abs(y - place[1]) < 0.05, abs(x - place[0]) < 0.05)
    expected = K * DENSITY * (density - 1.4) * 0.1
    print(f"Density {density}: {path[near].mean():.4e} m, in theory {expected:.4e} m")
    assert abs(path[near].mean() - expected) < 0.003 * K * DENSITY * 3.762 * 0.1

schlieren.KnifeEdgeAngle = 90
check_baseline(schlieren, "ObliqueShock")

schlieren.Cutoff = "Dark Field"
check_baseline(schlieren, "ObliqueShockDarkField")
