# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The legend over the filter's image: there by default, with the colours that the image is drawn in, hidden by one
property, kept by states, with a ruler as long as it says, and not for other arrays."""

import os

import numpy as np
from paraview import simple
from plugin_testing import Schlieren
from representation_testing import pixels_of
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader

SIZE = (480, 360)

flow = simple.Calculator(Input=simple.Wavelet(WholeExtent=3 * [-8, 8]), ResultArrayName="rho", Function="RTData")
flow.UpdatePipeline()
bench = Schlieren(Input=flow, ImageSize=[96, 96], GladstoneDaleConstant=1e-6, LengthScale=1e-3)
view = simple.CreateRenderView(ViewSize=list(SIZE), OrientationAxesVisibility=0, InteractionMode="2D", UseFXAA=0,
                               UseColorPaletteForBackground=0, Background=[0.5, 0.5, 0.5])
display = simple.Show(bench, view)
assert display.Representation == "Slice" and display.SchlierenLegend == 1
view.ResetCamera(True)


def colors_of(name="seen.png"):
    """The view's colours, rows x columns x 3, the lowest row first."""
    simple.SaveScreenshot(name, view, ImageResolution=list(SIZE))
    reader = vtkPNGReader()
    reader.SetFileName(os.path.abspath(name))
    reader.Update()
    return vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars()).reshape(SIZE[1], SIZE[0], -1).astype(float)


def legend():
    """The colours in the legend's box, and the box: left, right, bottom, top."""
    display.SchlierenLegend = 1
    drawn = colors_of()
    display.SchlierenLegend = 0
    rows, columns = np.nonzero(np.ptp(np.stack([drawn, colors_of()]), axis=0).max(axis=-1))
    display.SchlierenLegend = 1
    box = columns.min(), columns.max() + 1, rows.min(), rows.max() + 1
    return drawn[box[2]:box[3], box[0]:box[1]], box


def error_of_scale(drawn, table):
    """By how much the row that is most like a map of colours, from 0 to 1, differs from it, 0 to 255."""
    errors = []
    for row in drawn:
        inside = row[np.flatnonzero(np.abs(row - row[0]).max(axis=1))]
        if len(inside) > 100:
            expected = [255 * np.array(color_of(table, value)) for value in np.linspace(0, 1, len(inside))]
            errors.append(np.abs(inside - expected)[2:-2].max())
    return min(errors)


def color_of(table, value):
    color = [0, 0, 0]
    table.GetColor(value, color)
    return color


# In grey, and in the colours of a map: the scale is the map's.
simple.ColorBy(display, ("POINTS", "Intensity"))
display.UseSeparateColorMap = 1
simple.ColorBy(display, ("POINTS", "Intensity"), True)
colors = display.LookupTable
view.CameraParallelScale = 26  # nothing shines through
for name in ("Grayscale", "Cool to Warm"):
    colors.ApplyPreset(name, True)
    colors.RescaleTransferFunction(0, 1)
    colors.AutomaticRescaleRangeMode = "Never"
    drawn, box = legend()
    assert box[1] > 0.95 * SIZE[0] and box[2] < 0.05 * SIZE[1], box
    error = error_of_scale(drawn, colors.GetClientSideObject())
    print(f"{name}: the scale differs by {error:.0f} of 255")
    assert error < 12, name


def ruler(drawn):
    """The pixels of the longest white line that is all white."""
    longest = 0
    for row in (drawn.min(axis=-1) > 250)[: drawn.shape[0] // 4]:
        ends = np.flatnonzero(np.diff(np.concatenate([[0], row, [0]])))
        longest = max([longest, *(ends[1::2] - ends[::2])])
    return longest


# The ruler is 1, 2 or 5 times a power of ten long, in metres, at any zoom.
colors.ApplyPreset("Grayscale", True)
for zoom in (1, 1.7, 3.1):
    scale = 9 / zoom
    view.CameraParallelScale = scale
    drawn, _ = legend()
    pixels = ruler(drawn)
    metres = pixels * bench.LengthScale * 2 * scale / SIZE[1]
    digits = metres / 10 ** np.floor(np.log10(metres) + 0.02)
    print(f"zoom {zoom}: ruler {pixels} pixels, {metres:.3g} m")
    assert pixels > 20 and min(abs(digits / of - 1) for of in (1, 2, 5)) < 2 / pixels, (zoom, pixels, metres)

# A path difference has no light to explain, and ParaView's own legend says what it is.
height = legend()[1][3] - legend()[1][2]
simple.ColorBy(display, ("POINTS", "OpticalPathDifference"), True)
drawn, box = legend()
assert box[3] - box[2] < 0.8 * height, (box, height)
simple.ColorBy(display, ("POINTS", "Intensity"), True)

# A colour filter has a plane of colours.
bench.Cutoff = "Color Filter"
bench.UpdatePipeline()
display.MapScalars = 0
simple.ColorBy(display, ("POINTS", "Color"), True)
drawn, _ = legend()
assert np.mean(np.ptp(drawn, axis=-1) > 100) > 0.05, "No colours"

# Its luminance has no scale of colours.
simple.ColorBy(display, ("POINTS", "Intensity"), True)
drawn, box = legend()
assert box[3] - box[2] < 0.8 * height, (box, height)
bench.Cutoff = "Knife Edge"

# Kept by a state, with the property.
display.SchlierenLegendCorner = "Upper Left"
simple.SaveState("legend.pvsm")
simple.ResetSession()
simple.LoadState(os.path.abspath("legend.pvsm"))
(view,) = simple.GetRenderViews()
(bench,) = [source for source in simple.GetSources().values() if source.GetXMLName() == "Schlieren"]
display = simple.GetRepresentation(bench, view)
assert display.SchlierenLegend == 1 and display.SchlierenLegendCorner == "Upper Left"
_, box = legend()
assert box[0] < 0.05 * SIZE[0] and box[3] > 0.95 * SIZE[1], box

# A hidden image has none.
simple.Hide(bench, view)
assert np.ptp(pixels_of(view, SIZE)) == 0
