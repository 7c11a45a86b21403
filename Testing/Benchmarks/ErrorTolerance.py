# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""What MediumTolerance is worth through the filter: errors of deflection and optical path on meshes of many kinds.

    SCHLIEREN_PLUGIN=…/Schlieren.so Utilities/with-display pvpython Testing/Benchmarks/ErrorTolerance.py [case…]

Prints a table; takes minutes. `bricks`: against the same view with the tolerance 1e-4, as a fraction of the largest deflection or path; so
this is what the sampling of the cells is responsible for. `cells`: that view against the closed form, where there is one;
so this is what the cells and what is made of them are. Straight rays at the centres of the pixels, in steps of a voxel.
Rays near walls and at the rim of the mesh do not count: there, what is measured is whether an edge lies within a pixel.
"""

import math
import os
import sys
import time

import numpy as np
from paraview import servermanager, simple
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkIdTypeArray, vtkPoints
from vtkmodules.vtkCommonDataModel import (VTK_TETRA, VTK_WEDGE, VTK_XYZ_GRID, vtkAMRBox, vtkCellArray,
                                           vtkImageData, vtkOverlappingAMR, vtkStructuredGrid,
                                           vtkUniformGrid, vtkUnstructuredGrid)
from vtkmodules.vtkFiltersGeneral import vtkDataSetTriangleFilter

simple.LoadPlugin(os.environ["SCHLIEREN_PLUGIN"], remote=False, ns=globals())

DATA = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "Data")
K = 2.26e-4
PIXELS = 192


# Fields: N - N of the surroundings at places (… x 3).

def ball(centre, width):
    return lambda x: K * np.exp(-((x - centre)**2).sum(-1) / width**2)


def shell(x):
    return K / 2 * (1 - np.tanh((np.sqrt((x**2).sum(-1)) - 0.5) / 0.03))


def layer(x):
    return K * np.exp(-(x[..., 1] / 0.02)**2) * (1 + 0.5 * np.cos(math.pi * x[..., 0]))


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


def image(cells):
    data = vtkImageData()
    data.SetDimensions(cells + 1, cells + 1, cells + 1)
    data.SetOrigin(-1, -1, -1)
    data.SetSpacing(3 * [2 / cells])
    return data


def jittered(cells, by):
    """Tetrahedra and their points, moved at random by so many cells."""
    cut = vtkDataSetTriangleFilter()
    cut.SetInputData(image(cells))
    cut.Update()
    data = cut.GetOutput()
    places = vtk_to_numpy(data.GetPoints().GetData()).astype(float)
    move = (np.random.default_rng(1).random(places.shape) * 2 - 1) * by * 2 / cells
    return data, places + np.where(abs(places) < 0.9999, move, 0)


def tetrahedra(field, of_cells=False):
    data, places = jittered(57, 0.2)
    with_points(data, places, field)
    if of_cells:
        data.GetPointData().RemoveArray("N")
        corners = places[vtk_to_numpy(data.GetCells().GetConnectivityArray()).reshape(-1, 4)]
        set_array(data.GetCellData(), means(corners, field))
    return data


def means(corners, field):
    """Over tetrahedra (… x 4 x 3): four places in each of the eight parts that their edges' middles make."""
    middles = {(i, j): (corners[:, i] + corners[:, j]) / 2 for i in range(4) for j in range(i + 1, 4)}
    a, b, c, d = (corners[:, i] for i in range(4))
    ab, ac, ad, bc, bd, cd = (middles[k] for k in ((0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)))
    total = 0
    for part in ((a, ab, ac, ad), (ab, b, bc, bd), (ac, bc, c, cd), (ad, bd, cd, d),
                 (ab, ac, ad, bd), (ab, ac, bc, bd), (ac, ad, bd, cd), (ac, bc, bd, cd)):
        for one in range(4):
            total = total + field(sum((0.58541019662496852 if k == one else 0.1381966011250105) * part[k]
                                      for k in range(4)))
    return total / 32


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


