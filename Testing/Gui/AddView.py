# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""One click on the toolbar: a flow drawn as Schlieren beside its volume, with all that is chosen for the user;
undone and redone in one step, kept in state files and in the Python trace."""

import os
import re

import numpy as np
from views_testing import (FOLDER, OPEN_JET, TRACE_FIRST_STEP, ViewsSession, check_baseline, check_linked, drawn,
                           frame_view, load, play_trace, simple, values, views)
from representation_testing import GREY_LEVEL, filter_like, pixels_of

SIZE = [360, 270]

user = ViewsSession()
user.save_state("before.pvsm")
user.press("OneImage")
user.save_state("added.pvsm")
user.undo()
user.save_state("undone.pvsm")
user.redo()
user.save_state("redone.pvsm")
user.play(OPEN_JET + TRACE_FIRST_STEP)


def check_session(state):
    """What one click makes; returns how it is drawn, and all values."""
    load(state)
    (left, scene), (right, view) = views()
    assert (left, right) == (1, 2)
    assert list(simple.GetSources().values()) == [simple.FindSource("jet")]
    display = drawn(simple.FindSource("jet"), view)
    bench = display.SchlierenBench
    assert bench.Density == ["POINTS", "rho"] and bench.IndexModel == "Gladstone-Dale"
    assert bench.KMode == "Automatic Kept" and bench.Quality == "Automatic"
    check_linked(state, scene, view)
    assert view.InteractionMode == "3D" and view.CenterAxesVisibility == 0

    volume = simple.GetRepresentation(simple.FindSource("jet"), scene)
    assert volume.Representation == "Volume" and volume.Visibility == 1
    assert list(volume.ColorArrayName)[:2] == ["POINTS", "rho"]
    points = np.reshape(volume.ScalarOpacityFunction.Points, (-1, 4))
    clear = points[points[:, 1] == 0, 0]
    assert len(clear) == 1 and abs(clear[0] - 1.18) < 0.02, "The air around the jet is not clear"
    assert 0.2 < points[:, 1].max() <= 1
    return display, values(bench)


display, added = check_session("added.pvsm")
(_, scene), (_, view) = views()

# An empty view has some 150 kB in a state file. Of the two that show the flow, each adds no more than this.
with open(os.path.join(FOLDER, "added.pvsm"), encoding="utf-8") as file:
    benches = re.findall('<Proxy group="schlieren_benches".*?</Proxy>', file.read(), re.DOTALL)
assert len(benches) == 2 and max(len(text) for text in benches) < 40e3, [len(text) for text in benches]

# It is the image of the filter that a script makes, seen in another size than in the window, with a legend.
assert display.SchlierenLegend == 1
frame_view(view, 0.015)
view.ViewSize = SIZE  # a narrow one has no room for the legend
display.SchlierenLegend = 1
with_legend = pixels_of(view, SIZE)
display.SchlierenLegend = 0
assert 0.02 < (np.abs(with_legend - pixels_of(view, SIZE)) > 20).mean() < 0.3
seen = pixels_of(view, SIZE)
assert np.ptp(seen) > 100
assert np.abs(seen - filter_like(display, view, SIZE)).max() <= GREY_LEVEL
check_baseline(view, "WindowAddView.png", SIZE)

# All of it is undone, also what is shown in the 3-D view and how.
load("before.pvsm")
camera = simple.GetRenderViews()[0].CameraPosition[:]
load("undone.pvsm")
((cell, view),) = views()
assert cell == 0 and np.allclose(view.CameraPosition, camera)
outline = simple.GetRepresentation(simple.FindSource("jet"), view)
assert outline.Representation == "Outline"
assert not list(outline.ColorArrayName)[1]
with open(os.path.join(FOLDER, "undone.pvsm"), encoding="utf-8") as file:
    assert "<CameraLink name=" not in file.read(), "The link outlives its views"

_, redone = check_session("redone.pvsm")
assert redone == added, [(name, added[name], redone[name]) for name in added
                         if added[name] != redone[name]]

# The trace makes the same from the same beginning.
play_trace("traced.pvsm", OPEN_JET)
display, traced = check_session("traced.pvsm")
assert traced == added, [(name, added[name], traced[name]) for name in added
                         if added[name] != traced[name]]
(_, view) = views()[1]
frame_view(view, 0.015)
assert np.abs(pixels_of(view, SIZE) - seen).max() <= 1
