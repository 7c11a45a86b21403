# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Water that a coil heats, on tetrahedra, pyramids and wedges (VTU): n from the temperature."""

import os

import numpy as np
from flow_testing import (DATA, EVERY_VOXEL, Schlieren, check_baseline, coordinates, one_dataset,
                          image_array, sums_along)
from paraview.simple import Calculator, XMLUnstructuredGridReader

mesh = XMLUnstructuredGridReader(FileName=[os.path.join(DATA, "heating_coil_fluid.vtu")])
mesh.UpdatePipeline()
# n - 1 of water at 101325 Pa and 632.8 nm, see Documentation/density.md.
SHIFT = "(-1.1092e-4*(Temperature-300) - 1.4857e-6*(Temperature-300)^2 + 7.088e-9*(Temperature-300)^3)"
water = Calculator(mesh, ResultArrayName="N", Function="0.331418 + " + SHIFT)
water.UpdatePipeline()

# The coil is a hole in the mesh, and reaches out of it. It blocks light; what is outside of the round container does
# not, also where the coil would continue.
schlieren = Schlieren(Input=water, IndexModel="Refractivity", IndexArray=["POINTS", "N"],
                      LengthScale=0.1, AmbientRefractivity=0.331418,
                      MediumTolerance=0.005, **EVERY_VOXEL, ImageSize=[240, 270],
                      ViewDirection=[0, 1, 0], ViewUp=[0, 0, 1], ParallelScale=1.25)
x, z = coordinates(schlieren)
blocked = image_array(schlieren, "BlockedFraction")
inside = blocked[(0.1 < z) & (z < 2.1)]
assert inside[:, abs(x) < 0.4].all() and not blocked[:, abs(x) > 0.99].any()
schlieren.ParallelScale = 1.1
x, z = coordinates(schlieren)
path = image_array(schlieren, "OpticalPathDifference") / 0.1
deflection = image_array(schlieren, "Deflection")
blocked = image_array(schlieren, "BlockedFraction")

# Sums along rays that VTK takes through the cells, away from the coil and the walls.
data = one_dataset(Calculator(mesh, ResultArrayName="shift", Function=SHIFT))
rows, columns = [index.ravel() for index in np.mgrid[14:256:4, 14:226:4]]
around = np.stack([blocked[rows + i, columns + j] for i in (-8, 0, 8) for j in (-8, 0, 8)])
free = (around.max(axis=0) == 0) & (abs(x[columns]) < 0.8)
rows, columns = rows[free], columns[free]
begin = np.stack([x[columns], -np.sqrt(1 - x[columns]**2), z[rows]], axis=1)
total, length = sums_along(data, "shift", begin, begin * [1, -1, 1], 301)
assert (length > 0.97 * 2 * -begin[:, 1]).all()
# Outside of the container light continues as at its wall: compare where that is as cold as the water
# around, which has no shift.
cold = np.ones(rows.size, bool)
for end in (begin, begin * [1, -1, 1]):
    cold &= np.abs(sums_along(data, "shift", end, end * [1, 0.95, 1], 20)[0]) < 1e-7
error = (path[rows, columns] - total)[cold] / -total.min()
rms, largest = np.sqrt(np.mean(error**2)), np.abs(error).max()
print(f"{error.size} optical paths against sums through the cells: rms {rms:.2%}, "
      f"largest {largest:.2%}")
assert error.size > 100 and total[cold].min() < 0.4 * total.min()
assert rms < 0.01 and largest < 0.05

# Hot water rises from the coil: at its outer sides light bends outwards, to the cold, and on top of
# its turns upwards.
u, v = deflection[..., 0], deflection[..., 1]
high = (z > 1.9) & (z < 2.15)
right, left = (np.ix_(high, (side * x > 0.7) & (side * x < 0.85)) for side in (1, -1))
print(f"Beside the plume: {u[left].mean():.1e}, {u[right].mean():.1e}")
assert u[left].mean() < 0 < u[right].mean()
top = (blocked[:-6] > 0.99) & (blocked[6:] == 0)
top[:, abs(x) < 0.5] = False
above = v[6:][top]
print(f"Above the coil: {above.mean():.1e}")
assert top.sum() > 50 and np.median(above) > 0

schlieren.KnifeEdgeAngle = 90
schlieren.KMode = "Value"
schlieren.KScale = 400 / 1.3314  # deflections are those in air
check_baseline(schlieren, "HeatingCoil")
