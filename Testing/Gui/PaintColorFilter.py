# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Painting the colour filter, on itself and through the image: the filter gets colour where the brush was
or where the rays of the brushed pixels go, and the image shows it without Apply."""

import os

import numpy as np
from views_testing import load, png, png_of_text, simple
from window_testing import FOLDER, PANEL, PROPERTIES, VIEW, Session

WIDGET, PREVIEW = "ColorFilterImage", "ColorFilterImage/Preview"
MIDDLE, HALF = 113, 96  # of the filter in its widget, pixels; the middle give or take a font's height
SIDE = 256              # of the painted filter
PIXELS, K = 321, 300
COLOR = (10, 200, 30)
PIXEL = np.array([100, 205])  # of the image: column, row; in the middle of the view
SAVED = os.path.join(FOLDER, "saved.png")

user = Session()


def stroke(*places):
    """On the filter; each coordinate is -1 to 1, v upwards."""
    user.drag(PREVIEW, *[(round(MIDDLE + HALF * u), round(MIDDLE + HALF * -v)) for u, v in places])


def look(name):
    """Keeps what the filter is and what its image is, in the window."""
    user.check_at(PANEL + "/Accept", "enabled", "false")
    user.python(f"""
bench = FindSource("bench")
until(lambda: finished(bench))
arrays = bench.GetClientSideObject().GetOutputDataObject(0).GetPointData()
np.savez(os.path.join(FOLDER, {name!r}), text=bench.ColorFilterImage,
         camera=GetActiveView().CameraPosition,
         **{{name: vtk_to_numpy(arrays.GetArray(name)) for name in ("Color", "Deflection")}})
""")


look("wheel")
user.python("""
assert widget("propertiesPanel", "ColorFilterImage", "BrushSize").value() == 3
brush = widget("propertiesPanel", "ColorFilterImage", "Brush").property("chosenColor")
assert brush.saturation() == 255 and brush.value() == 255, brush.name()
""")
user.event(f"{PROPERTIES}/{WIDGET}/Brush", "setChosenColor", ",".join(map(str, COLOR)))
user.event(f"{PROPERTIES}/{WIDGET}/BrushSize", "set_int", 12)
line = ((-0.5, 0.25), (0.5, 0.25))
stroke(*line)
look("stroke")

# A dab by keys: 8 * 2 steps of 1/64 to the left of where the mouse was, and 1 up.
for name in ("ShiftLeft", "ShiftLeft", "Up", "Space"):
    user.key(PREVIEW, name)
look("keys")
user.menu("menu_Edit", "actionEditUndo")
look("undone")

# Erased with a larger brush, it is the wheel again; Edit > Undo brings the stroke back.
user.click(WIDGET + "/Erase")
user.event(f"{PROPERTIES}/{WIDGET}/BrushSize", "set_int", 16)
stroke(*line)
look("erased")
user.menu("menu_Edit", "actionEditUndo")
look("back")
user.click(WIDGET + "/Erase")

user.click(WIDGET + "/Save")
user.event("pqClientMainWindow/SaveImageDialog", "filesSelected", SAVED)
user.click(WIDGET + "/Load")
user.event("pqClientMainWindow/LoadImageDialog", "filesSelected", SAVED)
user.apply()
look("loaded")
user.click(WIDGET + "/Clear")
user.apply()
look("cleared")

# Across the middle, and by keys in the middle.
user.event(f"{PROPERTIES}/{WIDGET}/BrushSize", "set_int", 8)
stroke((-0.5, 0), (0.5, 0))
look("across")
user.python("""
plane = widget("propertiesPanel", "ColorFilterImage", "Preview")
for key, steps in (("Left", 12), ("Right", 4), ("Down", 12), ("Up", 4)):  # to the corner, and from there
    for _ in range(steps):
        QTest.keyClick(plane, getattr(Qt.Key, "Key_" + key), Qt.KeyboardModifier.ShiftModifier)
