# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Random data of every kind for Fuzz.py: what VTK lets exist, sensible or not."""

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import vtkIdList, vtkPoints, vtkStringArray
from vtkmodules.vtkCommonDataModel import (
    VTK_BEZIER_HEXAHEDRON, VTK_BEZIER_TETRAHEDRON, VTK_BEZIER_WEDGE, VTK_BIQUADRATIC_QUADRATIC_HEXAHEDRON,
    VTK_BIQUADRATIC_QUADRATIC_WEDGE, VTK_HEXAGONAL_PRISM, VTK_HEXAHEDRON, VTK_LAGRANGE_HEXAHEDRON,
    VTK_LAGRANGE_TETRAHEDRON, VTK_LAGRANGE_WEDGE, VTK_LINE, VTK_PENTAGONAL_PRISM, VTK_POLYGON, VTK_POLYHEDRON,
    VTK_PYRAMID, VTK_QUAD, VTK_QUADRATIC_HEXAHEDRON, VTK_QUADRATIC_LINEAR_WEDGE, VTK_QUADRATIC_PYRAMID,
    VTK_QUADRATIC_TETRA, VTK_QUADRATIC_WEDGE, VTK_TETRA, VTK_TRIANGLE, VTK_TRIQUADRATIC_HEXAHEDRON, VTK_VERTEX, VTK_VOXEL,
    VTK_WEDGE, vtkImageData, vtkMultiBlockDataSet, vtkNonOverlappingAMR, vtkOverlappingAMR, vtkAMRBox,
    vtkPartitionedDataSet, vtkPartitionedDataSetCollection, vtkPolyData, vtkRectilinearGrid, vtkStructuredGrid, vtkTable,
    vtkUniformGrid, vtkUnstructuredGrid)
from vtkmodules.vtkFiltersCore import vtkAppendFilter
from vtkmodules.vtkFiltersGeneral import vtkDataSetTriangleFilter
from vtkmodules.vtkFiltersSources import vtkCellTypeSource, vtkRandomHyperTreeGridSource, vtkSphereSource

# Points of a cell, where these are fixed.
POINTS = {VTK_VERTEX: 1, VTK_LINE: 2, VTK_TRIANGLE: 3, VTK_QUAD: 4, VTK_TETRA: 4, VTK_VOXEL: 8, VTK_HEXAHEDRON: 8,
          VTK_WEDGE: 6, VTK_PYRAMID: 5, VTK_PENTAGONAL_PRISM: 10, VTK_HEXAGONAL_PRISM: 12, VTK_QUADRATIC_TETRA: 10,
          VTK_QUADRATIC_HEXAHEDRON: 20, VTK_QUADRATIC_WEDGE: 15, VTK_QUADRATIC_PYRAMID: 13,
          VTK_TRIQUADRATIC_HEXAHEDRON: 27, VTK_BIQUADRATIC_QUADRATIC_WEDGE: 18,
          VTK_BIQUADRATIC_QUADRATIC_HEXAHEDRON: 24, VTK_QUADRATIC_LINEAR_WEDGE: 12}
WHOLE = (VTK_TETRA, VTK_HEXAHEDRON, VTK_WEDGE, VTK_PYRAMID, VTK_QUADRATIC_TETRA, VTK_QUADRATIC_HEXAHEDRON,
         VTK_QUADRATIC_WEDGE, VTK_QUADRATIC_PYRAMID, VTK_TRIQUADRATIC_HEXAHEDRON, VTK_TRIANGLE, VTK_QUAD)
OF_ANY_ORDER = (VTK_LAGRANGE_TETRAHEDRON, VTK_LAGRANGE_HEXAHEDRON, VTK_LAGRANGE_WEDGE, VTK_BEZIER_TETRAHEDRON,
                VTK_BEZIER_HEXAHEDRON, VTK_BEZIER_WEDGE)
NAMES = ("rho", "p", "T", "Density", "Y_H2", "N", "Refractivity", "vtkValidPointMask", "U", "x y/z", "é", "")
EXTREMES = (float("nan"), float("inf"), -float("inf"), 0., -1., 1e-300, 1e300, 1e38, -1e38, 1e-38)


