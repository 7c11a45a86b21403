# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Painting the colour filter through the image of data that are drawn as Schlieren, with a parallel and a perspective
camera: where the rays of the brushed pixels meet the filter, it is painted, and the view shows it. The mouse rests in a
view: what the image has there is shown, of a flow drawn as Schlieren and of a filter's image, zoomed, too; nothing
beside the image. Plot Over Line on an image in mm, as the guide says. With an argument, where a server makes the images;
skipped without pvserver."""

import os
import sys

import numpy as np

from filter_testing import SCENE
from server_testing import play
from views_testing import FOLDER, ViewsSession, png, png_of_text
from window_testing import BENCH, DISPLAY

WIDGET = BENCH + "/ColorFilterImage"
SIDE, K, COLOR, BRUSH = 256, 300, (10, 200, 30), 6
PLACES = {"parallel": (0.62, 0.42), "perspective": (0.45, 0.6)}
is_remote = len(sys.argv) > 1

user = ViewsSession()


def look(name):
    """Keeps what the filter is, where rays go and what the view shows."""
    user.python(f"""
view, display = GetActiveView(), GetDisplayProperties(FindSource("flow"), GetActiveView())
bench = display.SchlierenBench
until(lambda: finished(bench) and information(bench, "Status")[:7] != "Preview")
pause(0.5)
until(lambda: finished(bench) and information(bench, "Status")[:7] != "Preview")
deflection = [] if {is_remote} else \\
    vtk_to_numpy(bench.GetClientSideObject().GetOutputDataObject(0).GetPointData().GetArray("Deflection"))
np.savez(os.path.join(FOLDER, {name!r}), text=bench.ColorFilterImage, size=view.ViewSize, deflection=deflection,
         camera=view.CameraPosition)
SaveScreenshot(os.path.join(FOLDER, {name + ".png"!r}), view, ImageResolution=list(view.ViewSize))
""")


user.event(DISPLAY + "/Representation/displayRepresentationWidget/comboBox", "set_string", "Schlieren")
user.python(f"""
view, display = GetActiveView(), GetDisplayProperties(FindSource("flow"), GetActiveView())
display.SchlierenBench.Cutoff = "Color Filter"
display.SchlierenBench.KMode, display.SchlierenBench.KScale = "Value", {K}
display.SchlierenBench.Quality = "Interactive"
display.SchlierenBench.GladstoneDaleConstant = 2e-6
Render(view)
""")
look("wheel")
user.event(WIDGET + "/Brush", "setChosenColor", ",".join(map(str, COLOR)))
user.event(WIDGET + "/BrushSize", "set_int", BRUSH)
for kind, place in PLACES.items():
    user.python(f"""
GetActiveView().CameraParallelProjection = {int(kind == "parallel")}
Render()
""")
    look("before" + kind)
    user.event(WIDGET + "/PaintOnImage", "activate")
    user.check_at(WIDGET + "/PaintOnImage", "checked", "true")
    user.drag_view(0, place, place)
    look(kind)
    user.event(WIDGET + "/PaintOnImage", "activate")
    user.check_at(WIDGET + "/PaintOnImage", "checked", "false")
    user.event(WIDGET + "/Clear", "activate")
user.event(WIDGET + "/PaintOnImage", "activate")
user.drag_view(0, (0.4, 0.4), (0.45, 0.5))
user.event(WIDGET + "/PaintOnImage", "activate")
user.menu("menu_Edit", "actionEditUndo")
look("taken")

# Another representation shows no such image.
user.event(DISPLAY + "/Representation/displayRepresentationWidget/comboBox", "set_string", "Outline")
user.python("""
from inside_window import widget
assert not widget("propertiesPanel", "SchlierenBench", "ColorFilterImage", "PaintOnImage").isVisible()
""")

# The mouse rests.
user.python('Delete(FindSource("flow"))' + SCENE)
user.press("OneImage")
user.python("""
import re
FACTORS = {"": 1, "m": 1e-3, "µ": 1e-6, "n": 1e-9}
def rest(view, right, up):
    "What is shown where the mouse rests, places from 0 to 1."
    frame = GetLayout(view).GetViewLocation(view.SMProxy)
    over = widget(f"Frame.{frame}", "Viewport")
    place = QtCore.QPoint(int(right * over.width()), int((1 - up) * over.height()))
    QtWidgets.QToolTip.showText(over.mapToGlobal(place), "nothing new")
    event = QtGui.QHelpEvent(QEvent.Type.ToolTip, place, over.mapToGlobal(place))
    QApplication.sendEvent(over, event)
    return QtWidgets.QToolTip.text(), (place.x() + 0.5) / over.width(), 1 - (place.y() + 0.5) / over.height()
