# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The toolbar on data in a plane, which ParaView shows in its 2-D mode, from far away: all views keep that mode, and the
data fill them as before."""

import numpy as np
from views_testing import ViewsSession, load, screenshot, views

SIZE = [360, 270]
PLANE = """
from paraview.simple import *
wave = Wavelet(WholeExtent=[-40, 40, -20, 20, 0, 0], registrationName="wave")
plane = Calculator(Input=wave, Function="1e-3*RTData+1", ResultArrayName="rho", registrationName="plane")
plane.UpdatePipeline()
view = GetActiveViewOrCreate("RenderView")
display = Show(plane, view)
ColorBy(display, ("POINTS", "rho"))
view.ResetCamera()
# As when a plane is applied.
view.InteractionMode = "2D"
view.CameraPosition = [0, 0, 10000]
view.CameraFocalPoint = [0, 0, 0]
SetActiveSource(plane)
Render(view)
"""

user = ViewsSession()
user.python("import inside_window\ninside_window.scale = GetActiveView().CameraParallelScale")
CHECK = """
import inside_window
(_, scene), (_, view) = views()
check_linked_now(scene, view)
for one in (scene, view):
    # A view that has become narrower steps back.
    assert one.InteractionMode == "2D" and inside_window.scale <= one.CameraParallelScale < 3 * inside_window.scale
drawn(FindSource("plane"), view)
"""
user.press("OneImage")
user.python(CHECK)
user.undo()
user.redo()
user.python(CHECK + "settle_soon()")
user.save_state("redone.pvsm")
user.play(PLANE)


def seen(view, name):
    """How much of the view the data fill, by columns and rows, and what is there."""
    view.OrientationAxesVisibility = view.CenterAxesVisibility = 0
    pixels = screenshot(view, name, SIZE)
    differs = np.abs(pixels - pixels[0, 0]).max(axis=2) > 20
    return differs.any(axis=0).mean(), differs.any(axis=1).mean(), pixels


load("redone.pvsm")
(_, scene), (_, view) = views()
across, up, _ = seen(scene, "scene.png")
of_image, up_image, pixels = seen(view, "image.png")
assert across > 0.3 and up > 0.2 and of_image > 0.3 and up_image > 0.2, (across, up, of_image, up_image)
assert pixels.std() > 10, pixels.std()
