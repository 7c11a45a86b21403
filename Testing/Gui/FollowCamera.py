# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Pictures follow the camera of a 3-D view: rough while the mouse is down, then as a script makes them."""

import os

import numpy as np
from follow_testing import SCENE, SIZE, saved, scripted
from views_testing import check_baseline, frame, load, show_grey, simple, views
from plugin_testing import Schlieren, output
from vtkmodules.util.numpy_support import vtk_to_numpy
from window_testing import FOLDER, PANEL, Session

LOG = os.path.join(FOLDER, "rendered.txt")
open(LOG, "w", encoding="utf-8").close()
SAVE = """
bench, shadows, turned, shown, other = by_name(
    "bench", "shadows", "RenderView1", "RenderView2", "RenderView3")
pause(0.3)
settle(bench, shadows)
save("{0}", bench, turned, shown)
save("{0}Shadows", shadows, turned, other)
"""

user = Session()
user.python(SAVE.format("first"))

# Turned by mouse; then zoomed, with the right button.
WAY = ((0.3, 0.5), (0.35, 0.55), (0.4, 0.6), (0.45, 0.6), (0.5, 0.6))
user.drag_view(1, *WAY)
user.python(SAVE.format("turned") + "open(" + repr(LOG) + ", 'a').write('released and refined\\n')")
user.save_state("turned.pvsm")
user.lines.append(f'<pqcheck object="{PANEL}/Accept" property="enabled" arguments="false"/>')
user.drag_view(1, (0.5, 0.5), (0.5, 0.45), (0.5, 0.4), button=2)
user.python(SAVE.format("zoomed"))

# The picture's own view, moved and magnified, stays like that over the picture.
user.python("""
shown = FindViewOrCreate("RenderView2", "RenderView")
position, focus = shown.CameraPosition, shown.CameraFocalPoint
shown.CameraPosition = [position[0] + 1, position[1] - 2, position[2]]
shown.CameraFocalPoint = [focus[0] + 1, focus[1] - 2, focus[2]]
shown.CameraParallelScale /= 2
Render(shown)
""" + SAVE.format("moved"))
user.drag_view(1, (0.5, 0.5), (0.4, 0.45), (0.3, 0.4))
user.python(SAVE.format("movedOn"))

# Without a mouse.
user.python("""
turned = FindViewOrCreate("RenderView1", "RenderView")
ResetCamera(turned)
turned.CameraParallelProjection = 1
turned.CameraParallelScale = 5
Render(turned)
""" + SAVE.format("parallel"))

# No longer.
user.choose("FollowedView/Choice", "None")
user.apply()
user.drag_view(1, (0.5, 0.5), (0.4, 0.45), (0.3, 0.4))
user.python(SAVE.format("off"))

user.play(SCENE + f"""
# What has been shown in RenderView2.
def note(*_):
    with open({LOG!r}, "a") as file:
        rows = benches["bench"].GetClientSideObject().GetOutputDataObject(0).GetDimensions()[1]
        file.write(f"{{rows}}\\n")
FindViewOrCreate("RenderView2", "RenderView").SMProxy.AddObserver("EndEvent", note)
""")


def is_scripted(name, camera, bench="bench"):
    """Whether a kept picture is the one of a script with a kept camera."""
    made = output(scripted(simple, Schlieren, saved(camera), bench))
    values = vtk_to_numpy(made.GetPointData().GetArray("Intensity"))
    kept = saved(name)
    assert tuple(kept["dimensions"]) == made.GetDimensions(), kept["dimensions"]
    return np.allclose(kept["origin"], made.GetOrigin(), atol=1e-9) and \
        np.abs(values - kept["intensity"]).max() < 1e-6


for step in ("first", "turned", "zoomed", "moved", "movedOn", "parallel"):
    assert is_scripted(step, step), step
    assert is_scripted(step + "Shadows", step, "shadows"), step
    assert saved(step)["reduction"] == 1 and saved(step)["limit"] == 0
assert not is_scripted("turned", "first") and not is_scripted("zoomed", "turned")
assert is_scripted("off", "parallel") and not is_scripted("off", "off")
assert is_scripted("offShadows", "off", "shadows")

# While the mouse was down, there were pictures of fewer rows, then whole ones.
with open(LOG, encoding="utf-8") as file:
    rows = file.read().split("released and refined")[0].split()
rows = np.array(rows, dtype=int)
assert rows[-1] == SIZE and (rows < SIZE).sum() >= 1, rows


def relation(name):
    """Where the middle of the picture's own view is over the picture, and how large it is shown."""
    kept = saved(name)
    right = np.cross(kept["direction"], kept["up"])
    right /= np.linalg.norm(right)
    up = np.cross(right, kept["direction"])
    up /= np.linalg.norm(up)
    center = np.array([kept["focus"] @ right, kept["focus"] @ up])
    return np.append((kept["focal_point1"][:2] - center) / kept["scale"],
                     kept["parallel_scale1"] / kept["scale"])


for step in ("turned", "zoomed"):
    assert np.allclose(relation(step), relation("first"), atol=1e-3), relation(step)
assert not np.allclose(relation("moved"), relation("first"), atol=1e-1)
for step in ("movedOn", "parallel"):
    assert np.allclose(relation(step), relation("moved"), atol=1e-3), relation(step)


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


# What has been seen after the mouse was released; the drag was rounded to pixels of the window.
load("turned.pvsm")
bench, ((_, view),) = simple.FindSource("bench"), [pair for pair in views() if pair[0] == 5]
direction, up = turned_by(WAY)
for name, expected in (("ViewDirection", direction), ("ViewUp", up)):
    assert np.allclose(bench.GetPropertyValue(name), expected, atol=np.radians(3)), name
bench.ViewDirection, bench.ViewUp = list(direction), list(up)
show_grey(bench, view)
frame(bench, view, [270, 270], 14)
check_baseline(view, "WindowFollowCamera.png", [270, 270])
