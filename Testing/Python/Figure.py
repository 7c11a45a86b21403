# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Figures: the image pixel by pixel, axes where the data are, a legend of the image's own light, its numbers in 16 bits,
and what makes it again; of a filter and of a flow that a view draws as Schlieren; mistakes are one sentence."""

import json
import os
import re

import numpy as np
from paraview import simple
from plugin_testing import Schlieren, image_array
from representation_testing import pixels_of, show
from series_testing import write_series
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader
from PIL import Image
import schlieren_figure

COLUMNS, ROWS = 600, 320


def png(name):
    """Rows x columns (x channels), the uppermost row first."""
    reader = vtkPNGReader()
    reader.SetFileName(os.path.abspath(name))
    reader.Update()
    columns, rows, _ = reader.GetOutput().GetDimensions()
    values = vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars()).reshape(rows, columns, -1)
    return values[::-1]


def place_of(page, image):
    """The row and column of the page where the image is, pixel by pixel; None where it is not."""
    middle = image[image.shape[0] // 2]
    for row in range(page.shape[0] - image.shape[0] + 1):
        line = page[row + image.shape[0] // 2]
        for column in range(page.shape[1] - image.shape[1] + 1):
            if np.array_equal(line[column:column + image.shape[1]], middle) and np.array_equal(
                    page[row:row + image.shape[0], column:column + image.shape[1]], image):
                return row, column
    return None


flow = simple.Calculator(Input=simple.Wavelet(WholeExtent=[-30, 30, -16, 16, -8, 8]), ResultArrayName="rho",
                         Function="RTData")
flow.UpdatePipeline()
bench = Schlieren(Input=flow, ImageSize=[COLUMNS, ROWS], GladstoneDaleConstant=1e-6, LengthScale=1e-3,
                  FocalPoint=[5, -2, 0], ParallelScale=16, ViewDirection=[0, 0, -1], ViewUp=[0, 1, 0], KnifeEdgeAngle=90)
files = schlieren_figure.save("figure.png", bench, title="A $ figure")
assert files == ["figure.png", "figure_intensity.png", "figure_intensity.tif", "figure.json", "figure.pvsm"], files

# Pixel by pixel, and the numbers in steps of 1 / 65535.
light = image_array(bench, "Intensity").reshape(ROWS, COLUMNS)[::-1]
page = png("figure.png")
grey = np.rint(255 * np.clip(light, 0, 1)).astype(np.uint8)
place = place_of(page, np.repeat(grey[..., None], 3, axis=2))
assert place, "The image is not in the figure pixel by pixel"
numbers = png("figure_intensity.png")[..., 0]
assert numbers.dtype == np.uint16
with Image.open("figure_intensity.tif") as tiff:
    assert tiff.mode == "I;16" and np.array_equal(np.array(tiff), numbers), tiff.mode
assert np.abs(numbers / 65535 - np.clip(light, 0, 1)).max() <= 0.5 / 65535 + 1e-6

# The axes are in mm, and say where the data are: the ticks are below the image.
with open("figure.json", encoding="utf-8") as file:
    description = json.load(file)
axes = description["axes"]
pixel = 2 * 16 / ROWS
expected = {"left": 5 - COLUMNS / 2 * pixel, "right": 5 + COLUMNS / 2 * pixel, "bottom": -18, "top": 14}
assert axes["unit"] == "mm" and axes["names"] == ["x", "y"], axes
assert all(abs(axes[side] - value) < 1e-3 for side, value in expected.items()), (axes, expected)
row, column = place
ticks = page[row + ROWS + 2, column:column + COLUMNS].min(axis=-1) < 160
starts = np.flatnonzero(np.diff(np.concatenate([[0], ticks.astype(int)])) == 1)
values = axes["left"] + (starts + 0.5) * pixel
print("ticks at", values.round(2), "mm")
steps = np.diff(values)
assert len(starts) > 3 and np.ptp(steps) < 2.5 * pixel
step = round(float(steps.mean()))
assert step in (2, 5, 10, 20) and np.abs(values - step * np.rint(values / step)).max() < 2 * pixel, values

# What is in it besides.
k = description["k"]
assert np.allclose(description["legend"]["range"], [-0.5 / k, 0.5 / k])
assert description["legend"]["label"] == "deflection up" and description["title"] == "A $ figure"
assert description["properties"]["KnifeEdgeAngle"] == 90 and description["properties"]["FocalPoint"] == [5, -2, 0]
assert description["properties"]["Cutoff"] == "Knife Edge" and "Refine" not in description["properties"]
assert [source["type"] for source in description["sources"]] == ["RTAnalyticSource", "Calculator"]
assert description["sources"][0]["properties"]["WholeExtent"] == [-30, 30, -16, 16, -8, 8]
assert description["versions"]["Schlieren"][0].isdigit() and "paraview" in description["versions"]["ParaView"]

# Texts of an SVG are texts; a PDF is one.
schlieren_figure.save("figure.svg", bench)
with open("figure.svg", encoding="utf-8") as file:
    svg = file.read()
for text in ("deflection up, mrad" if 1e-3 < 0.5 / k < 1 else "deflection up", "x / mm", "y / mm", "Knife Edge", "k ="):
    assert text in svg, text
schlieren_figure.save("figure.pdf", bench)
with open("figure.pdf", "rb") as file:
    assert file.read(5) == b"%PDF-"

# A shadowgraph's white is 2.
bench.Cutoff = "Shadowgraph"
schlieren_figure.save("shadow.png", bench)
light = image_array(bench, "Intensity").reshape(ROWS, COLUMNS)[::-1]
assert np.abs(png("shadow_intensity.png")[..., 0] / 65535 - np.clip(light / 2, 0, 1)).max() <= 0.5 / 65535 + 1e-6
bench.Cutoff = "Knife Edge"

# Of a view: what it shows, without its legend, whatever else is selected.
view = simple.CreateRenderView(ViewSize=[160, 120], OrientationAxesVisibility=0, CameraParallelProjection=1)
display = show(flow, view, GladstoneDaleConstant=1e-6, KnifeEdgeAngle=90)
simple.ResetCamera(view)
view.GetActiveCamera().Azimuth(20)
simple.SetActiveView(view)
simple.SetActiveSource(flow)
sources = set(simple.GetSources())
schlieren_figure.save("view.png")
assert set(simple.GetSources()) == sources, "The figure has left a filter"
seen = pixels_of(view, (160, 120))
assert np.abs(png("view_intensity.png")[::-1, :, 0] / 65535 * 255 - seen).max() < 0.51
with open("view.json", encoding="utf-8") as file:
    assert json.load(file)["axes"]["names"] == ["u", "y"]  # turned about y
display.SchlierenLegend = 1
perspective = view.CameraParallelProjection = 0
schlieren_figure.save("perspective.png", size=[320, 240])
assert png("perspective_intensity.png").shape[:2] == (240, 320)

# Cropped to the data, of the time that the image shows, whatever the session's is.
write_series(os.path.abspath("series.pvd"), [0, 10], 12, lambda x, y, z, time: 1 + 0.01 * time * x)
series = Schlieren(Input=simple.PVDReader(FileName=os.path.abspath("series.pvd")), ImageSize=[80, 60], ParallelScale=2,
                   ViewDirection=[0, 0, -1], ViewUp=[0, 1, 0])
series.UpdatePipeline(10)
schlieren_figure.save("cropped.png", series, dpi=300, crop=True)
with open("cropped.json", encoding="utf-8") as file:
    description = json.load(file)
assert description["time"] == 10 and simple.GetTimeKeeper().Time == 0, description["time"]
assert description["light"] == "rays of 632.8 nm", description["light"]
assert png("cropped_intensity.png").shape[:2] == (30, 30)
assert all(abs(abs(description["axes"][side]) - 1) < 1e-6 for side in ("left", "right", "bottom", "top"))
with Image.open("cropped.png") as figure:
    assert np.allclose(figure.info["dpi"], 300, atol=0.1)
with open("cropped.pvsm", encoding="utf-8") as file:
    assert re.search(r'name="Time" id="\d+\.Time" number_of_elements="1">\s*<Element index="0" value="10"', file.read())

# Mistakes.
for arguments, words in ((("figure.bmp", bench), "name it *.png"),
                         (("figure.png", None, simple.CreateRenderView()), "Click into a view"),
                         (("nowhere/figure.pdf", bench), "Could not write")):
    simple.SetActiveSource(flow)
    try:
        schlieren_figure.save(*arguments)
    except schlieren_figure.FigureError as problem:
        assert words in str(problem), problem
    else:
        raise AssertionError(f"{arguments}: no error")

# The state makes the image again.
before = png("figure_intensity.png")
simple.ResetSession()
simple.LoadState(os.path.abspath("figure.pvsm"))
(again,) = [source for source in simple.GetSources().values() if source.GetXMLName() == "Schlieren"]
schlieren_figure.save("again.png", again)
assert np.array_equal(png("again_intensity.png"), before)
assert place_of(png("again.png"), page[row:row + ROWS, column:column + COLUMNS])
