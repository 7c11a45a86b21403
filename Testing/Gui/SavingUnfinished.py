# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""What is saved is complete: a screenshot in the middle of the refinement of a flow drawn as Schlieren, and an animation
of its camera."""

import os

import numpy as np
from views_testing import ViewsSession, png
from filter_testing import SCENE
from window_testing import FOLDER

SIZE = [300, 200]
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
until(lambda: " of 100 " in information(display.SchlierenBench, "Status"), 20)
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
""")
user.play(SCENE + """
SetActiveView(turned)
SetActiveSource(flow)
""")


def image(name):
    values = png(os.path.join(FOLDER, name))
    assert values.std() > 10, name
    return values


assert np.array_equal(image("undrawn.png"), image("drawn.png"))
frames = [image(f"orbit.{frame:04}.png") for frame in range(3)]
for frame, values in enumerate(frames):
    assert np.array_equal(values, image(f"reference{frame}.png")), frame
assert not np.array_equal(frames[0], frames[1]) and not np.array_equal(frames[1], frames[2])
