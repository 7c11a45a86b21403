# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""What is saved is the whole picture: by a screenshot in the middle of a refinement, and by an animation of
the camera that is followed."""

import os

import numpy as np
from follow_testing import SCENE
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader
from window_testing import FOLDER, Session

# A filter that follows nothing, in the place of the one that does.
REFERENCE = """
bench, shadows, turned, shown = by_name("bench", "shadows", "RenderView1", "RenderView2")
import os
import numpy as np
SIZE = [300, 200]
def reference(camera, name):
    position, focus = np.array(camera.GetPosition()), np.array(camera.GetFocalPoint())
    distance = np.linalg.norm(focus - position)
    scripted = FindSource("scripted")
    scripted.SamplesPerPixel = bench.SamplesPerPixel
    scripted.ViewDirection = list((focus - position) / distance)
    scripted.ViewUp = list(camera.GetViewUp())
    scripted.FocalPoint = list(focus)
    scripted.ParallelScale = float(np.linalg.norm(position) * np.tan(np.radians(camera.GetViewAngle()) / 2))
    Hide(bench, shown)
    Show(scripted, shown)
    Render(shown)
    SaveScreenshot(os.path.join(FOLDER, name), shown, ImageResolution=SIZE)
    Hide(scripted, shown)
    Show(bench, shown)
    Render(shown)  # from here on this view follows the camera again
"""

user = Session()

# Turned; a screenshot while there is much left to do.
user.drag_view(1, (0.3, 0.5), (0.4, 0.6), (0.5, 0.6))
user.python(REFERENCE + """
until(lambda: not finished(bench), 20)
SaveScreenshot(os.path.join(FOLDER, "unfinished.png"), shown, ImageResolution=SIZE)
assert finished(bench)
until(lambda: finished(shadows))
reference(turned.GetActiveCamera(), "turned.png")
""")

# Around it in an animation.
user.python(REFERENCE + """
bench.SamplesPerPixel = shadows.SamplesPerPixel = 2
scene = GetAnimationScene()
scene.PlayMode = "Sequence"
scene.NumberOfFrames = 3
track = GetCameraTrack(view=turned)
track.Mode = "Path-based"
first = CameraKeyFrame(
    KeyTime=0, PositionPathPoints=[60, 0, 0, 0, 30, 60, -60, 20, 0, 0, 0, -60], ClosedPositionPath=1,
    FocalPathPoints=[0, 0, 0], ViewUp=[0, 1, 0])
track.KeyFrames = [first, CameraKeyFrame(KeyTime=1)]
SaveAnimation(os.path.join(FOLDER, "orbit.png"), shown, FrameWindow=[0, 2], ImageResolution=SIZE)
for frame in range(3):
    scene.AnimationTime = frame / 2
    camera = turned.GetActiveCamera()
    reference(camera, f"reference{frame}.png")
""")

user.play(SCENE + """
for bench in benches.values():
    bench.SamplesPerPixel = 400
GetColorTransferFunction("Intensity").RescaleTransferFunction(0.0, 1.0)
GetColorTransferFunction("Intensity").AutomaticRescaleRangeMode = "Never"
shown = FindView("RenderView2")
shown.OrientationAxesVisibility = 0
SetActiveSource(None)
scripted = Schlieren(Input=flow, registrationName="scripted", ImageSize=benches["bench"].ImageSize,
                     GladstoneDaleConstant=1e-6, Quality="Draft")
Show(scripted, shown).SetRepresentationType("Slice")
Hide(scripted, shown)
""")


def image(name):
    reader = vtkPNGReader()
    reader.SetFileName(os.path.join(FOLDER, name))
    reader.Update()
    values = vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars()).astype(int)
    assert values.std() > 10, name
    return values


assert np.array_equal(image("unfinished.png"), image("turned.png"))
frames = [image(f"orbit.{frame:04}.png") for frame in range(3)]
for frame, values in enumerate(frames):
    assert np.array_equal(values, image(f"reference{frame}.png")), frame
assert not np.array_equal(frames[0], frames[1]) and not np.array_equal(frames[1], frames[2])
