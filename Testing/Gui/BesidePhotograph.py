# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Beside a Photograph compares the image of a filter with a file: its own colours in a view, the image and the photograph in
others. Two points that are clicked in both place it, one that is dragged corrects that. The line between both is dragged, the
mouse says what is under it, k is copied, and a figure shows both. Each is one step of undo."""

import os

import numpy as np
from PIL import Image
from views_testing import OPEN_JET, ViewsSession
from window_testing import FOLDER

PHOTOGRAPH, FIGURE = os.path.join(FOLDER, "photograph.png"), os.path.join(FOLDER, "both.png")
OPTIONS = "pqClientMainWindow/SchlierenFigureOptions"
COLUMNS, ROWS = 120, 90

# The photograph has two pixels for one of the image, begins 12 to the left of it and 6 below, and another k.
HELPERS = f"""
import inside_window
PHOTOGRAPH, BEFORE, BELOW = {PHOTOGRAPH!r}, 12, 6
from PIL import Image
bench, comparison = FindSource("Schlieren1"), FindSource("CompareWithPhotograph1")
image = bench.GetClientSideObject().GetOutputDataObject(0)
def in_image(column, row):
    "The place of a pixel, data units."
    return [image.GetOrigin()[axis] + number * image.GetSpacing()[axis] for axis, number in enumerate((column, row))]
def in_photograph(column, row):
    "Its place in the photograph, pixels."
    return [2 * column + BEFORE + 0.5, 2 * row + BELOW + 0.5]
def on_screen(view, place):
    "The window, and where in it a place of a view is."
    renderer = view.GetRenderer()
    renderer.SetWorldPoint(*place, 0, 1)
    renderer.WorldToDisplay()
    x, y, _ = renderer.GetDisplayPoint()
    viewport = next(one for one in widget("centralwidget").findChildren(QWidget, "Viewport")
                    if one.isVisible() and viewports[view].contains(one.mapTo(widget(), one.rect().center())))
    point = QtCore.QPoint(int(x), viewport.height() - 1 - int(y))
    return widget().windowHandle(), viewport.mapTo(widget(), point)
def frame_of(view):
    name = "Frame.%d" % GetLayout(view).GetViewLocation(view.SMProxy)
    found = next(frame for frame in widget().findChildren(QWidget, name) if frame.isVisible())
    return QtCore.QRect(found.mapTo(widget(), QtCore.QPoint(0, 0)), found.size())
LEFT, NONE = Qt.MouseButton.LeftButton, Qt.KeyboardModifier.NoModifier
def click(view, place):
    window, point = on_screen(view, place)
    QTest.mouseMove(window, point)
    process_events()
    QTest.mouseClick(window, LEFT, NONE, point)
    process_events()
def drag(view, start, end):
    (window, first), (_, last) = on_screen(view, start), on_screen(view, end)
    QTest.mouseMove(window, first)
    process_events()
    QTest.mousePress(window, LEFT, NONE, first)
    process_events()
    for part in (0.5, 1):
        point = first + (last - first) * part
        QApplication.sendEvent(window, QMouseEvent(QEvent.Type.MouseMove, QPointF(point), QPointF(window.mapToGlobal(point)),
                                                   Qt.MouseButton.NoButton, LEFT, NONE))
        process_events()
    QTest.mouseRelease(window, LEFT, NONE, last)
    process_events()
def status():
    return widget().statusBar().currentMessage()
shown_in = {{name: FindView(name) for name in ("CompareWithPhotograph1", "Points in Image", "Points in Photograph")}}
together, points, seen = shown_in.values()
viewports = {{view: frame_of(view) for view in shown_in.values() if view}}
def check_placed(first, second, tolerance):
    "At pixels of the image, to within so many."
    assert comparison.Placement == "Two Points"
    for number, place in ((1, first), (2, second)):
        for name, right, scale in (("Flow", in_image(*place), image.GetSpacing()[0]), ("Photograph", in_photograph(*place), 2)):
            found = comparison.GetPropertyValue(f"{{name}}Point{{number}}")
            assert np.abs(np.array(found) - right).max() < tolerance * scale, (name, number, list(found), right)