def values(rng, points):
    """One number for each point: mostly what a gas may have."""
    kind = rng.randrange(12)
    length = max(1e-300, float(np.nanmax(np.abs(points)))) if points.size else 1.
    with np.errstate(all="ignore"):
        smooth = 1.2 + .1 * np.exp(-((points / length) ** 2).sum(axis=1) / .3)
    if kind < 6:
        return smooth
    if kind == 6:
        return np.full(len(points), rng.choice((0., 1.2, -1., 1e30)))
    if kind == 7:
        return np.random.default_rng(rng.randrange(1 << 30)).normal(size=len(points))
    if kind == 8:
        return smooth * rng.choice((1e-12, 1e12, -1, 1e300, 1e-300))
    some = smooth.copy()
    if len(some):
        which = [rng.randrange(len(some)) for _ in range(rng.randrange(1, 1 + len(some)))]
        some[which] = rng.choice(EXTREMES)
    return some


def array(rng, points, name, has_names):
    kind = rng.randrange(14)
    if kind == 0:
        made = vtkStringArray()
        for _ in points:
            made.InsertNextValue(rng.choice(("", "1", "rho")))
    else:
        numbers = values(rng, points)
        if kind == 1:
            numbers = np.repeat(numbers[:, None], rng.choice((2, 3, 4, 9)), axis=1)
        with np.errstate(all="ignore"):
            numbers = np.nan_to_num(numbers, nan=0, posinf=100, neginf=-100).clip(-100, 100).astype(
                rng.choice((np.int8, np.uint8, np.int32, np.int64))) if kind == 2 else numbers.astype(
                    rng.choice((np.float32, np.float64)))
        made = numpy_to_vtk(np.ascontiguousarray(numbers), deep=True)
    if name or has_names:
        made.SetName(name or "empty")
    return made


def add_arrays(rng, data, has_names=True):
    """`has_names`: of ParaView's own domains, those of arrays end the program where an array has no name."""
    for attributes, count in ((data.GetPointData(), data.GetNumberOfPoints()), (data.GetCellData(), data.GetNumberOfCells())):
        is_of_points = attributes is data.GetPointData()
        places = np.zeros((count, 3))
        for i in range(count):
            if is_of_points:
                places[i] = data.GetPoint(i)
            else:
                bounds = [0.] * 6
                data.GetCellBounds(i, bounds)
                places[i] = (np.array(bounds[::2]) + bounds[1::2]) / 2
        if is_of_points or rng.random() < .5:
            for name in [*rng.sample(NAMES, rng.randrange(4)), *(["rho"] if rng.random() < .7 else [])]:
                attributes.AddArray(array(rng, places, name, has_names))
        if rng.random() < .1:
            flags = np.array([rng.choice((0, 0, 1, 2, 16, 32, 255)) for _ in range(count)], dtype=np.uint8)
            ghosts = numpy_to_vtk(flags, deep=True)
            ghosts.SetName("vtkGhostType")
            attributes.AddArray(ghosts)
        if attributes.GetNumberOfArrays() and rng.random() < .2:
            attributes.SetActiveScalars(rng.choice(NAMES))
    return data


def place_of(rng):
    """Lengths and a place that data may have."""
    size = rng.choice((1., 1., 1., 1., 1e-3, 1e-9, 1e6, 1e-30, 1e30))
    return size, rng.choice((0., 0., 0., 10. * size, 1e6 * size, 1e15 * size))


def coordinates(rng, n):
    """Of an axis, in order, now and then with some that are the same, in the wrong order or no numbers."""
    size, start = place_of(rng)
    x = start + size * np.sort(np.array([rng.random() for _ in range(n)])) if rng.random() < .5 else \
        start + size * np.linspace(-1, 1, n)
    if n and rng.random() < .1:
        x[rng.randrange(n)] = rng.choice((*EXTREMES, x[0]))
    return x


def counts(rng):
    return [rng.choice((1, 2, 3, 4, 5, 8)) if rng.random() < .5 else 6 for _ in range(3)]


