# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Data drawn as Schlieren in a render view, and the same by the filter."""

import math

import numpy as np
import quick_sessions  # noqa: F401
from paraview import simple
from plugin_testing import Schlieren, image_array
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader

# Images are bytes, rounded.
GREY_LEVEL = 0.5 + 1e-4

# Of the filter alone: the representation has them of its view.
OF_THE_VIEW = {"ViewDirection", "ViewUp", "FocalPoint", "ParallelScale", "ViewAngle", "ImageSize"}


def show(flow, view, legend=False, **settings):
    display = simple.Show(flow, view)
    display.SetRepresentationType("Schlieren")
    display.SchlierenLegend = legend
    simple.SetProperties(display.SchlierenBench, **settings)
    return display


def pixels_of(view, size=None, channels=0):
    """Of a file, or of a screenshot of this size: rows x columns, lowest row first."""
    path = view
    if size:
        path = "screenshot.png"
        simple.SaveScreenshot(path, view, ImageResolution=list(size))
    reader = vtkPNGReader()
    reader.SetFileName(path)
    reader.Update()
    image = reader.GetOutput()
    columns, rows, _ = image.GetDimensions()
    colors = vtk_to_numpy(image.GetPointData().GetScalars()).reshape(rows, columns, -1).astype(float)
    return colors[..., channels]


def filter_like(display, view, size):
    """The grey levels that the filter's image has, with the settings of the representation and the view's camera."""
    camera = view.GetActiveCamera()
    bench = Schlieren(Input=display.Input)
    own = display.SchlierenBench
    for name in own.ListProperties():
        if name not in OF_THE_VIEW and name != "Input" and not own.GetProperty(name).SMProperty.GetInformationOnly():
            bench.SMProxy.GetProperty(name).Copy(own.SMProxy.GetProperty(name))
    bench.SMProxy.UpdateVTKObjects()
    angle = 0 if camera.GetParallelProjection() else camera.GetViewAngle()
    half = math.tan(math.radians(angle / 2)) * camera.GetDistance() if angle else camera.GetParallelScale()
    simple.SetProperties(
        bench, ViewDirection=list(camera.GetDirectionOfProjection()), ViewUp=list(camera.GetViewUp()),
        FocalPoint=list(camera.GetFocalPoint()), ParallelScale=half, ViewAngle=angle, ImageSize=list(size))
    intensity = image_array(bench, "Intensity")
    simple.Delete(bench)
    full = 2 if own.Cutoff == "Shadowgraph" else 1
    return np.clip(255 / full * intensity, 0, 255)