"""

user = ViewsSession()
user.choose_filter("Schlieren")
user.choose("ImageSize/LineEdit0", COLUMNS)
user.choose("ImageSize/LineEdit1", ROWS)
user.choose("Quality/ComboBox", "Interactive")
user.apply()
user.python(HELPERS + """
settle_views()
deflection = vtk_to_numpy(image.GetPointData().GetArray("Deflection")).reshape(image.GetDimensions()[1::-1] + (-1,))
inside_window.k = 3 * image.GetFieldData().GetArray("KScale").GetValue(0)
angle = np.deg2rad(bench.KnifeEdgeAngle)
light = np.clip(0.6 + inside_window.k * (np.cos(angle) * deflection[..., 0] + np.sin(angle) * deflection[..., 1]), 0, 1)
inside = np.pad(light.repeat(2, axis=0).repeat(2, axis=1), ((BELOW, 40), (BEFORE, 30)), mode="edge")
Image.fromarray(np.rint(230 * inside[::-1]).astype(np.uint8)).save(PHOTOGRAPH)
inside_window.views_before = len(views())
""")
user.menu("menuSchlieren", "actionPhotograph")
user.event("pqClientMainWindow/OpenPhotograph", "filesSelected", PHOTOGRAPH)
user.python(HELPERS + """
assert all(shown_in.values()), shown_in
assert len(views()) == inside_window.views_before + 3
display = GetDisplayProperties(comparison, together)
assert display.MapScalars == 0 and list(display.ColorArrayName) == ["POINTS", "Comparison"], display.ColorArrayName
assert GetDisplayProperties(comparison.Photograph, seen).MapScalars == 0
assert GetDisplayProperties(bench, points).Visibility == 1
until(lambda: status().startswith("Click two points"))
A, B = (22, 22), (98, 70)
for place in A, B:
    click(points, in_image(*place))
assert comparison.Placement == "Fill Image"
for place in A, (84, 70):
    click(seen, in_photograph(*place))
until(lambda: comparison.Placement == "Two Points")
""")
user.python(HELPERS + """
drag(seen, in_photograph(84, 70), in_photograph(98, 70))
until(lambda: abs(comparison.PhotographPoint2[0] - in_photograph(98, 70)[0]) < 4)
check_placed((22, 22), (98, 70), 2)
assert abs(comparison.FieldData["PhotographK"].GetRange()[0] / inside_window.k - 1) < 0.05
""")
user.python(HELPERS + """
assert comparison.SwipePosition == 0.5
drag(together, in_image(59.5, 45), in_image(29.5, 45))
assert abs(comparison.SwipePosition - 0.25) < 0.02, comparison.SwipePosition
window, point = on_screen(together, in_image(75, 45))
QTest.mouseMove(window, point)
until(lambda: "photograph 0." in status(), 20)
SetActiveSource(comparison)
""")
user.menu("menuSchlieren", "actionCopyK")
user.python(HELPERS + """
k = comparison.FieldData["PhotographK"].GetRange()[0]
assert bench.KMode == "Value" and abs(bench.KScale / k - 1) < 1e-3, (bench.KScale, k)
SetActiveView(together)
""")
user.undo()
user.python(HELPERS + 'assert bench.KMode != "Value"')
user.undo()  # the point that was dragged
user.undo()  # the points
user.python(HELPERS + """
assert comparison.Placement == "Fill Image", comparison.Placement
undo = widget().findChild(QAction, "actionEditUndo")
if "View" in undo.text():  # ParaView notes a first click into a view
    QTimer.singleShot(0, undo.trigger)
    until(lambda: "View" not in undo.text())
assert undo.text() == "&Undo Beside a Photograph", undo.text()
""")
user.undo()
user.python(HELPERS + """
assert comparison is None and not any(shown_in.values()), (comparison, shown_in)
assert len(views()) == inside_window.views_before, views()
assert {name for name, _ in GetSources()} == {"jet", "Schlieren1"}, GetSources()
""")
user.redo()
user.python(HELPERS + """
assert comparison and all(shown_in.values())
assert GetDisplayProperties(comparison, together).MapScalars == 0
""")
user.python(HELPERS + "SetActiveView(together)")
user.menu("menuSchlieren", "actionSaveFigure")
user.event("pqClientMainWindow/SaveSchlierenFigure", "filesSelected", FIGURE)
user.event(f"{OPTIONS}/widget/OKButton", "activate")
user.play(OPEN_JET)

with Image.open(FIGURE) as figure:
    page = np.asarray(figure.convert("L"))
assert page.shape[1] > 2 * 3 * COLUMNS, page.shape