def grown(first, last, length):
    """From 0 to a length, cells of one size to those of another."""
    count = int(math.log(last / first) / math.log(1 + (last - first) / length)) + 1
    steps = np.geomspace(first, last, count)
    return np.concatenate([[0], np.cumsum(steps)]) * length / steps.sum()


def stretched(field):
    """A wall, cells of 1:1000 there."""
    y = grown(5e-5, 0.05, 1)
    x = np.linspace(-1, 1, 41)
    z, y, x = np.meshgrid(x, y, x, indexing="ij")
    return structured(np.stack([x, y, z], -1), field)


def prisms_and_tetrahedra(field):
    """Layers of prisms at a wall, and tetrahedra above them, the same points between."""
    n = 40
    heights = grown(5e-4, 0.04, 0.8)
    z, x = np.meshgrid(np.linspace(-1, 1, n + 1), np.linspace(-1, 1, n + 1), indexing="ij")
    move = (np.random.default_rng(2).random((2, n + 1, n + 1)) - 0.5) * 0.3 * 2 / n
    inner = (abs(x) < 0.999) & (abs(z) < 0.999)
    x, z = x + move[0] * inner, z + move[1] * inner
    per_layer = (n + 1)**2
    places = np.concatenate([np.stack([x.ravel(), np.full(per_layer, h), z.ravel()], -1)
                             for h in heights])
    corner = np.arange(per_layer).reshape(n + 1, n + 1)
    a, b, c, d = (corner[i:n + i, j:n + j].ravel() for i, j in ((0, 0), (0, 1), (1, 0), (1, 1)))
    triangles = np.sort(np.concatenate([np.stack([a, b, d], 1), np.stack([a, c, d], 1)]), axis=1)
    cells, types = [], []
    for low in range(len(heights) - 1):
        lower, upper = triangles + low * per_layer, triangles + (low + 1) * per_layer
        if heights[low] < 0.1:
            cells.append(np.column_stack([np.full(len(lower), 6), lower, upper]))
            types.append(np.full(len(lower), VTK_WEDGE))
        else:
            for t in ((lower[:, 0], lower[:, 1], lower[:, 2], upper[:, 2]),
                      (lower[:, 0], lower[:, 1], upper[:, 1], upper[:, 2]),
                      (lower[:, 0], upper[:, 0], upper[:, 1], upper[:, 2])):
                cells.append(np.column_stack([np.full(len(lower), 4), *t]))
                types.append(np.full(len(lower), VTK_TETRA))
    ids = vtkIdTypeArray()
    ids.DeepCopy(numpy_to_vtk(np.concatenate([c.ravel() for c in cells]).astype(np.int64)))
    known = vtkCellArray()
    known.ImportLegacyFormat(ids)
    data = vtkUnstructuredGrid()
    data.SetCells(numpy_to_vtk(np.concatenate(types).astype(np.uint8), deep=True), known)
    return with_points(data, places, field)


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


# Cases: a source, the arguments of the filter, and the field or None.

def producer(data):
    source = simple.TrivialProducer()
    source.GetClientSideObject().SetOutput(data)
    source.UpdatePipeline()
    return source


def closed(data, field, of_cells=False, **view):
    return producer(data), dict(IndexModel="Refractivity", IndexArray=["CELLS" if of_cells else "POINTS", "N"],
                                AutoAmbientRefractivity=0, AmbientRefractivity=0, **view), field


def flow(source, **arguments):
    source.UpdatePipeline()
    return source, arguments, None


OBLIQUE = dict(ViewDirection=[0.3, -0.2, -1], FocalPoint=[0, 0, 0], ParallelScale=0.9)


def plot3d():
    folder = os.path.join(DATA, "bluntfin_plot3d")
    return simple.PLOT3DReader(FileName=[os.path.join(folder, "bluntfinxyz.bin")],
                               QFileName=[os.path.join(folder, "bluntfinq.bin")], FunctionFileName="",
                               Functions=[100])


