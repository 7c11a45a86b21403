# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Data drawn as Schlieren in a render view: the image of the filter, whatever the data, the camera and the size."""

import os

import numpy as np
from paraview import simple
from representation_testing import GREY_LEVEL, filter_like, pixels_of, show
from vtkmodules.vtkCommonCore import vtkDoubleArray
from vtkmodules.vtkCommonDataModel import vtkRectilinearGrid
from vtkmodules.vtkIOXML import vtkXMLRectilinearGridWriter

DATA = os.path.join(os.environ["SCHLIEREN_SOURCE_DIR"], "Testing", "Data")


def check(name, display, view, sizes=((120, 90),)):
    for size in sizes:
        shown = pixels_of(view, size)
        expected = filter_like(display, view, size)
        assert shown.shape == expected.shape, (name, shown.shape)
        assert np.ptp(expected) > 50, (name, size)
        error = np.abs(shown - expected).max()
        assert error <= GREY_LEVEL, (name, size, error)


def rectilinear(path):
    """A ball of denser gas on lines that are not evenly spaced."""
    lines = [np.sort(np.concatenate([np.linspace(-1, 1, 16), np.linspace(-0.3, 0.3, 9)])) for _ in range(3)]
    grid = vtkRectilinearGrid()
    grid.SetDimensions(*(len(line) for line in lines))
    for line, put in zip(lines, (grid.SetXCoordinates, grid.SetYCoordinates, grid.SetZCoordinates)):
        values = vtkDoubleArray()
        for value in line:
            values.InsertNextValue(value)
        put(values)
    rho = vtkDoubleArray()
    rho.SetName("rho")
    for point in range(grid.GetNumberOfPoints()):
        rho.InsertNextValue(1 + np.exp(-4 * np.square(grid.GetPoint(point)).sum()))
    grid.GetPointData().AddArray(rho)
    writer = vtkXMLRectilinearGridWriter()
    writer.SetFileName(path)
    writer.SetInputData(grid)
    assert writer.Write() == 1
    return simple.XMLRectilinearGridReader(FileName=[path])


def flows():
    """Kinds of data, and the settings that are not the defaults. Voxels are kept from one view to the next, and so can
    be finer than another view alone would need, unless they are as fine as the mesh anyway."""
    yield "image", simple.XMLImageDataReader(FileName=[os.path.join(DATA, "ladenburg_jet_3d.vti")]), {}
    yield "rectilinear", rectilinear(os.path.abspath("ball.vtr")), {}
    yield "structured", simple.XMLStructuredGridReader(FileName=[os.path.join(DATA, "deltawing.vts")]), {"MediumTolerance": 0}
    yield "unstructured", simple.Tetrahedralize(Input=simple.Calculator(Input=simple.Wavelet(WholeExtent=3 * [-8, 8]), ResultArrayName="rho", Function="RTData")), {}
    yield "AMR", simple.AMRGaussianPulseSource(), {"Density": ["CELLS", "Gaussian-Pulse"]}
    wavelet = simple.Calculator(Input=simple.Wavelet(WholeExtent=3 * [-8, 8]), ResultArrayName="rho", Function="RTData")
    yield "multi-block", simple.GroupDatasets(Input=[wavelet, simple.Transform(Input=wavelet)]), {}
    flat = simple.Calculator(Input=simple.Wavelet(WholeExtent=[-20, 20, -20, 20, 0, 0]), ResultArrayName="rho", Function="RTData")
    yield "flat", flat, {}
    yield "flat mesh", simple.Tetrahedralize(Input=flat), {}


for kind, flow, settings in flows():
    flow.UpdatePipeline()
    view = simple.CreateRenderView(ViewSize=[120, 90], OrientationAxesVisibility=0)
    display = show(flow, view)
    simple.SetProperties(display.SchlierenBench, **settings)
    simple.ResetCamera(view)
    view.CameraParallelProjection = 1
    camera = view.GetActiveCamera()
    if not kind.startswith("flat"):
        camera.Azimuth(25)
        camera.Elevation(15)
    check(kind, display, view)
    if kind == "image":
        # Oblique cameras, and screenshots that are larger than the window, in tiles, or smaller.
        camera.Roll(40)
        check(kind, display, view, ((160, 120), (480, 360), (60, 45)))
    simple.Delete(view)
    del view, camera, display
