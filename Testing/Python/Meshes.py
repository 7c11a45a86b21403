# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Meshes as solvers make them, with default settings, against the closed form of a ball of gas: blocks that overlap, with
blanking and without."""

import math

import numpy as np
from paraview import simple
from plugin_testing import CONSTANT, Schlieren, output, image_array
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkDataSetAttributes, vtkMultiBlockDataSet, vtkStructuredGrid

K, DENSITY, HEIGHT, WIDTH = CONSTANT, 1.2, 0.3, 0.35
PIXELS = 150


def ball(x):
    return DENSITY + HEIGHT * np.exp(-(x**2).sum(-1) / WIDTH**2)


def deflection(u, v):
    """Of straight rays along z, from -1 to 1."""
    section = HEIGHT * math.sqrt(math.pi) * WIDTH * math.erf(1 / WIDTH) * np.exp(-(u**2 + v**2) / WIDTH**2)
    return K / (1 + K * DENSITY) * section[..., None] * np.stack([-2 * u, -2 * v], -1) / WIDTH**2


def set_density(data, places, field=ball):
    points = vtkPoints()
    points.SetData(numpy_to_vtk(np.ascontiguousarray(places, dtype=float), deep=True))
    data.SetPoints(points)
    array = numpy_to_vtk(np.ascontiguousarray(field(np.asarray(places))), deep=True)
    array.SetName("rho")
    data.GetPointData().AddArray(array)
    return data


def structured(axes, field=ball):
    """By three indices, the first one fastest: x, y and z of the points."""
    data = vtkStructuredGrid()
    data.SetDimensions(*axes.shape[2::-1])
    return set_density(data, axes.reshape(-1, 3), field)


def box(low, high, cells):
    axes = [np.linspace(a, b, n + 1) for a, b, n in zip(low, high, cells)]
    z, y, x = np.meshgrid(*axes[::-1], indexing="ij")
    return structured(np.stack([x, y, z], -1))


def ring(inner, outer, cells):
    """Around the z axis."""
    z, t, r = np.meshgrid(np.linspace(-1, 1, cells[2] + 1), np.linspace(0, 2 * math.pi, cells[1] + 1),
                          np.linspace(inner, outer, cells[0] + 1), indexing="ij")
    return structured(np.stack([r * np.cos(t), r * np.sin(t), z], -1))


def centres(grid):
    x, y, z = (n + 1 for n in grid.GetExtent()[1::2])
    p = vtk_to_numpy(grid.GetPoints().GetData()).reshape(z, y, x, 3)
    for axis in range(3):
        p = (np.take(p, range(p.shape[axis] - 1), axis) + np.take(p, range(1, p.shape[axis]), axis)) / 2
    return p.reshape(-1, 3)


def blocks(*parts):
    data = vtkMultiBlockDataSet()
    for n, part in enumerate(parts):
        data.SetBlock(n, part)
    return data


def producer(data):
    source = simple.TrivialProducer()
    source.GetClientSideObject().SetOutput(data)
    source.UpdatePipeline()
    return source


def seen(data, **view):
    bench = Schlieren(producer(data), ImageSize=[PIXELS, PIXELS], **view)
    image = output(bench)
    x = image.GetOrigin()[0] + image.GetSpacing()[0] * np.arange(PIXELS)
    u, v = np.meshgrid(x, image.GetOrigin()[1] + image.GetSpacing()[1] * np.arange(PIXELS))
    return bench, u, v, image_array(bench, "Deflection")[..., :2].astype(float), image_array(bench, "BlockedFraction")


def check(name, data, counts, body_area=0., rms=0.01, worst=0.04):
    bench, u, v, bent, blocked = seen(data)
    right = deflection(u, v)
    counts = counts(u, v) & (np.abs(u) < 0.97) & (np.abs(v) < 0.97)
    wrong = np.linalg.norm(bent - right, axis=-1)[counts] / np.linalg.norm(right, axis=-1).max()
    pixel = u[0, 1] - u[0, 0]
    inside = (np.abs(u) < 0.97) & (np.abs(v) < 0.97)
    area = blocked[inside].sum() * pixel**2
    print(f"{name}: rms {math.sqrt((wrong**2).mean()):.2g}, worst {wrong.max():.2g}, blocked {area:.4f}")
    assert math.sqrt((wrong**2).mean()) < rms and wrong.max() < worst, name
    assert blocked[counts].max() == 0, name
    assert abs(area - body_area) < 0.03 * body_area + 1e-9, (name, area)
    return bench


def anywhere(u, v):
    return u == u


def outside_body(u, v):
    return np.hypot(u, v) > 0.23


# A body-fitted ring over a background whose cells under it, and in the body, are blanked.
background = box([-1, -1, -1], [1, 1, 1], [50, 50, 50])
around = ring(0.2, 0.6, [30, 60, 50])
body = math.pi * 0.2**2
r = np.hypot(*centres(background).T[:2])
ghosts = numpy_to_vtk(np.where(r < 0.5, vtkDataSetAttributes.HIDDENCELL, 0).astype(np.uint8), deep=True)
ghosts.SetName(vtkDataSetAttributes.GhostArrayName())
background.GetCellData().AddArray(ghosts)
for order in ((background, around), (around, background)):
    check("overset, hidden cells", blocks(*order), outside_body, body)

# Blocks that overlap without any blanking.
check("overlapping rings", blocks(around, ring(0.5, 1.5, [50, 80, 50])), outside_body, body)
parts = [box([low, -1, -1], [high, 1, 1], [n, 50, 50]) for low, high, n in ((-1, 0.1, 27), (-0.15, 0.35, 17), (0.2, 1, 23))]
check("overlapping boxes", blocks(*parts), anywhere)
