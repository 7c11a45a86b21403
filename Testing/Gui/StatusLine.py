# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The line at the lower left of a picture's view: what the picture is made of, as the filter tells it; inside
the view however narrow that is, and gone where it does not belong."""

import os

from views_testing import FOLDER, INSIDE, OPEN_JET, ViewsSession

REPORT = os.path.join(FOLDER, "report.txt")
with open(REPORT, "w", encoding="utf-8"):
    pass

user = ViewsSession()
user.press("OnePicture")

# What is asked is asked within the window. Its frames are numbered as the views were made.
STEPS = f"""
import re
bench, scene, flat = by_name("Schlieren1", "RenderView1", "RenderView2")
view = widget("Frame.2", "Viewport")
def line(frame=2):
    return widget(f"Frame.{{frame}}", "Viewport", "SchlierenStatus")
def is_shown(frame=2):
    return line(frame) is not None and line(frame).isVisible()
def check_place():
    "In the corner, with as much room on the left as below, and inside the view."
    left, top, width, height = line().geometry().getRect()
    below = view.height() - top - height
    assert 0 < left == below < 20, (left, below)
    assert top >= 0 and left + width <= view.width() - left, (top, left, width)
    return width, height
def report(text):
    with open({REPORT!r}, "a") as file:
        file.write(text + "\\n")
"""
user.python(STEPS + """
until(lambda: finished(bench) and is_shown() and line().text() == information(bench, "Status"))
told = line().text()
rays = "[0-9.]+ (million )?rays/s on (CPU .[0-9]+ threads?.|CUDA), "
assert re.match("[0-9]+ samples? per pixel, " + rays, told), told
assert not is_shown(1), "There is a line in the 3-D view"
check_place()
report("finished")

# A picture that is still becoming better tells how far it is.
bench.SamplesPerPixel = 4000
scene.CameraPosition = [0.2, 0.1, scene.CameraPosition[2]]
Render(scene)
until(lambda: re.match("[0-9]+ of 4000 samples per pixel, ", line().text()))
assert not finished(bench)
bench.SamplesPerPixel = 3
Render(flat)
until(lambda: finished(bench) and line().text() == information(bench, "Status"))
assert line().text().startswith("3 samples per pixel, "), line().text()
report("refined")

# In a narrow view it has more lines.
wide, low = check_place()
layout = GetLayout(flat)
layout.SetSplitFraction(0, 0.8)
until(lambda: view.width() < 0.6 * wide)
narrow, high = check_place()
assert narrow < wide and high > 1.5 * low, (wide, low, narrow, high)
layout.SetSplitFraction(0, 0.97)
until(lambda: view.width() < narrow and not is_shown())
layout.SetSplitFraction(0, 0.5)
until(lambda: view.width() > wide and is_shown())
assert check_place() == (wide, low)
report("narrow")

Hide(bench, flat)
until(lambda: not is_shown())
Show(bench, flat)
until(is_shown)
check_place()
report("hidden")

flat.InteractionMode = "3D"
Render(flat)
until(lambda: not is_shown())
flat.InteractionMode = "2D"
Render(flat)
until(is_shown)
report("3-D")

Delete(bench)
until(lambda: not is_shown())
report("deleted")
""")
user.play(INSIDE + OPEN_JET)

with open(REPORT, encoding="utf-8") as file:
    steps = file.read().split("\n")
assert steps == ["finished", "refined", "narrow", "hidden", "3-D", "deleted", ""], steps