QTest.keyClick(plane, Qt.Key.Key_Space)
""")
look("middle")
user.click(WIDGET + "/Clear")
user.apply()

# On the image: beside it there is nothing to paint, and the view does not turn.
user.event(f"{PROPERTIES}/{WIDGET}/BrushSize", "set_int", 6)
user.click(WIDGET + "/PaintOnImage")
user.check(WIDGET + "/PaintOnImage", "checked", "true")
user.drag_view(0, (0.02, 0.02), (0.03, 0.03))
look("beside")
user.drag_view(0, (0.5, 0.5), (0.5, 0.5))
look("image")
user.save_state("image.pvsm")
user.event(VIEW.format(0), "keyEvent", "6:16777216:0::0:1")
user.check(WIDGET + "/PaintOnImage", "checked", "false")
user.drag_view(0, (0.5, 0.5), (0.6, 0.5), button=3)
user.menu("menu_Edit", "actionEditUndo")
look("taken")

# It ends by itself with the view.
user.click(WIDGET + "/PaintOnImage")
user.python("Delete(GetActiveView())")
user.check(WIDGET + "/PaintOnImage", "checked", "false")
user.click(WIDGET + "/PaintOnImage")
user.check(WIDGET + "/PaintOnImage", "checked", "false")

user.play(f"""
from paraview.simple import *
flow = Calculator(Input=Wavelet(WholeExtent=3 * [-8, 8]), ResultArrayName="rho", Function="RTData", registrationName="flow")
flow.UpdatePipeline()
bench = Schlieren(Input=flow, registrationName="bench", ImageSize=2 * [{PIXELS}], Cutoff="Color Filter",
                  Quality="Interactive", KMode="Value", KScale={K}, GladstoneDaleConstant=2e-6)
bench.UpdatePipeline()
view = GetActiveViewOrCreate("RenderView")
Show(bench, view).MapScalars = 0
ResetCamera(view)
left, right, low, high = bench.GetDataInformation().GetBounds()[:4]
x = left + {PIXEL[0]} * (right - left) / {PIXELS - 1}
y = low + {PIXEL[1]} * (high - low) / {PIXELS - 1}
view.CameraFocalPoint = [x, y, 0]
view.CameraPosition = [x, y, view.CameraPosition[2]]
Render()
SetActiveSource(bench)
""")


def seen(name):
    file = np.load(os.path.join(FOLDER, name + ".npz"))
    return str(file["text"]), file["Color"].reshape(PIXELS, PIXELS, 3).astype(int)


def decoded(text):
    return png_of_text(text)


# Places of the filter's pixels, from -1 to 1.
centres = (np.arange(SIDE) + 0.5) / SIDE * 2 - 1
u, v = np.meshgrid(centres, centres)
# What the wheel is: a hue for the direction, red to the right, and saturated at 1.
sector = np.arctan2(v, u) / (np.pi / 3)
hue = np.stack([np.clip(2 - np.abs((sector - 2 * n + 3) % 6 - 3), 0, 1) for n in range(3)], axis=-1)
WHEEL = 255 * (1 - np.minimum(1, np.hypot(u, v))[..., None] * (1 - hue))


def check_painted(image, inside, outside):
    """The brush's colour inside, the wheel outside."""
    assert inside.sum() > 100
    assert (image[inside] == COLOR).all()
    assert np.abs(image - WHEEL)[outside].max() <= 1


def check_brushed(image, distance):
    """Painted where the brush of 12 % was, but for the pixels at its rim."""
    check_painted(image, distance < 0.12 - 2 / SIDE, distance > 0.12 + 2 / SIDE)


text, before = seen("wheel")
assert text == ""

