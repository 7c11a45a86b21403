# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Turns a flow in ParaView's window and measures how well its schlieren image keeps up, that of a linked view beside it and
that of the view itself: see README.md."""

import os
import sys
import tempfile

SOURCE = os.environ["SCHLIEREN_SOURCE_DIR"]
os.environ.setdefault("SCHLIEREN_TEST_OUTPUT", tempfile.mkdtemp(prefix="schlieren"))
os.environ.setdefault("SCHLIEREN_PARAVIEW", "paraview")
sys.path.insert(0, os.path.join(SOURCE, "Testing", "Gui"))

from window_testing import Session  # noqa: E402

SECONDS = float(sys.argv[1]) if len(sys.argv) > 1 else 10
REPORT = os.path.join(os.environ["SCHLIEREN_TEST_OUTPUT"], "report.txt")

SCENE = """
import os, sys
sys.path.insert(0, os.path.join(os.environ["SCHLIEREN_SOURCE_DIR"], "Testing", "Gui"))
from paraview.simple import *
flow = Wavelet(WholeExtent=3 * [-128, 127], registrationName="flow")
flow.UpdatePipeline()
turned = GetActiveViewOrCreate("RenderView")
Show(flow, turned).SetRepresentationType("Outline")
ColorBy(GetDisplayProperties(flow, turned), ("POINTS", "RTData"))
ResetCamera(turned)
layout = GetLayout(turned)
layout.SplitHorizontal(0, 0.5)
view = CreateView("RenderView", UseFXAA=0, OrientationAxesVisibility=0, CenterAxesVisibility=0)
AssignViewToLayout(view, layout, 2)
display = Show(flow, view)
display.SchlierenBench.Density = ["POINTS", "RTData"]
display.SchlierenBench.GladstoneDaleConstant = 1e-6
display.SetRepresentationType("Schlieren")
AddCameraLink(turned, view, "turned")
SetActiveSource(flow)
Render(view)
"""

TURN = f"""
import math
import time
flow, turned, shown = by_name("flow", "RenderView1", "RenderView2")
mouse = turned.GetInteractor()
images = []

def rows_of_image(image_of):
    return image_of.GetClientSideObject().GetOutputDataObject(0).GetDimensions()[1]

image_of = GetDisplayProperties(flow, shown).SchlierenBench

def note(*_):
    images.append((time.perf_counter(), rows_of_image(image_of)))
observed = shown.SMProxy.AddObserver("EndEvent", note)

def mouse_event(event, x, y):
    width, height = mouse.GetSize()
    mouse.SetEventInformation(int(x * width), int(y * height), 0, 0, chr(0), 0, None)
    mouse.InvokeEvent(event)

def turn(what):
    "A circle with the mouse, sixty movements a second as far as there is time."
    mouse_event("LeftButtonPressEvent", 0.7, 0.5)
    images.clear()
    begin = last = time.perf_counter()
    frames = []
    while last < begin + {SECONDS}:
        last = time.perf_counter()
        angle = last - begin
        mouse_event("MouseMoveEvent", 0.5 + 0.2 * math.cos(angle), 0.5 + 0.2 * math.sin(angle))
        frames.append(time.perf_counter() - last)
        while True:
            process_events()
            if time.perf_counter() > last + 1 / 60:
                break
            time.sleep(1e-3)
    seconds = time.perf_counter() - begin
    previews = list(images)
    images.clear()
    mouse_event("LeftButtonReleaseEvent", 0.5, 0.5)
    released = time.perf_counter()
    blocked = []
    while True:
        blocked.append(process_events())
        if any(rows == whole_rows for _, rows in images) and finished(image_of):
            break
    ended = time.perf_counter()
    whole = [when for when, rows in images if rows == whole_rows]
    rows = sorted(rows for _, rows in previews)
    frames.sort()
    blocked.sort()
    with open({REPORT!r}, "a") as file:
        file.write(
            f"{{what:48}} {{len(previews) / seconds:6.1f}} images/s of {{rows[len(rows) // 2]}} rows, "
            f"{{len(frames) / seconds:5.1f}} frames/s of the 3-D view, {{1e3 * frames[len(frames) // 2]:.0f}} ms "
            f"each; first complete image {{1e3 * (whole[0] - released):.0f}} ms after release, "
            f"last after {{ended - released:.2f}} s in {{len(whole)}} images; blocked "
            f"{{1e3 * blocked[-1]:.0f}} ms at most, then {{1e3 * blocked[-2]:.0f}}\\n")
    pause(1)

def turn_with(view, projection):
    global whole_rows
    whole_rows = view.ViewSize[1]
    for quality in "Interactive", "Fine", "Publication":
        image_of.Quality = quality
        Render(view)
        until(lambda: finished(image_of) and rows_of_image(image_of) == whole_rows)
        pause(1)
        turn(f"{{GetDisplayProperties(flow, turned).Representation}}, {{projection}}, "
             f"{{view.ViewSize[0]}} x {{whole_rows}}, {{quality}}")

for display in "Outline", "Volume":
    GetDisplayProperties(flow, turned).SetRepresentationType(display)
    Render(turned)
    turn_with(shown, "perspective")

# The same data drawn as Schlieren in the view itself.
shown.SMProxy.RemoveObserver(observed)
RemoveCameraLink("turned")
Delete(shown)
layout = GetLayout(turned)
layout.Collapse(2)
layout.SplitHorizontal(0, 0.5)
pause(1)
display = GetDisplayProperties(flow, turned)
image_of = display.SchlierenBench
image_of.Density = ["POINTS", "RTData"]
image_of.GladstoneDaleConstant = 1e-6
display.SetRepresentationType("Schlieren")
turned.SMProxy.AddObserver("EndEvent", note)
for is_parallel, projection in enumerate(("perspective", "parallel")):
    turned.CameraParallelProjection = is_parallel
    turn_with(turned, projection)
"""

user = Session()
user.python(TURN)
user.play(SCENE, seconds=3600)
with open(REPORT, encoding="utf-8") as file:
    print(file.read())
