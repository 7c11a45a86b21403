# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""One click on the toolbar: the picture of a flow beside its volume, with all that is chosen for the user;
undone and redone in one step, kept in state files and in the Python trace."""

import numpy as np
from views_testing import (OPEN_JET, TRACE_FIRST_STEP, ViewsSession, check_baseline, check_camera,
                           check_display, check_picture_view, filters, frame, load, picture, play_trace,
                           screenshot, shown, simple, values, views)
from plugin_testing import Schlieren

user = ViewsSession()
user.check_button("Follow", "enabled", "false")
user.save_state("before.pvsm")
user.press("OnePicture")
user.check_button("Follow", "checked", "true")
user.save_state("added.pvsm")
user.undo()
user.save_state("undone.pvsm")
user.redo()
user.save_state("redone.pvsm")
user.play(OPEN_JET + TRACE_FIRST_STEP)


def check_session():
    """What one click makes; returns the filter and its values."""
    (left, scene), (right, flat) = views()
    assert (left, right) == (1, 2)
    (bench,) = filters().values()
    assert bench.Input == simple.FindSource("jet")
    assert bench.Density == ["POINTS", "rho"] and bench.IndexModel == "Gladstone-Dale"
    assert bench.AutoKScale == 1 and bench.Quality == "Interactive"
    name = scene.SMProxy.GetSessionProxyManager().GetProxyName("views", scene.SMProxy)
    assert bench.FollowedView == name, (bench.FollowedView, name)
    check_camera(bench, scene)
    check_display(shown(bench, flat))
    check_picture_view(flat, bench)
    width, height = bench.ImageSize
    assert 64 <= width <= 1024 and 64 <= height <= 1024

    volume = simple.GetRepresentation(simple.FindSource("jet"), scene)
    assert volume.Representation == "Volume" and volume.Visibility == 1
    assert list(volume.ColorArrayName)[:2] == ["POINTS", "rho"]
    points = np.reshape(volume.ScalarOpacityFunction.Points, (-1, 4))
    clear = points[points[:, 1] == 0, 0]
    assert len(clear) == 1 and abs(clear[0] - 1.18) < 0.02, "The air around the jet is not clear"
    assert 0.2 < points[:, 1].max() <= 1
    return bench, values(bench)


load("added.pvsm")
bench, added = check_session()
(_, scene), (_, flat) = views()

# The picture is that of a script which sets everything itself.
jet = simple.FindSource("jet")
eye, focus = np.array(scene.CameraPosition), np.array(scene.CameraFocalPoint)
by_script = Schlieren(
    Input=jet, Density=["POINTS", "rho"], ImageSize=bench.ImageSize, ViewDirection=focus - eye,
    ViewUp=scene.CameraViewUp, FocalPoint=focus,
    ParallelScale=np.linalg.norm(focus - eye) * np.tan(np.radians(15)))
assert np.abs(picture(bench, "Intensity") - picture(by_script, "Intensity")).max() < 1e-5
intensity = picture(bench, "Intensity")
simple.Delete(by_script)

# And it is what the view shows: rows and columns of the picture are those of the view.
columns, rows = bench.ImageSize
seen = screenshot(flat, "as_large.png", [columns, rows])
assert np.ptp(seen, axis=2).max() <= 1
inside = np.s_[2:-2, 2:-2]
difference = np.abs(seen[..., 0] / 255 - np.clip(intensity, 0, 1))[inside]
assert difference.mean() < 0.01, difference.mean()

# At a size of its own, so that no window's size matters.
frame(bench, flat, [360, 270], 0.015)
check_baseline(flat, "WindowAddView.png", [360, 270])

# All of it is undone, also what is shown in the 3-D view and how.
load("before.pvsm")
camera = simple.GetRenderViews()[0].CameraPosition[:]
load("undone.pvsm")
assert not filters()
((cell, view),) = views()
assert cell == 0 and np.allclose(view.CameraPosition, camera)
outline = simple.GetRepresentation(simple.FindSource("jet"), view)
assert outline.Representation == "Outline"
assert not list(outline.ColorArrayName)[1]

load("redone.pvsm")
_, redone = check_session()
assert redone == added, [(name, added[name], redone[name]) for name in added
                         if added[name] != redone[name]]

# The trace makes the same from the same beginning.
play_trace("traced.pvsm", OPEN_JET)
load("traced.pvsm")
bench, traced = check_session()
assert traced == added, [(name, added[name], traced[name]) for name in added
                         if added[name] != traced[name]]
assert np.abs(picture(bench, "Intensity") - intensity).max() < 1e-5
