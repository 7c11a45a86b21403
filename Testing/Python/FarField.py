# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""A sphere in a body-fitted mesh with a far field, seen with default settings: the sphere's shadow, the light that
gas bends around it against a sum over straight rays, and what becomes of light beyond the mesh."""

import numpy as np
from paraview import simple
from plugin_testing import CONSTANT as K
from plugin_testing import Schlieren, output
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkStructuredGrid

FAR = 50
PIXELS = 100


def density(x, y, z):
    """A shell of gas in front of the sphere that fades away towards its sides."""
    r = np.sqrt(x**2 + y**2 + z**2)
    return 1.2 * (1 + 0.5 * np.exp(-((r - 1.9) / 0.35)**2) * (1 - x / r))


def mesh(last_angle):
    """Around the x axis up to an angle; layers get thicker by 8 % each."""
    layers = (1.08**np.arange(64) - 1) / (1.08**63 - 1)
    r, theta, phi = np.meshgrid(1 + (FAR - 1) * layers, np.linspace(0, np.pi, 41),
                                np.linspace(0, last_angle, 41), indexing="ij")
    x, y, z = r * np.cos(theta), r * np.sin(theta) * np.cos(phi), r * np.sin(theta) * np.sin(phi)
    grid = vtkStructuredGrid()
    grid.SetDimensions(r.shape[::-1])
    points = vtkPoints()
    points.SetData(numpy_to_vtk(np.stack([x.ravel(), y.ravel(), z.ravel()], axis=1), deep=True))
    grid.SetPoints(points)
    values = numpy_to_vtk(density(x, y, z).ravel(), deep=True)
    values.SetName("rho")
    grid.GetPointData().AddArray(values)
    source = simple.TrivialProducer()
    source.GetClientSideObject().SetOutput(grid)
    source.UpdatePipeline()
    return source


def seen(bench):
    image = output(bench)
    arrays = {name: vtk_to_numpy(image.GetPointData().GetArray(name)).reshape(PIXELS, PIXELS, -1)
              for name in ("Deflection", "BlockedFraction")}
    return image, arrays["Deflection"][..., :2].astype(float), arrays["BlockedFraction"][:, :, 0]


def field_data(image, name):
    return image.GetFieldData().GetAbstractArray(name).GetValue(0)


def deflection(u, v):
    """Of straight rays along z."""
    step, small = 0.02, 1e-4
    total = np.zeros(u.shape + (2,))
    for z in np.arange(-6, 6, step) + step / 2:
        total[..., 0] += density(u + small, v, z) - density(u - small, v, z)
        total[..., 1] += density(u, v + small, z) - density(u, v - small, z)
    return K * step / (2 * small) * total


def check_sphere(bench, image, bent, blocked, fraction=1):
    pixel = image.GetSpacing()[0]
    # Of a sphere of flat quadrilaterals.
    area = fraction * np.pi * np.sinc(1 / 40)**2
    assert abs(blocked.sum() * pixel**2 / area - 1) < 0.01, blocked.sum() * pixel**2 / area
    axis = image.GetOrigin()[0] + pixel * np.arange(PIXELS)
    u, v = np.meshgrid(axis, image.GetOrigin()[1] + pixel * np.arange(PIXELS))
    expected = deflection(u, v)
    is_free = (np.hypot(u, v) > 1.05) & (v > 0.1 if fraction < 1 else True)
    largest = np.abs(expected[is_free]).max()
    error = np.sqrt(((bent - expected)[is_free]**2).mean()) / largest
    assert error < 0.02, error


flow = mesh(2 * np.pi)
settings = {"Density": ["POINTS", "rho"], "ImageSize": [PIXELS, PIXELS], "PathModel": "Straight"}
near = Schlieren(Input=flow, ParallelScale=3, FocalPoint=[0, 0, 0], **settings)
image, bent, blocked = seen(near)
check_sphere(near, image, bent, blocked)
assert abs(field_data(image, "AmbientRefractivity") / (1.2 * K) - 1) < 1e-6
assert field_data(image, "MediumBytes") < 100e6, field_data(image, "MediumBytes")
assert "bricks on levels" in field_data(image, "Grid")

# Closer: smaller voxels, of the same medium.
voxel = field_data(image, "SmallestVoxel")
near.ParallelScale = 0.6
near.FocalPoint = [-1, 0, 0]
assert field_data(output(near), "SmallestVoxel") < voxel
near.UpdatePropertyInformation()

# All of it: light passes beyond the round mesh, undisturbed, but not where everything outside blocks it.
for outside, corner, middle in (("Auto", 0, 1), ("Blocks", 1, 1), ("Passes", 0, 0)):
    whole = Schlieren(Input=flow, Outside=outside, **settings)
    image, bent, blocked = seen(whole)
    centre = PIXELS // 2
    assert blocked[0, 0] == corner and blocked[centre, centre] == middle, outside
    assert not bent[0, 0].any()

# Half of it, with a symmetry plane.
half = Schlieren(Input=mesh(np.pi), ParallelScale=3, FocalPoint=[0, 0, 0], ViewDirection=[0, 0, 1], **settings)
image, bent, blocked = seen(half)
assert blocked.any()
half.ViewDirection = [0, -1, 0]
half.ViewUp = [0, 0, 1]
image, bent, blocked = seen(half)
assert abs(blocked.sum() * image.GetSpacing()[0]**2 / (np.pi / 2) - 1) < 0.02
