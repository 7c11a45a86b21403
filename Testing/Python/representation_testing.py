# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Data drawn as Schlieren in a render view, and the same by the filter."""

import numpy as np
import quick_sessions  # noqa: F401
from paraview import simple
from plugin_testing import image_array  # loads the plugin, which has the next module
import schlieren_figure
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader

# Images are bytes, rounded.
GREY_LEVEL = 0.5 + 1e-4

def show(flow, view, legend=False, **settings):
    display = simple.Show(flow, view)
    display.SetRepresentationType("Schlieren")
    display.SchlierenLegend = legend
    simple.SetProperties(display.SchlierenBench, **{"Quality": "Interactive", "KMode": "Automatic", **settings})
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
    own, bench = display.SchlierenBench, schlieren_figure.filter_like(display, view, size)
    intensity = image_array(bench, "Intensity")
    full = 2 if own.Cutoff == "Shadowgraph" else 1
    return np.clip(255 / full * intensity, 0, 255)