def coil():
    reader = simple.XMLUnstructuredGridReader(FileName=[os.path.join(DATA, "heating_coil_fluid.vtu")])
    return simple.Calculator(Input=reader, ResultArrayName="N", Function="-1e-4*(Temperature-300)")


def disk():
    reader = simple.ExodusIIReader(FileName=[os.path.join(DATA, "disk_exodus", "disk_out_ref.ex2")])
    reader.PointVariables = ["Temp"]
    return simple.Calculator(Input=reader, ResultArrayName="rho", Function="350/Temp")


CASES = {
    "ball, tetrahedra": lambda: closed(tetrahedra(ball(0, 0.35)), ball(0, 0.35), **OBLIQUE),
    "ball, cells of tetrahedra": lambda: closed(tetrahedra(ball(0, 0.35), True), ball(0, 0.35), True,
                                                **OBLIQUE),
    "ball beside a sphere, far field": lambda: closed(
        sphere_grid(ball(np.array([2.4, 0, 0]), 0.5)), ball(np.array([2.4, 0, 0]), 0.5),
        FocalPoint=[2.4, 0, 0], ParallelScale=1.3),
    "shock and wake, far field": lambda: closed(sphere_grid(flow_around_sphere), flow_around_sphere,
                                                FocalPoint=[0, 0, 0], ParallelScale=3),
    "layer, 1:1000": lambda: closed(stretched(layer), layer, FocalPoint=[0, 0.03, 0],
                                    ParallelScale=0.028),
    "layer, prisms and tetrahedra": lambda: closed(prisms_and_tetrahedra(layer), layer,
                                                   FocalPoint=[0, 0.06, 0], ParallelScale=0.055),
    "shell, hexahedra": lambda: closed(boxes(shell, 100), shell, **OBLIQUE),
    "ball, AMR of ratio 2": lambda: closed(adaptive(2, 5, 0.06), ball(0, 0.06), True,
                                           ViewDirection=[0.3, -0.2, -1], FocalPoint=[0, 0, 0],
                                           ParallelScale=0.18),
    "ball, AMR of ratio 4": lambda: closed(adaptive(4, 3, 0.06), ball(0, 0.06), True,
                                           ViewDirection=[0.3, -0.2, -1], FocalPoint=[0, 0, 0],
                                           ParallelScale=0.18),
    "heating coil": lambda: flow(coil(), IndexModel="Refractivity", IndexArray=["POINTS", "N"],
                                 ViewDirection=[0, 1, 0], ViewUp=[0, 0, 1]),
    "blunt fin": lambda: flow(plot3d(), Density=["POINTS", "Density"]),
    "blunt fin, its nose": lambda: flow(plot3d(), Density=["POINTS", "Density"],
                                        FocalPoint=[-1, 1, 2], ParallelScale=1.2),
    "delta wing": lambda: flow(
        simple.XMLStructuredGridReader(FileName=[os.path.join(DATA, "deltawing.vts")]),
        Density=["POINTS", "Density"], ViewDirection=[-1, 0, 0], ViewUp=[0, 0, 1]),
    "rotating disk": lambda: flow(disk(), Density=["POINTS", "rho"], ViewDirection=[0, 1, 0],
                                  ViewUp=[0, 0, 1]),
}


def look(source, arguments, tolerance):
    bench = Schlieren(source, ImageSize=[PIXELS, PIXELS], SamplesPerPixel=1, StepSize=1,  # noqa: F821
                      HomogeneityTolerance=0, PathModel="Straight", MediumTolerance=tolerance,
                      HistogramSize=0, **arguments)
    start = time.process_time()
    bench.UpdatePipeline()
    seconds = time.process_time() - start
    made = servermanager.Fetch(bench)
    simple.Delete(bench)
    columns, rows, _ = made.GetDimensions()
    arrays = {name: vtk_to_numpy(made.GetPointData().GetArray(name)).reshape(rows, columns, -1).squeeze()
              for name in ("Deflection", "OpticalPathDifference", "BlockedFraction")}
    arrays["Deflection"] = arrays["Deflection"][..., :2]
    return arrays, made.GetFieldData(), seconds


