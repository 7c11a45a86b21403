# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""A 3-D view turned and zoomed by mouse: the flow that a linked view beside it draws as Schlieren is seen from there, too,
coarse while the mouse is down, then complete and as a script makes it. The same from the other view, and by a script.
With an argument, where a server makes the images; skipped without pvserver."""

import json
import os
import sys

import numpy as np
from views_testing import (FOLDER, INSIDE, OPEN_JET, ViewsSession, check_baseline, check_linked, drawn, frame_view, load,
                           simple, views)
from representation_testing import GREY_LEVEL, filter_like, pixels_of
from server_testing import play

SIZE = [270, 270]
is_remote = len(sys.argv) > 1
LOG = os.path.join(FOLDER, "reductions.json")

user = ViewsSession()


def keep(step):
    user.python("settle_views()")
    user.save_state(step + ".pvsm")


user.press("OneImage")
user.python("""
import inside_window
for view in GetRenderViews():
    view.CameraParallelProjection = 1
(display,) = displays()
display.SchlierenBench.Quality = "Interactive"  # which makes images faster
Render()
settle_views()
# What the linked view shows.
inside_window.LOG = []
def note(*_):
    inside_window.LOG.append(information(display, "SchlierenReduction"))
FindView("Schlieren View").SMProxy.AddObserver("EndEvent", note)
""")
keep("first")
WAY = ((0.3, 0.5), (0.35, 0.55), (0.4, 0.6), (0.45, 0.6), (0.5, 0.6))
user.drag_view(1, *WAY)
keep("turned")
user.python(f"""
import inside_window, json
with open({LOG!r}, "w") as file:
    json.dump(inside_window.LOG, file)
""")
user.drag_view(1, (0.5, 0.5), (0.5, 0.45), (0.5, 0.4), button=2)
keep("zoomed")
user.drag_view(2, (0.5, 0.5), (0.4, 0.45), (0.3, 0.4))
keep("back")
user.python("""
view = FindView("RenderView1")
view.CameraPosition = [0.1, 0.03, 0.02]
view.CameraParallelScale = 0.02
Render(view)
""")
keep("script")

play(user, INSIDE + OPEN_JET, is_remote)

cameras, images = {}, {}
for step in ("first", "turned", "zoomed", "back", "script"):
    load(step + ".pvsm")
    (_, scene), (_, view) = views()
    check_linked(step + ".pvsm", scene, view)
    view.OrientationAxesVisibility = 0
    display = drawn(simple.FindSource("jet"), view)
    display.SchlierenLegend = 0
    images[step] = pixels_of(view, SIZE)
    assert np.abs(images[step] - filter_like(display, view, SIZE)).max() <= GREY_LEVEL, step
    cameras[step] = view.GetActiveCamera().GetDirectionOfProjection(), view.CameraParallelScale
    if step == "turned":
        turned_up = view.GetActiveCamera().GetViewUp()
steps = list(images)
for earlier, later in zip(steps, steps[1:]):
    assert np.abs(images[earlier] - images[later]).max() > 20, later
assert np.allclose(cameras["turned"][0], cameras["zoomed"][0]) and cameras["turned"][1] != cameras["zoomed"][1]
assert np.allclose(cameras["script"][0], -np.array([0.1, 0.03, 0.02]) / np.linalg.norm([0.1, 0.03, 0.02]), atol=0.2)
with open(LOG, encoding="utf-8") as file:
    reductions = json.load(file)
assert len(reductions) > 4 and (is_remote or (max(reductions) > 1 and reductions[-1] == 1)), reductions


def turned_by(way):
    """The direction and the up of a camera that looked along -z: a mouse that goes all over the view turns it
    once around; up and down is seen from below the top (y is downwards)."""
    direction, up = np.array([0., 0, -1]), np.array([0., 1, 0])
    for (x0, y0), (x1, y1) in zip(way, way[1:]):
        right = np.cross(direction, up)
        direction, up = (about(up, x0 - x1, about(right, y0 - y1, vector)) for vector in (direction, up))
    return direction, up


def about(axis, turns, vector):
    """The vector turned around the axis, of length 1, counterclockwise."""
    angle = 2 * np.pi * turns
    return (vector * np.cos(angle) + np.cross(axis, vector) * np.sin(angle)
            + axis * (axis @ vector) * (1 - np.cos(angle)))


# The drag was rounded to pixels of the window; in the image it is not.
direction, up = turned_by(WAY)
assert np.allclose(cameras["turned"][0], direction, atol=np.radians(3))
assert np.allclose(turned_up, up, atol=np.radians(3))
load("turned.pvsm")
(_, (_, view)) = views()
view.CameraPosition = list(np.array(view.CameraFocalPoint) - direction)
view.CameraViewUp = list(up)
frame_view(view, 0.015)
check_baseline(view, "WindowLinkedCameras.png", SIZE)
