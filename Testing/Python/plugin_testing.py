# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""What the tests of the plugin share: the plugin, loaded, and a Gaussian column to look through."""

import os
from importlib import import_module

import numpy as np
import quick_sessions  # noqa: F401
from paraview import simple
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkIOXML import vtkXMLImageDataWriter

simple.LoadPlugin(os.environ["SCHLIEREN_PLUGIN"], remote=False, ns=globals())
classes = import_module("schlieren.vtkSchlierenFilters")  # for GetMediumBuilds, before the first filter is wrapped

AMPLITUDE = 2.7e-4
RADIUS = 0.3
CONSTANT = classes.vtkGasTable.GetConstant("air", 632.8)  # the default

# Whatever the presets are: one ray per pixel, at its centre, in steps of a voxel.
EVERY_VOXEL = {"SamplesPerPixel": 1, "StepSize": 1}

MadeByUsers = Schlieren  # noqa: F821, of the plugin


def Schlieren(*source, **settings):  # noqa: N802
    """Of a quality that is fast, whatever the default is, and with a k of its own for each image."""
    return MadeByUsers(*source, **{"Quality": "Interactive", "KMode": "Automatic", **settings})


def gaussian_column(points=128):
    """A reader of a column A exp(-r^2/s^2) around the y axis in the cube from -1 to 1.

    Point arrays: rho, n and N; the cell array "cells" holds N at the cells' centres.
    """
    def refractivity(count):
        h = 2 / (points - 1)
        x = -1 + h * (np.arange(count) + 0.5 * (points - count))
        z, y, x = np.meshgrid(x, x, x, indexing="ij")
        return (AMPLITUDE * np.exp(-(x**2 + z**2) / RADIUS**2)).ravel()

    image = vtkImageData()
    image.SetDimensions(points, points, points)
    image.SetOrigin(-1, -1, -1)
    image.SetSpacing(3 * [2 / (points - 1)])
    values = refractivity(points)
    for name, array in (("N", values), ("n", 1 + values), ("rho", values / CONSTANT)):
        array = numpy_to_vtk(array, deep=True)
        array.SetName(name)
        image.GetPointData().AddArray(array)
    array = numpy_to_vtk(refractivity(points - 1), deep=True)
    array.SetName("cells")
    image.GetCellData().AddArray(array)

    writer = vtkXMLImageDataWriter()
    writer.SetFileName(os.path.join(os.environ["SCHLIEREN_TEST_OUTPUT"], f"column{points}.vti"))
    writer.SetDataModeToBinary()
    writer.SetInputData(image)
    assert writer.Write() == 1
    reader = simple.XMLImageDataReader(FileName=[writer.GetFileName()])
    reader.UpdatePipeline()
    return reader


def output(bench):
    """The updated output, as a vtkImageData of this process."""
    bench.UpdatePipeline()
    return bench.GetClientSideObject().GetOutputDataObject(0)


def image_array(bench, name):
    """An array of the updated output: rows x columns (x components), lowest row first."""
    image = output(bench)
    columns, rows, _ = image.GetDimensions()
    array = image.GetPointData().GetArray(name)
    assert array, f"There is no array {name}"
    return np.squeeze(vtk_to_numpy(array).reshape(rows, columns, -1))


def is_empty(bench):
    image = output(bench)
    return image.GetNumberOfPoints() == 0 and image.GetPointData().GetNumberOfArrays() == 0


def comes_back(state, script, check):
    """What check() looks at is there where a state file is loaded, and where a state's script is executed."""
    for bring in (lambda: simple.LoadState(os.path.abspath(state)), lambda: exec(script, {})):
        simple.ResetSession()
        bring()
        check()
