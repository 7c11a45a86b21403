# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Flows that Tradeoff.py and Testing/Flows/Presets.py look at: by name a source, and what the filter is given with it."""

import math
import os

import numpy as np
from paraview import simple
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import (VTK_XYZ_GRID, vtkAMRBox, vtkOverlappingAMR, vtkStructuredGrid,
                                           vtkUniformGrid)

simple.LoadPlugin(os.environ["SCHLIEREN_PLUGIN"], remote=False, ns=globals())

DATA = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "Data")
K = 2.26e-4


# Fields: N - N of the surroundings at places (… x 3).

def shell(x):
    return K / 2 * (1 - np.tanh((np.sqrt((x**2).sum(-1)) - 0.5) / 0.03))


def flow_around_sphere(x):
    r = np.sqrt((x**2).sum(-1)) + 1e-300
    c = x[..., 0] / r
    across = x[..., 1]**2 + x[..., 2]**2
    front = np.exp(-((r - 1.6) / 0.15)**2) * (1 - c) / 2
    wake = 0.4 * np.exp(-across / 0.18) * (0.5 + 0.5 * np.tanh(2 * (x[..., 0] - 0.5)))
    return 1.2 * K * (0.6 * front - wake * np.exp(-(x[..., 0] / 6)**2))


# Meshes: datasets with the point or cell array "N".

def with_points(data, places, field):
    points = vtkPoints()
    points.SetData(numpy_to_vtk(np.ascontiguousarray(places), deep=True))
    data.SetPoints(points)
    set_array(data.GetPointData(), field(places))
    return data


def set_array(attributes, values):
    array = numpy_to_vtk(np.ascontiguousarray(values).ravel(), deep=True)
    array.SetName("N")
    attributes.AddArray(array)


def structured(axes, field):
    """A curvilinear grid: its points by three indices, the first one fastest, x, y and z."""
    data = vtkStructuredGrid()
    data.SetDimensions(*axes.shape[2::-1])
    return with_points(data, axes.reshape(-1, 3), field)


def boxes(field, cells):
    g = np.linspace(-1, 1, cells + 1)
    z, y, x = np.meshgrid(g, g, g, indexing="ij")
    return structured(np.stack([x, y, z], -1), field)


def sphere_grid(field):
    """Around a sphere of radius 1, up to 50, cells growing by a twentieth."""
    ratio = 1.05**np.arange(107) - 1
    r, t, p = np.meshgrid(1 + 49 * ratio / ratio[-1], np.linspace(0, math.pi, 106),
                          np.linspace(0, 2 * math.pi, 107), indexing="ij")
    return structured(np.stack([r * np.cos(t), r * np.sin(t) * np.sin(p), r * np.sin(t) * np.cos(p)],
                               -1), field)


def adaptive(ratio, levels, width):
    """Nested boxes of 32^3 cells with the means of a ball."""
    amr = vtkOverlappingAMR()
    amr.Initialize(levels, levels * [1])
    amr.SetGridDescription(VTK_XYZ_GRID)
    amr.SetOrigin([-1, -1, -1])
    for level in range(levels):
        h = 1 / 16 / ratio**level
        half = 1 if level == 0 else min(16, 32 // ratio * 2) * h
        cells = round(2 * half / h)
        amr.SetSpacing(level, 3 * [h])
        amr.SetRefinementRatio(level, ratio)
        grid = vtkUniformGrid()
        grid.SetDimensions(3 * [cells + 1])
        grid.SetSpacing(3 * [h])
        grid.SetOrigin(3 * [-half])
        faces = np.linspace(-half, half, cells + 1)
        mean = np.diff([math.erf(x / width) for x in faces]) / h * width * math.sqrt(math.pi) / 2
        set_array(grid.GetCellData(), K * mean[:, None, None] * mean[None, :, None] * mean)
        amr.SetAMRBox(level, 0, vtkAMRBox(3 * [-half], 3 * [cells + 1], 3 * [h], 3 * [-1.]))
        amr.SetDataSet(level, 0, grid)
    amr.GenerateParentChildInformation()
    return amr


# Cases: a source, and the arguments of the filter.

def producer(data):
    source = simple.TrivialProducer()
    source.GetClientSideObject().SetOutput(data)
    source.UpdatePipeline()
    return source


def with_refractivity(data, association="POINTS", **view):
    return producer(data), dict(IndexModel="Refractivity", IndexArray=[association, "N"], AmbientRefractivity=0, **view)


OBLIQUE = dict(ViewDirection=[0.3, -0.2, -1], FocalPoint=[0, 0, 0])


def jet(direction):
    reader = simple.XMLImageDataReader(FileName=[os.path.join(DATA, "ladenburg_jet_3d.vti")])
    return reader, {"ViewDirection": direction, "LengthScale": 0.001}


def plot3d():
    folder = os.path.join(DATA, "bluntfin_plot3d")
    return simple.PLOT3DReader(FileName=[os.path.join(folder, "bluntfinxyz.bin")],
                               QFileName=[os.path.join(folder, "bluntfinq.bin")], FunctionFileName="",
                               Functions=[100])


def coil():
    reader = simple.XMLUnstructuredGridReader(FileName=[os.path.join(DATA, "heating_coil_fluid.vtu")])
    return simple.Calculator(Input=reader, ResultArrayName="N", Function="-1e-4*(Temperature-300)")


CASES = {
    "jet": lambda: jet([0, 0, -1]),
    "jet aslant": lambda: jet([0.3, -0.4, -1]),
    "blunt fin": lambda: (plot3d(), dict(Density=["POINTS", "Density"])),
    "shell, hexahedra": lambda: with_refractivity(boxes(shell, 100), ParallelScale=0.9, **OBLIQUE),
    "ball, AMR of ratio 2": lambda: with_refractivity(adaptive(2, 5, 0.06), "CELLS", ParallelScale=0.18, **OBLIQUE),
    "shock and wake, far field": lambda: with_refractivity(sphere_grid(flow_around_sphere), FocalPoint=[0, 0, 0],
                                                           ParallelScale=3),
    "heating coil": lambda: (coil(), dict(IndexModel="Refractivity", IndexArray=["POINTS", "N"],
                                          ViewDirection=[0, 1, 0], ViewUp=[0, 0, 1])),
}
