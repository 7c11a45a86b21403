# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Processor seconds of the first image of curved cells, against linear ones, with default settings but for the size.

    SCHLIEREN_PLUGIN=…/Schlieren.so pvpython Testing/Benchmarks/CurvedCells.py [expression of kinds [displacement…]]

Points are moved along each axis by up to a part of the edge of a block, 2 x 2 x 2 of which (1 x 1 x 2 of tetrahedra and
pyramids) are the mesh. `linear`: a mesh with the same corners; `fine`: one with as many points, order^3 cells for each. Each
line is a mesh: seconds, and millions of the medium's voxels, which the field and the boundary that the mesh makes need, of
these three. Meshes that fold take up to minutes.
"""

import os
import re
import sys
import time

import numpy as np
from paraview import simple
from vtkmodules import vtkCommonDataModel as cells
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkFiltersSources import vtkCellTypeSource

simple.LoadPlugin(os.environ["SCHLIEREN_PLUGIN"], remote=False, ns=globals())

PIXELS = 64
LINEAR = {"HEXAHEDRON": (2, 2, 2), "WEDGE": (2, 2, 2), "TETRA": (1, 1, 2), "PYRAMID": (1, 1, 2)}
KINDS = [("QUADRATIC_" + of, of, 2) for of in LINEAR]
KINDS += [("LAGRANGE_" + of, linear, order) for order in (2, 3, 4)
          for of, linear in (("HEXAHEDRON", "HEXAHEDRON"), ("TETRAHEDRON", "TETRA"), ("WEDGE", "WEDGE"))]
KINDS += [("BEZIER_" + of, linear, order) for order in (2, 3)
          for of, linear in (("HEXAHEDRON", "HEXAHEDRON"), ("TETRAHEDRON", "TETRA"), ("WEDGE", "WEDGE"))]


def moved(places, by):
    """Moves places by any amounts that depend on the place alone, so that meshes with the same points have them in common."""
    result = np.empty_like(places)
    for i, place in enumerate(np.rint(5040 * places).astype(int)):
        result[i] = places[i] + by * np.random.default_rng(place + 1000000).uniform(-1, 1, 3)
    return result


def mesh(kind, blocks, order, scale, by):
    source = vtkCellTypeSource()
    source.SetCellType(getattr(cells, "VTK_" + kind))
    source.SetBlocksDimensions(*(scale * n for n in blocks))
    source.SetCellOrder(order)
    source.Update()
    data = source.GetOutput()
    x = moved(vtk_to_numpy(data.GetPoints().GetData()).astype(float) / scale, by)
    points = vtkPoints()
    points.SetData(numpy_to_vtk(x, deep=True))
    data.SetPoints(points)
    density = numpy_to_vtk(1 + 0.1 * x[:, 0]**2 + 0.1 * x[:, 1] + 0.05 * np.sin(2 * x[:, 2]), deep=True)
    density.SetName("rho")
    data.GetPointData().AddArray(density)
    return data


def first_image(data):
    """Seconds, and millions of voxels."""
    producer = simple.TrivialProducer()
    producer.GetClientSideObject().SetOutput(data)
    producer.UpdatePipeline()
    bench = Schlieren(Input=producer, Density=["POINTS", "rho"], ImageSize=[PIXELS, PIXELS])
    start = time.process_time()
    bench.UpdatePipeline()
    seconds = time.process_time() - start
    voxels = bench.GetClientSideObject().GetOutput().GetFieldData().GetArray("MediumVoxels").GetValue(0)
    simple.Delete(bench)
    simple.Delete(producer)
    return np.array([seconds, 1e-6 * voxels])


def main():
    expression = sys.argv[1] if len(sys.argv) > 1 else "."
    displacements = [float(by) for by in sys.argv[2:]] or [0.02, 0.1]
    first_image(mesh("HEXAHEDRON", (1, 1, 1), 1, 1, 0))
    print("| cells | moved by | curved, s | linear, s | fine, s | curved / linear | / fine | voxels, 1e6 |\n|---|---|---|---|---|---|---|---|")
    for kind, linear, order in KINDS:
        name = f"{kind.lower().replace('_', ' ')} {order}"
        if not re.search(expression, name):
            continue
        blocks = LINEAR[linear]
        first_image(mesh(kind, blocks, order, 1, 0))  # makes what all cells of a kind have in common
        for by in displacements:
            meshes = (mesh(kind, blocks, order, 1, by), mesh(linear, blocks, 1, 1, by), mesh(linear, blocks, 1, order, by))
            curved, coarse, fine = map(first_image, meshes)
            print(f"| {meshes[0].GetNumberOfCells()} {name} | {by:g} | {curved[0]:.2f} | {coarse[0]:.2f} | {fine[0]:.2f} | "
                  f"{curved[0] / coarse[0]:.1f} | {curved[0] / fine[0]:.1f} | {curved[1]:.2f}, {coarse[1]:.2f}, {fine[1]:.2f} |",
                  flush=True)


main()
