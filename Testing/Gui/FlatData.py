# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The toolbar on data in a plane, which ParaView shows in its 2-D mode, from far away: all views keep that mode, and the
data fill them as before."""

import numpy as np
from views_testing import FOLDER, ViewsSession, check_linked, drawn, load, screenshot, simple, views

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
user.save_state("before.pvsm")
user.press("OneImage")
user.python("settle_views()")
user.save_state("added.pvsm")
user.undo()
user.redo()
user.python("settle_views()")
user.save_state("redone.pvsm")
user.play(PLANE)


def seen(view, name):
    """How much of the view the data fill, by columns and rows, and what is there."""
    view.OrientationAxesVisibility = view.CenterAxesVisibility = 0
    pixels = screenshot(view, name, SIZE)
    differs = np.abs(pixels - pixels[0, 0]).max(axis=2) > 20
    return differs.any(axis=0).mean(), differs.any(axis=1).mean(), pixels


load("before.pvsm")
((_, scene),) = views()
scale = scene.CameraParallelScale
for state in ("added.pvsm", "redone.pvsm"):
    load(state)
    (_, scene), (_, view) = views()
    check_linked(state, scene, view)
    for one in (scene, view):
        assert one.InteractionMode == "2D", (state, one.InteractionMode)
        # A view that has become narrower steps back.
        assert scale <= one.CameraParallelScale < 3 * scale, (state, one.CameraParallelScale)
    drawn(simple.FindSource("plane"), view)
    across, up, _ = seen(scene, f"scene_{state}.png")
    ofImage, upImage, pixels = seen(view, f"image_{state}.png")
    print(state, FOLDER, across, up, ofImage, upImage)
    assert across > 0.3 and up > 0.2 and ofImage > 0.3 and upImage > 0.2
    assert pixels.std() > 10, pixels.std()