text, shown = seen("stroke")
colored = (decoded(text) == COLOR).all(axis=2)
shift = u[colored].mean(), v[colored].mean() - 0.25
assert np.hypot(*shift) < 8 / HALF
far = np.hypot(np.maximum(np.abs(u - shift[0]) - 0.5, 0), v - shift[1] - 0.25)
check_brushed(decoded(text), far)
assert np.abs(shown - before).max() > 100
assert seen("undone")[0] == seen("back")[0] == text
assert np.array_equal(seen("undone")[1], shown)
by_keys = decoded(seen("keys")[0])
by_key = np.hypot(u - shift[0] - (0.5 - 32 / 64), v - shift[1] - (0.25 + 2 / 64))
check_brushed(by_keys, np.minimum(far, by_key))

text_erased, shown_erased = seen("erased")
assert np.abs(decoded(text_erased) - WHEEL).max() <= 1
assert np.abs(shown_erased - before).max() <= 2  # an image's wheel, not the formula's
assert np.array_equal(png(SAVED), decoded(text))
assert np.array_equal(decoded(seen("loaded")[0]), decoded(text))
assert np.array_equal(seen("loaded")[1], shown)

# Light that is not deflected keeps its colour, unless the stroke begins there.
distance = np.hypot(u, v)
for name, is_painted in (("across", False), ("middle", True)):
    painted = (decoded(seen(name)[0]) == COLOR).all(axis=2)
    assert painted[distance < 0.02 - 2 / SIDE].all() == is_painted == painted[distance < 0.02 - 2 / SIDE].any(), name
    assert painted[(distance > 0.03) & (np.abs(u) < 0.4) & (np.abs(v - shift[1]) < 0.05)].all(), name

# On the image: the rays of the pixels in the brush's circle, times k.
assert seen("cleared")[0] == seen("beside")[0] == seen("taken")[0] == ""
text, shown = seen("image")
deflection = np.load(os.path.join(FOLDER, "image.npz"))["Deflection"].reshape(PIXELS, PIXELS, 3)[..., :2]
rows, columns = np.mgrid[:PIXELS, :PIXELS]
away = np.hypot(columns - PIXEL[0], rows - PIXEL[1]) - 0.03 * PIXELS
places = np.clip(K * deflection, -1, 1)


def distances(centres, points):
    """The way from each of the first to all of the second."""
    return np.stack([np.hypot(*(points - centre).transpose(2, 0, 1)) for centre in centres])


# The mouse is in the middle of a pixel of the screen, which is about as large as one of the image, so that those
# at the circle's rim may be in or out.
surely, perhaps = places[away < -1], places[away < 1]
on_filter = np.stack([u, v], axis=-1)
check_painted(decoded(text), (distances(surely, on_filter).min(axis=0) < 0.06 - 2 / SIDE) & (distance > 0.02 + 2 / SIDE),
              distances(perhaps, on_filter).min(axis=0) > 0.06 + 2 / SIDE)


# Whatever else goes there has that colour too, but for what is not deflected, and only that has changed. Light between the rays of
# neighbouring pixels meets the filter between them.
def around(mask):
    return np.all([np.roll(mask, (x, y), (-2, -1)) for x in (-1, 0, 1) for y in (-1, 0, 1)], axis=0)


undeflected = np.hypot(*places.transpose(2, 0, 1)) < 0.02 + 4 / SIDE
same = around((distances(surely, places) < 0.05) & ~undeflected).any(axis=0)
other = around(distances(perhaps, places).min(axis=0) > 0.08)
assert same[PIXEL[1], PIXEL[0]] and (same & (away > 1)).sum() > 100 and other.sum() > 1000
assert np.abs(shown[same] - COLOR).max() <= 2  # light gathers and spreads a little
assert np.abs(shown - before)[other].max() <= 2
cameras = [np.load(os.path.join(FOLDER, name + ".npz"))["camera"] for name in ("cleared", "image")]
assert np.array_equal(*cameras)

load("image.pvsm")
assert simple.FindSource("bench").ColorFilterImage == text