def image(rng, kind=vtkImageData):
    made = kind()
    size, start = place_of(rng)
    first = [rng.choice((0, 0, 0, -3, 5)) for _ in range(3)]
    made.SetExtent([first[i // 2] + (n - 1 if i % 2 else 0) for i, n in enumerate(np.repeat(counts(rng), 2))])
    made.SetSpacing([size * rng.choice((1, 1, 1, .5, *((0, -1, float("nan"), 1e300) if rng.random() < .05 else ())))
                     for _ in range(3)])
    made.SetOrigin([start] * 3)
    if rng.random() < .1:
        made.SetDirectionMatrix(*rng.choice(((0, 1, 0, 1, 0, 0, 0, 0, 1), (.6, .8, 0, -.8, .6, 0, 0, 0, 1), (0,) * 9)))
    return made


def rectilinear(rng):
    made = vtkRectilinearGrid()
    n = counts(rng)
    made.SetDimensions(n)
    for axis, put in enumerate((made.SetXCoordinates, made.SetYCoordinates, made.SetZCoordinates)):
        put(numpy_to_vtk(coordinates(rng, n[axis]), deep=True))
    return made


def points_of(rng, places):
    if len(places) and rng.random() < .05:
        places[rng.randrange(len(places)), rng.randrange(3)] = rng.choice(EXTREMES)
    made = vtkPoints()
    with np.errstate(over="ignore"):
        places = places.astype(rng.choice((np.float32, np.float64)))
    made.SetData(numpy_to_vtk(np.ascontiguousarray(places), deep=True))
    return made


def structured(rng):
    made = vtkStructuredGrid()
    n = counts(rng)
    made.SetDimensions(n)
    z, y, x = np.meshgrid(*(coordinates(rng, m) for m in reversed(n)), indexing="ij")
    if rng.random() < .5:  # around an axis
        x, y = x * np.cos(np.nan_to_num(y)), x * np.sin(np.nan_to_num(y))
    made.SetPoints(points_of(rng, np.stack([x.ravel(), y.ravel(), z.ravel()], axis=1)))
    if rng.random() < .1 and made.GetNumberOfCells():
        made.BlankCell(rng.randrange(made.GetNumberOfCells()))
    return made


def one_type(rng):
    """A mesh of one type of cell that fills a box."""
    source = vtkCellTypeSource()
    kind = rng.choice(WHOLE + OF_ANY_ORDER)
    source.SetCellType(kind)
    source.SetBlocksDimensions(*(rng.choice((1, 2, 2)) for _ in range(3)))
    source.SetCellOrder(rng.choice((1, 2, 3)) if kind in OF_ANY_ORDER else 1)
    source.Update()
    made = vtkUnstructuredGrid()
    made.ShallowCopy(source.GetOutput())
    while made.GetPointData().GetNumberOfArrays():
        made.GetPointData().RemoveArray(0)
    while made.GetCellData().GetNumberOfArrays():
        made.GetCellData().RemoveArray(0)
    size, start = place_of(rng)
    places = np.array([made.GetPoint(i) for i in range(made.GetNumberOfPoints())]).reshape(-1, 3)
    if rng.random() < .2:
        places += .3 * np.random.default_rng(rng.randrange(1 << 30)).normal(size=places.shape)
    made.SetPoints(points_of(rng, start + size * places))
    return made


def any_cells(rng):
    """Cells of all types with any points, degenerate and inverted ones among them."""
    made = vtkUnstructuredGrid()
    count = rng.choice((0, 1, 3, 8, 30, 60))
    size, start = place_of(rng)
    places = start + size * np.random.default_rng(rng.randrange(1 << 30)).uniform(-1, 1, (count, 3))
    made.SetPoints(points_of(rng, places))
    for _ in range(rng.choice((0, 1, 4, 20)) if count else 0):
        kind = rng.choice([*POINTS, VTK_POLYGON, VTK_POLYHEDRON])
        if kind == VTK_POLYHEDRON:
            corners = [rng.randrange(count) for _ in range(rng.choice((4, 5, 8)))]
            faces = vtkIdList()
            stream = [corners[i:i + 3] + corners[:max(0, i - len(corners) + 3)] for i in range(len(corners))]
            for number in [len(stream), *(n for face in stream for n in (len(face), *face))]:
                faces.InsertNextId(number)
            made.InsertNextCell(VTK_POLYHEDRON, faces)
            continue
        ids = [rng.randrange(count) for _ in range(POINTS.get(kind) or rng.randrange(1, 7))]
        made.InsertNextCell(kind, len(ids), ids)
    return made


def mesh_of_grid(rng):
    """Tetrahedra or hexahedra of an image or a grid."""
    made = vtkDataSetTriangleFilter() if rng.random() < .5 else vtkAppendFilter()
    made.AddInputDataObject(rng.choice((image, rectilinear, structured))(rng))
    made.Update()
    return made.GetOutput()


def surface(rng):
    if rng.random() < .3:
        return vtkPolyData()
    source = vtkSphereSource()
    size, start = place_of(rng)
    source.SetRadius(size)
    source.SetCenter(start, 0, 0)
    source.SetThetaResolution(rng.choice((3, 8)))
    source.Update()
    return source.GetOutput()


LEAVES = (image, lambda rng: image(rng, vtkUniformGrid), rectilinear, structured, one_type, one_type, any_cells,
          mesh_of_grid, mesh_of_grid, surface, lambda rng: vtkUnstructuredGrid(), lambda rng: vtkImageData())


def leaf(rng, has_names=True):
    return add_arrays(rng, rng.choice(LEAVES)(rng), has_names)


def blocks(rng, has_names=True, depth=0):
    kind = vtkPartitionedDataSetCollection if depth == 0 and rng.random() < .3 else vtkMultiBlockDataSet
    made = kind()
    for n in range(rng.choice((0, 1, 2, 3))):
        if kind is vtkPartitionedDataSetCollection:
            pieces = vtkPartitionedDataSet()
            for piece in range(rng.choice((0, 1, 2))):
                pieces.SetPartition(piece, leaf(rng, has_names) if rng.random() < .8 else None)
            made.SetPartitionedDataSet(n, pieces)
        elif rng.random() < .2:
            made.SetBlock(n, None)
        elif depth < 2 and rng.random() < .2:
            made.SetBlock(n, blocks(rng, has_names, depth + 1))
        else:
            made.SetBlock(n, leaf(rng, has_names))
    return made


def levels(rng, has_names=True):
    """Refined by 2 in a corner, or what is said to be."""
    made = rng.choice((vtkOverlappingAMR, vtkNonOverlappingAMR))()
    depth = rng.choice((1, 2, 3))
    number = [1] * depth
    made.Initialize(depth, number)
    size = rng.choice((1., 1e-3, 1e6))
    n = rng.choice((1, 4, 5))
    isOverlapping = made.IsA("vtkOverlappingAMR")
    if isOverlapping:
        made.SetOrigin([0, 0, 0])
        made.SetGridDescription(8)  # VTK_XYZ_GRID
    for level in range(depth):
        block = vtkUniformGrid()
        block.SetDimensions([n + 1] * 3)
        spacing = size / 2**level
        block.SetSpacing([spacing] * 3)
        if isOverlapping:
            made.SetSpacing(level, [spacing] * 3)
            made.SetRefinementRatio(level, 2)
            made.SetAMRBox(level, 0, vtkAMRBox(0, 0, 0, n - 1, n - 1, n - 1))
        if rng.random() < .9:
            made.SetDataSet(level, 0, add_arrays(rng, block, has_names))
    if isOverlapping and rng.random() < .8:
        made.GenerateParentChildInformation()
    return made


def table(rng):
    made = vtkTable()
    made.AddColumn(array(rng, np.zeros((5, 3)), "rho", True))
    return made


def hyper_tree(rng):
    source = vtkRandomHyperTreeGridSource()
    source.SetDimensions(3, 3, 3)
    source.SetSeed(rng.randrange(1000))
    source.SetMaxDepth(2)
    source.Update()
    return source.GetOutput()


def any_data(rng, has_names=True):
    kind = rng.randrange(20)
    if kind == 0:
        return table(rng)
    if kind == 1:
        return hyper_tree(rng)
    if kind < 4:
        return levels(rng, has_names)
    if kind < 8:
        return blocks(rng, has_names)
    return leaf(rng, has_names)


def good_image(points=9):
    """A Gaussian ball, which any filter shows."""
    made = vtkImageData()
    made.SetDimensions([points] * 3)
    made.SetSpacing([2 / (points - 1)] * 3)
    made.SetOrigin(-1, -1, -1)
    x = np.linspace(-1, 1, points)
    z, y, x = np.meshgrid(x, x, x, indexing="ij")
    rho = numpy_to_vtk((1.2 + .1 * np.exp(-(x * x + y * y + z * z) / .3)).ravel(), deep=True)
    rho.SetName("rho")
    made.GetPointData().AddArray(rho)
    return made
