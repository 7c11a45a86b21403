# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The line at the upper left of a view: what its image is made of, as the filter or the representation says; inside
the view however narrow that is, and gone where it does not belong."""

from window_testing import OPEN_JET, ViewsSession

user = ViewsSession()
user.press("OneImage")

# What is checked is checked within the window. Its frames have the numbers of their cells in the layout.
HELPERS = """
import re
def said(bench):
    "The status without speed and device."
    status = information(bench, "Status")
    short = re.sub(", [0-9.]+ (million )?rays/s on (CPU .[0-9]+ threads?.|CUDA)", "", status)
    assert short != status, status
    return short
def line(frame=2):
    return widget(f"Frame.{frame}", "Viewport", "SchlierenStatus")
def is_shown(frame=2):
    return line(frame) is not None and line(frame).isVisible()
def check_place(frame=2):
    "In the corner, with as much room on the left as above, and inside the view."
    view = widget(f"Frame.{frame}", "Viewport")
    left, top, width, height = line(frame).geometry().getRect()
    assert 0 < left == top < 20, (left, top)
    assert top + height <= view.height() and left + width <= 0.6 * view.width(), (top, left, width)
    return width, height
"""
user.python(HELPERS + """
scene, drawn = by_name("RenderView1", "Schlieren View")
(display,) = displays()
bench = display.SchlierenBench
settle_views()
until(lambda: is_shown() and line().text() == said(bench))
assert re.match("[0-9]+ samples? per pixel, refracted rays", line().text()), line().text()
assert not is_shown(1), "There is a line beside the volume"
check_place()

# Turned, the image is refined anew, and the line says how complete it is.
bench.SamplesPerPixel = 4000
scene.CameraPosition = [0.2, 0.1, scene.CameraPosition[2]]
Render(scene)
until(lambda: re.match("[0-9]+ of 4000 samples per pixel, ", line().text()))
bench.SamplesPerPixel = 3
Render(drawn)
until(lambda: line().text().startswith("3 samples per pixel, "))

Hide(display.Input, drawn)
until(lambda: not is_shown())
Show(display.Input, drawn)
Render(drawn)
until(is_shown)
display.SetRepresentationType("Outline")
Render(drawn)
until(lambda: not is_shown())
""")

# Switched off and on in the menu.
user.menu("menuSchlieren", "actionStatus")
user.python(HELPERS + """
GetDisplayProperties(FindSource("jet"), FindView("Schlieren View")).SetRepresentationType("Schlieren")
settle_views()
pause(0.3)
assert not is_shown()
""")
user.menu("menuSchlieren", "actionStatus")
user.python(HELPERS + """
until(is_shown)
GetDisplayProperties(FindSource("jet"), FindView("Schlieren View")).SetRepresentationType("Outline")
""")

user.choose_filter("Schlieren")
user.choose("ImageSize/LineEdit0", "64")
user.choose("ImageSize/LineEdit1", "64")
user.choose("Quality/ComboBox", "Interactive")
user.apply()
user.python(HELPERS + """
bench, flat = by_name("Schlieren1", "Image of Schlieren1")
view = widget("Frame.6", "Viewport")
until(lambda: finished(bench) and is_shown(6) and line(6).text() == said(bench))
assert re.match("[0-9]+ samples? per pixel, refracted rays", line(6).text()), line(6).text()
bench.SamplesPerPixel = 3
Render(flat)
until(lambda: finished(bench) and line(6).text() == said(bench))
assert line(6).text().startswith("3 samples per pixel, "), line(6).text()

# In a narrow view it has more lines.
layout = GetLayout(flat)
split = (layout.GetViewLocation(flat.SMProxy) - 1) // 2
layout.SetSplitFraction(split, 0.3)
until(lambda: is_shown(6))
pause(0.5)
wide, low = check_place(6)
layout.SetSplitFraction(split, 0.75)
until(lambda: view.width() < 0.6 * wide)
narrow, high = check_place(6)
assert narrow < wide and high > 1.5 * low, (wide, low, narrow, high)
layout.SetSplitFraction(split, 0.97)
until(lambda: view.width() < narrow and not is_shown(6))
layout.SetSplitFraction(split, 0.3)
until(lambda: view.width() > wide and is_shown(6))
assert check_place(6) == (wide, low)

Hide(bench, flat)
until(lambda: not is_shown(6))
Show(bench, flat)
until(lambda: is_shown(6))
check_place(6)
flat.InteractionMode = "3D"
Render(flat)
until(lambda: not is_shown(6))
flat.InteractionMode = "2D"
Render(flat)
until(lambda: is_shown(6))

Delete(bench)
until(lambda: not is_shown(6))
""")
user.play(OPEN_JET)
