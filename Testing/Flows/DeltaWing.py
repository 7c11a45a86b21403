# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The leading-edge vortices of a delta wing, a curvilinear grid with collapsed cells (VTS)."""

import os

import numpy as np
from flow_testing import (DATA, EVERY_VOXEL, Schlieren, check_baseline, coordinates, one_dataset,
                          image_array, sums_along)
from paraview.simple import Reflect, XMLStructuredGridReader

K = 2.26e-4
DENSITY = 1.225  # kg/m^3 in the free stream

half = XMLStructuredGridReader(FileName=[os.path.join(DATA, "deltawing.vts")])
half.UpdatePipeline()
wing = Reflect(half, Plane="Y", Center=0)
wing.UpdatePipeline()

# From behind, along the chord: the right of the image is +y, the starboard half as computed.
schlieren = Schlieren(wing, Density=["POINTS", "Density"], GladstoneDaleConstant=K,
                      DensityScale=DENSITY, AmbientRefractivity=K * DENSITY,
                      **EVERY_VOXEL, ImageSize=[160, 120], ViewDirection=[-1, 0, 0],
                      ViewUp=[0, 0, 1], FocalPoint=[0.5, 0, 0.2], ParallelScale=0.6)
y, z = coordinates(schlieren)
path = image_array(schlieren, "OpticalPathDifference")
deflection = image_array(schlieren, "Deflection")

# Sums along rays that VTK takes through the half that was computed. The wing is a sheet without
# thickness at z = 0, on which the density jumps and which stops light: two voxels from there.
data = one_dataset(half)
rows, columns = [index.ravel() for index in np.mgrid[2:120:4, 82:160:4]]
apart = abs(z[rows]) > 0.07
rows, columns = rows[apart], columns[apart]
begin = np.stack([np.full(rows.size, -0.8), y[columns], z[rows]], axis=1)
total, length = sums_along(data, "Density", begin, begin * [0, 1, 1] + [1.8, 0, 0], 401)
assert np.abs(length - 2.6).max() < 0.02
error = (path[rows, columns] - K * DENSITY * (total - length)) / -path.min()
rms, largest = np.sqrt(np.mean(error**2)), np.abs(error).max()
print(f"Optical paths against sums through the cells: rms {rms:.2%}, largest {largest:.2%}")
assert rms < 0.003 and largest < 0.02

# The two halves mirror each other.
assert np.abs(path - path[:, ::-1]).max() < 1e-3 * -path.min()
u, v = deflection[..., 0], deflection[..., 1]
assert np.abs(u + u[:, ::-1]).max() < 1e-2 * np.abs(u).max()
# Suction: the least density lies above the wing, off its middle, and under the wing it is compressed.
above = np.where(z[:, None] > 0.1, path, 0)
row, column = np.unravel_index(above.argmin(), above.shape)
print(f"Core of a vortex at y = {abs(y[column]):.3f}, z = {z[row]:.3f}")
assert 0.08 < abs(y[column]) < 0.3
assert path[np.ix_((z > -0.15) & (z < -0.05), abs(y) < 0.1)].min() > 0
# Light bends out of the starboard vortex on both sides.
outside, inside = (np.ix_((z > 0.1) & (z < 0.2), (y > low) & (y < high))
                   for low, high in ((0.19, 0.24), (0.09, 0.13)))
print(f"Deflection beside it: {u[inside].mean():.2e} and {u[outside].mean():.2e}")
assert u[inside].mean() < 0 < u[outside].mean()

# The thin line above the middle is in the computation: its density dips within 0.01 of y = 0.
check_baseline(schlieren, "DeltaWing")

schlieren.Cutoff = "Color Filter"
check_baseline(schlieren, "DeltaWingColors", array="Color")