def numbers(line, unit):
    "The values of a line, in the unit without a prefix."
    texts, prefix = re.fullmatch(f".*: (.*) ([mµn]?){unit}", line).groups()
    return [float(text) * FACTORS[prefix] for text in texts.split(", ")]
def check(text, image, column, row, scale):
    pixel = row * image.GetDimensions()[0] + column
    place, deflection, path, light = text.split("\\n")
    assert place.startswith("x, y: "), place
    arrays = image.GetPointData()
    assert np.allclose(numbers(place, "m"), np.multiply(image.GetPoint(pixel)[:2], scale), rtol=1e-3), place
    eps = arrays.GetArray("Deflection").GetTuple(pixel)[:2]
    assert np.allclose(numbers(deflection, "rad"), eps, rtol=1e-3, atol=1e-3 * max(map(abs, eps))), (deflection, eps)
    assert np.allclose(numbers(path, "m"), arrays.GetArray("OpticalPathDifference").GetValue(pixel), rtol=1e-3)
    assert np.isclose(float(light.split(": ")[1]), arrays.GetArray("Intensity").GetValue(pixel), rtol=1e-2), light
def image_of(bench):
    "None where it is on a server."
    here = bench.GetClientSideObject()
    image = here.GetOutputDataObject(0) if here else None
    return image if image and image.GetNumberOfPoints() else None
(drawn,) = by_name("Schlieren View")
(display,) = displays()
display.SchlierenBench.LengthScale = 1e-3
settle_soon()
for right, up in ((0.4, 0.55), (0.6, 0.5)):
    text, x, y = rest(drawn, right, up)
    image = image_of(display.SchlierenBench)
    if image:
        columns, rows, _ = image.GetDimensions()
        check(text, image, int(x * columns), int(y * rows), 1e-3)
    else:
        place, deflection, _, _ = text.split("\\n")
        camera, size = drawn.GetActiveCamera(), drawn.ViewSize
        pixel = 2 * np.tan(np.radians(camera.GetViewAngle() / 2)) * camera.GetDistance() / size[1]
        expected = [camera.GetFocalPoint()[i] + (at - 0.5) * size[i] * pixel for i, at in enumerate((x, y))]
        assert np.allclose(numbers(place, "m"), np.multiply(expected, 1e-3), atol=1e-3 * pixel), (place, expected)
        assert max(map(abs, numbers(deflection, "rad"))) > 0, deflection

# Of a filter, whose pixels are larger than the screen's.
bench, flat = by_name("bench", "RenderView2")
settle(bench)
image = servermanager.Fetch(bench)
seen = set()
for zoom in (1, 3):
    flat.CameraParallelScale = flat.CameraParallelScale / zoom
    flat.CameraParallelProjection = 1
    Render(flat)
    for right, up in ((0.5, 0.5), (0.42, 0.61)):
        text, x, y = rest(flat, right, up)
        size, camera = flat.ViewSize, flat.GetActiveCamera()
        pixel = 2 * camera.GetParallelScale() / size[1]
        u = camera.GetFocalPoint()[0] + (x - 0.5) * size[0] * pixel
        v = camera.GetFocalPoint()[1] + (y - 0.5) * size[1] * pixel
        # What is fetched from a server has its place in few digits.
        bounds = bench.GetDataInformation().GetBounds()
        column, row = (int((at - low) / (high - low) * (count - 1) + 0.5) for at, low, high, count in zip(
            (u, v), bounds[::2], bounds[1::2], image.GetDimensions()))
        check(text, image, column, row, 1)
        seen.add((column, row))