def truth(arguments, field, far):
    """Deflection and path of straight rays at the pixels' centres, by sums."""
    direction = np.array(arguments.get("ViewDirection", [0, 0, -1]), float)
    w = -direction / np.linalg.norm(direction)
    u = np.cross([0, 1, 0], w)
    u /= np.linalg.norm(u)
    v = np.cross(w, u)
    half = arguments["ParallelScale"]
    x = ((np.arange(PIXELS) + 0.5) / PIXELS * 2 - 1) * half
    b, a = np.meshgrid(x, x, indexing="ij")
    start = np.array(arguments["FocalPoint"], float) + a[..., None] * u + b[..., None] * v
    h = 1e-4 * half
    path, bend = np.zeros_like(a), np.zeros(a.shape + (2,))
    steps = np.linspace(-far, far, 1601)
    for s in (steps[1:] + steps[:-1]) / 2:
        place = start + s * w
        path += field(place)
        for i, axis in enumerate((u, v)):
            bend[..., i] += (field(place + h * axis) - field(place - h * axis)) / (2 * h)
    step = steps[1] - steps[0]
    return bend * step, path * step


def errors(made, right, counts):
    """Rms and worst, of the largest."""
    wrong = np.abs(made - right) if made.ndim == 2 else np.linalg.norm(made - right, axis=-1)
    size = np.abs(right) if made.ndim == 2 else np.linalg.norm(right, axis=-1)
    largest = size[counts].max()
    return math.sqrt((wrong[counts]**2).mean()) / largest, wrong[counts].max() / largest


def away_from(mask, pixels=3):
    """Where no pixel nearby is in a mask."""
    near = mask.copy()
    for _ in range(pixels):
        for axis in (0, 1):
            near = near | np.roll(near, 1, axis) | np.roll(near, -1, axis)
    return ~near


def main():
    chosen = sys.argv[1:] or list(CASES)
    print("| case | tolerance | estimated | levels | voxels | MB | CPU s | bricks: rms | worst | cells: rms | worst "
          "| path, bricks: rms | worst | path, cells: rms |")
    print("|---|---|---|---|---|---|---|---|---|---|---|---|---|---|", flush=True)
    for case in chosen:
        source, arguments, field = CASES[case]()
        best, _, _ = look(source, arguments, 1e-4)
        counts = away_from((best["BlockedFraction"] > 0) | (best["OpticalPathDifference"] == 0)
                           if field is None else best["BlockedFraction"] > 0)
        rim = 3
        counts[:rim] = counts[-rim:] = counts[:, :rim] = counts[:, -rim:] = False
        of_cells = of_path = ("", "")
        if field is not None:
            bend, path = truth(arguments, field, 12 if "far" in case else 1)
            of_cells = errors(best["Deflection"], bend, counts)
            of_path = errors(best["OpticalPathDifference"], path, counts)
        for tolerance in (1e-1, 1e-2, 1e-3):
            made, facts, seconds = look(source, arguments, tolerance)
            of_bricks = errors(made["Deflection"], best["Deflection"], counts)
            along = errors(made["OpticalPathDifference"], best["OpticalPathDifference"], counts)

            def fact(name, n=0):
                array = facts.GetArray(name)
                return array.GetValue(n) if array and array.GetNumberOfValues() > n else float("nan")

            def text(value):
                return f"{value:.1e}" if value != "" else ""

            print(f"| {case} | {tolerance:.0e} | {fact('MediumError'):.1e} | {fact('MediumLevels'):.0f}-{fact('MediumLevels', 1):.0f} "
                  f"| {fact('MediumVoxels'):.1e} | {fact('MediumBytes') * 1e-6:.1f} | {seconds:.1f} "
                  f"| {of_bricks[0]:.1e} | {of_bricks[1]:.1e} | {text(of_cells[0])} | {text(of_cells[1])} "
                  f"| {along[0]:.1e} | {along[1]:.1e} | {text(of_path[0])} |", flush=True)


if __name__ == "__main__":
    main()
