# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Time and memory of the first image, and of the next ones, of meshes with 10^7 cells.

    SCHLIEREN_PLUGIN=…/Schlieren.so Utilities/with-display pvpython Testing/Benchmarks/LargeMeshes.py [case [cells]]

All settings are the defaults, but for the part of a far field that is seen. One process for each case: memory is the
most that the process ever had, so the mesh's own comes first in the line.
"""

import math
import os
import resource
import subprocess
import sys
import time

import numpy as np
from paraview import servermanager, simple
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import (VTK_HEXAHEDRON, VTK_TETRA, vtkCellArray, vtkStructuredGrid,
                                           vtkUnstructuredGrid)


def with_points(data, places, density):
    points = vtkPoints()
    points.SetData(numpy_to_vtk(places, deep=True))
    data.SetPoints(points)
    array = numpy_to_vtk(density, deep=True)
    array.SetName("rho")
    data.GetPointData().AddArray(array)
    return data


def cube(n):
    """The points of n^3 cells, moved a little, and a shell of gas."""
    g = np.linspace(-1, 1, n + 1, dtype=np.float32)
    z, y, x = np.meshgrid(g, g, g, indexing="ij")
    wave = np.float32(0.3 / n) * np.sin(np.float32(math.pi) * (x + y + z) * 7)
    inside = (1 - x**2) * (1 - y**2) * (1 - z**2)
    places = np.stack([(a + wave * inside).ravel() for a in (x, y, z)], -1)
    density = 1.2 * (1 - 0.4 * np.tanh((np.sqrt((places**2).sum(-1)) - 0.5) / 0.03))
    return places, density.astype(np.float32)


def unstructured(places, density, cells, kind):
    """Cells: a row of points for each."""
    corners = cells.shape[1]
    array = vtkCellArray()
    array.SetData(numpy_to_vtkIdTypeArray(np.arange(0, cells.size + 1, corners), deep=True),
                  numpy_to_vtkIdTypeArray(np.ascontiguousarray(cells).ravel(), deep=True))
    data = vtkUnstructuredGrid()
    data.SetCells(kind, array)
    return with_points(data, places, density)


def corners(n):
    """The eight points of each of n^3 cells, x fastest."""
    point = np.arange((n + 1)**3, dtype=np.int64).reshape(3 * (n + 1,))
    return [point[k:n + k, j:n + j, i:n + i].ravel() for k in (0, 1) for j in (0, 1) for i in (0, 1)]


def hexahedra(n):
    c = corners(n)
    return unstructured(*cube(n), np.stack([c[i] for i in (0, 1, 3, 2, 4, 5, 7, 6)], 1), VTK_HEXAHEDRON)


def tetrahedra(n):
    """Six in each cube, around its diagonal."""
    n = round(n / 6**(1 / 3))
    c = corners(n)
    parts = [np.stack([c[0], c[a], c[b], c[7]], 1) for a, b in ((1, 3), (3, 2), (2, 6), (6, 4), (4, 5), (5, 1))]
    return unstructured(*cube(n), np.concatenate(parts), VTK_TETRA)


def curvilinear(n):
    data = vtkStructuredGrid()
    data.SetDimensions(n + 1, n + 1, n + 1)
    return with_points(data, *cube(n))


def far_field(n):
    """Around a sphere of radius 1 up to 50: a shock in front, a wake."""
    growth = 1.025**np.arange(n + 1) - 1
    r, t, p = np.meshgrid(1 + 49 * growth / growth[-1], np.linspace(0, math.pi, n + 1),
                          np.linspace(0, 2 * math.pi, n + 1), indexing="ij")
    x, y, z = r * np.cos(t), r * np.sin(t) * np.sin(p), r * np.sin(t) * np.cos(p)
    front = np.exp(-((r - 1.6) / 0.15)**2) * (1 - np.cos(t)) / 2
    wake = 0.4 * np.exp(-(y**2 + z**2) / 0.18) * (0.5 + 0.5 * np.tanh(2 * (x - 0.5))) * np.exp(-(x / 6)**2)
    data = vtkStructuredGrid()
    data.SetDimensions(n + 1, n + 1, n + 1)
    return with_points(data, np.stack([a.ravel() for a in (x, y, z)], -1).astype(np.float32),
                       (1.2 * (1 + 0.6 * front - 0.4 * wake)).ravel().astype(np.float32))


CASES = {"hexahedra": hexahedra, "tetrahedra": tetrahedra, "curvilinear grid": curvilinear,
         "far field, curvilinear grid": far_field}


def gigabytes():
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 2**20


def measure(case, cells):
    simple.LoadPlugin(os.environ["SCHLIEREN_PLUGIN"], remote=False, ns=globals())
    source = simple.TrivialProducer()
    source.GetClientSideObject().SetOutput(CASES[case](cells))
    source.UpdatePipeline()
    before = gigabytes()
    view = {"ParallelScale": 3, "FocalPoint": [0, 0, 0]} if "far" in case else {}
    start, cpu = time.time(), time.process_time()
    bench = Schlieren(Input=source, **view)  # noqa: F821
    bench.UpdatePipeline()
    first, of_first = time.time() - start, time.process_time() - cpu
    after = gigabytes()
    start = time.time()
    bench.ViewDirection = [0.3, 0.2, -1]
    bench.UpdatePipeline()
    turned = time.time() - start
    made = servermanager.Fetch(bench)
    facts = {name: made.GetFieldData().GetAbstractArray(name).GetValue(0)
             for name in ("MediumVoxels", "MediumBytes", "MediumError", "RaysTraced")}
    count = source.GetDataInformation().GetNumberOfCells()
    print(f"| {case} | {count:.3g} | {before:.2f} | {after:.2f} | {first:.1f} | {of_first:.1f} | {turned:.1f} "
          f"| {facts['MediumVoxels']:.2g} | {facts['MediumBytes'] / 2**20:.0f} |", flush=True)
    if "SAVE_IN" in os.environ:
        bench.ViewDirection = [0, 0, -1]
        simple.SaveData(os.path.join(os.environ["SAVE_IN"], case.replace(" ", "_") + ".vti"), proxy=bench,
                        DataMode="Binary")


if len(sys.argv) > 1:
    measure(sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 216)
else:
    print("| mesh | cells | GB before | GB most | first image, s | CPU s | turned, s | voxels | MB of medium |")
    print("|---|---|---|---|---|---|---|---|---|", flush=True)
    for one in CASES:
        subprocess.run([sys.executable, os.path.abspath(__file__), one], check=True)