assert len(seen) == 3, seen
flat.CameraParallelScale = 200
Render(flat)
assert rest(flat, 0.02, 0.5)[0] == "nothing new", "There is something beside the image"
""")
user.python("""
bench, = by_name("bench")
millimetres = Transform(Input=bench, TransformAllInputVectors=0)
millimetres.Transform.Scale = 3 * [1000]
millimetres.UpdatePipeline()
bounds = millimetres.GetDataInformation().GetBounds()
plot = PlotOverLine(Input=millimetres, Point1=[bounds[0], 0.5, 0], Point2=[bounds[1], 0.5, 0])
table = servermanager.Fetch(plot).GetPointData()
image = servermanager.Fetch(bench)
columns, rows, _ = image.GetDimensions()
length = vtk_to_numpy(table.GetArray("arc_length"))
places = image.GetOrigin()[0] + image.GetSpacing()[0] * np.arange(columns)
row = (0.5e-3 - image.GetOrigin()[1]) / image.GetSpacing()[1]
below = int(row)
assert np.isclose(length[-1], 1000 * np.ptp(places)), length[-1]
for name in ("OpticalPathDifference", "Deflection"):
    plotted = vtk_to_numpy(table.GetArray(name)).reshape(len(length), -1)[:, 0]
    values = vtk_to_numpy(image.GetPointData().GetArray(name)).reshape(rows, columns, -1)[..., 0]
    expected = (1 - row + below) * values[below] + (row - below) * values[below + 1]
    found = np.interp(1000 * (places - places[0]), length, plotted)
    assert np.abs(found - expected).max() < 3e-3 * np.ptp(expected), (name, np.abs(found - expected).max() / np.ptp(expected))
""")

play(user, """
from paraview.simple import *
flow = Calculator(Input=Wavelet(WholeExtent=3 * [-8, 8]), ResultArrayName="rho", Function="RTData", registrationName="flow")
flow.UpdatePipeline()
view = GetActiveViewOrCreate("RenderView")
view.OrientationAxesVisibility = view.CenterAxesVisibility = 0
Show(flow, view)
view.CameraParallelProjection = 1
ResetCamera()
SetActiveSource(flow)
Render()
""", is_remote)


def seen(name):
    return np.load(os.path.join(FOLDER, name + ".npz"))


def shown(name):
    return png(os.path.join(FOLDER, name + ".png")).astype(int)


centres = (np.arange(SIDE) + 0.5) / SIDE * 2 - 1
on_filter = np.stack(np.meshgrid(centres, centres), axis=-1)
assert str(seen("wheel")["text"]) == str(seen("taken")["text"]) == ""
for kind, (x, y) in PLACES.items():
    kept = seen(kind)
    assert np.array_equal(kept["camera"], seen("before" + kind)["camera"]), "The view has turned."
    columns, rows = kept["size"]
    image = png_of_text(str(kept["text"]))
    painted = (image == COLOR).all(axis=2)
    assert painted.sum() > 100, kind
    changed = np.abs(shown(kind) - shown("before" + kind)).max(axis=2) > 20
    assert changed.sum() > 100, kind
    row, column = np.mgrid[:rows, :columns]
    away = np.hypot(column + 0.5 - x * columns, row + 0.5 - (1 - y) * rows) - BRUSH / 200 * min(rows, columns)
    assert changed[away < -2].mean() > 0.9, (kind, changed[away < -2].mean())
    if not is_remote:
        # The mouse is somewhere in a pixel, so that those at the circle's rim may be in or out.
        places = np.clip(K * kept["deflection"].reshape(rows, columns, 3)[..., :2], -1, 1)
        for points, is_in in ((places[away < -1.5], True), (places[away < 1.5], False)):
            distance = np.min([np.hypot(*(on_filter - point).transpose(2, 0, 1)) for point in points], axis=0)
            if is_in:
                # What is not deflected keeps its colour.
                is_deflected = np.hypot(*on_filter.transpose(2, 0, 1)) > 0.02 + 2 / SIDE
                assert painted[(distance < BRUSH / 100 - 2 / SIDE) & is_deflected].all(), kind
            else:
                assert not painted[distance > BRUSH / 100 + 2 / SIDE].any(), kind
