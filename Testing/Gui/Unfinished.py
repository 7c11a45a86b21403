# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""What is saved is complete: a screenshot in the middle of the refinement of a flow drawn as Schlieren, and an animation
of its camera. What ends while it is being refined: its settings, its visibility, the view, the flow, the program."""

import os

import numpy as np
from views_testing import ViewsSession, png
from window_testing import FOLDER

SIZE = [300, 200]
FLOW = """
flow = Calculator(Input=Wavelet(WholeExtent=3 * [-8, 8]), ResultArrayName="rho", Function="RTData", registrationName="flow")
flow.UpdatePipeline()
Show(flow, turned).SetRepresentationType("Outline")
ResetCamera(turned)
SetActiveSource(flow)
"""
HELPERS = f"""
turned, drawn = by_name("RenderView1", "Schlieren View")
def screenshot(view, name):
    SaveScreenshot(os.path.join(FOLDER, name), view, ImageResolution={SIZE})
"""

user = ViewsSession()
user.press("OneImage")

user.python(HELPERS + """
(display,) = displays()
display.SchlierenBench.SamplesPerPixel = 100
Render(drawn)
until(lambda: " of 100 " in information(display.SchlierenBench, "Status"))
screenshot(drawn, "undrawn.png")
settle_views()
screenshot(drawn, "drawn.png")
""")

# Around it in an animation.
user.python(HELPERS + f"""
(display,) = displays()
display.SchlierenBench.SamplesPerPixel = 2
scene = GetAnimationScene()
scene.PlayMode = "Sequence"
scene.NumberOfFrames = 3
track = GetCameraTrack(view=drawn)
track.Mode = "Path-based"
first = CameraKeyFrame(
    KeyTime=0, PositionPathPoints=[60, 0, 0, 0, 30, 60, -60, 20, 0, 0, 0, -60], ClosedPositionPath=1,
    FocalPathPoints=[0, 0, 0], ViewUp=[0, 1, 0])
track.KeyFrames = [first, CameraKeyFrame(KeyTime=1)]
SaveAnimation(os.path.join(FOLDER, "orbit.png"), drawn, FrameWindow=[0, 2], ImageResolution={SIZE})
for frame in range(3):
    scene.AnimationTime = frame / 2
    Render(drawn)
    assert np.allclose(drawn.GetActiveCamera().GetPosition(), turned.GetActiveCamera().GetPosition())
    screenshot(drawn, f"reference{{frame}}.png")
Delete(track)
Delete(drawn)
""")

STEPS = """
flow, turned = by_name("flow", "RenderView1")
def draw():
    "Draws the flow as Schlieren, and stops in the middle of its refinement."
    display = Show(FindSource("flow"), turned)
    display.SetRepresentationType("Schlieren")
    display.SchlierenBench.SamplesPerPixel = 4000
    Render(turned)
    until(lambda: " of 4000 " in information(display.SchlierenBench, "Status"))
    return display
"""
user.python(STEPS + """
display = draw()
bench = display.SchlierenBench
bench.KnifeEdgeAngle = 90
bench.SamplesPerPixel = 2
Render(turned)
settle_views()
assert information(bench, "Status").startswith("2 samples"), information(bench, "Status")

draw()
Hide(flow, turned)
Render(turned)
pause(0.2)
count = information(bench, "ImageCount")
pause(0.3)
assert information(bench, "ImageCount") == count

LoadPlugin(os.environ["SCHLIEREN_PLUGIN"], remote=False, ns=globals())
draw()
pause(0.2)

# A filter of the same flow, complete at once.
made = Schlieren(Input=flow, registrationName="bench", ImageSize=[96, 96], GladstoneDaleConstant=1e-6)
made.UpdatePipeline()
assert finished(made)
Delete(made)
del made

display.SetRepresentationType("Outline")
Render(turned)
display.SetRepresentationType("Schlieren")
draw()
Delete(turned)
pause(0.2)

turned = CreateView("RenderView", registrationName="RenderView1")
AssignViewToLayout(turned)
Show(flow, turned)
ResetCamera(turned)
draw()
Delete(flow)
del flow
pause(0.2)
""" + FLOW + """
draw()
""")
user.play("""
from paraview.simple import *
turned = GetActiveViewOrCreate("RenderView")
""" + FLOW)


def image(name):
    values = png(os.path.join(FOLDER, name))
    assert values.std() > 10, name
    return values


assert np.array_equal(image("undrawn.png"), image("drawn.png"))
frames = [image(f"orbit.{frame:04}.png") for frame in range(3)]
for frame, values in enumerate(frames):
    assert np.array_equal(values, image(f"reference{frame}.png")), frame
assert not np.array_equal(frames[0], frames[1]) and not np.array_equal(frames[1], frames[2])
