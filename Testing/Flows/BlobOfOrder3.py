# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""A dense blob in a supersonic wind, on Lagrange hexahedra of order 3 with hanging nodes (VTU)."""

import os

import numpy as np
from flow_testing import (DATA, EVERY_VOXEL, Schlieren, check_baseline, coordinates, one_dataset,
                          image_array, sums_along)
from paraview.simple import ExtractCellsByRegion, XMLUnstructuredGridReader

K = 2.26e-4
AMBIENT = 1  # the wind's density

mesh = XMLUnstructuredGridReader(FileName=[os.path.join(DATA, "blob_lagrange_hex.vtu")])
mesh.UpdatePipeline()
# The blob fills little of the domain: only the small cells around it, so that it is sampled finely.
near = ExtractCellsByRegion(mesh, IntersectWith="Box", Extractintersected=1)
near.IntersectWith.Position = [-18.7, -2.4, -2.4]
near.IntersectWith.Length = [7.4, 4.8, 4.8]
near.UpdatePipeline()
data = one_dataset(near)
assert data.GetNumberOfCells() == 376 and data.GetCellType(0) == 72, "These are no such cells"

schlieren = Schlieren(near, Density=["POINTS", "rho"], GladstoneDaleConstant=K, LengthScale=0.01,
                      AmbientRefractivity=K * AMBIENT,
                      **EVERY_VOXEL, ImageSize=[240, 160], ParallelScale=2.5)
x, y = coordinates(schlieren)
path = image_array(schlieren, "OpticalPathDifference") / 0.01
deflection = image_array(schlieren, "Deflection")

# Sums along rays that VTK takes through the cells themselves.
rows, columns = [index.ravel() for index in np.mgrid[8:160:16, 8:240:16]]
begin = np.stack([x[columns], y[rows], np.full(rows.size, -2.5)], axis=1)
total, length = sums_along(data, "rho", begin, begin * [1, 1, -1], 101)
assert np.abs(length - 5).max() < 0.03
straight = K * (total - AMBIENT * length)
error = (path[rows, columns] - straight) / path.max()
rms, largest = np.sqrt(np.mean(error**2)), np.abs(error).max()
print(f"Optical paths against sums through the cells: rms {rms:.2%}, largest {largest:.2%}")
# The cells are divided between their nodes. Sums through cells that are linear there differ from those through the cubic
# ones by rms 0.56 %, 3.7 % at most; gradients at the nodes take part of that back.
assert rms < 0.0056 and largest < 0.037

# Wind and blob are the same upside down, and light bends towards the blob from all sides.
assert np.abs(path - path[::-1]).max() < 1e-5 * path.max()
v = deflection[..., 1]
assert np.sqrt(np.mean((v + v[::-1])**2)) < 1e-5 * np.sqrt(np.mean(v**2))
row, column = np.unravel_index(path.argmax(), path.shape)
print(f"Densest at x = {x[column]:.2f}")
assert abs(y[row]) < 0.1 and v[row + 20, column] < 0 < v[row - 20, column]
assert deflection[row, column + 20, 0] < 0 < deflection[row, column - 20, 0]

schlieren.KnifeEdgeAngle = 90
check_baseline(schlieren, "BlobOfOrder3")
