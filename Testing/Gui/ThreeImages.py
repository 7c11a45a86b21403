# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Three images of one flow in one click, which has one medium: what is chosen in the panel changes the image of the
active view alone, each turns with all others, and all is undone and traced."""

import numpy as np
from views_testing import (OPEN_JET, TRACE_FIRST_STEP, ViewsSession, check_baseline, check_linked, drawn, frame_view,
                           load, play_trace, simple, values, views)
from representation_testing import GREY_LEVEL, filter_like, pixels_of
from window_testing import BENCH

SIZE = [240, 180]
CUTOFFS = ("Knife Edge", "Shadowgraph", "Interferogram")

user = ViewsSession(BENCH)
user.press("ThreeImages")
user.python("""
settle_views()
assert len(displays()) == 3
assert sum(information(display.SchlierenBench, "MediumBuilds") for display in displays()) == 1, "A medium for each view"
""")
user.save_state("three.pvsm")

# The view with the knife edge is active.
user.choose("Cutoff/ComboBox", "Color Filter")
user.save_state("colored.pvsm")
user.undo()
user.save_state("grey.pvsm")

# Turned in the one that was made last: all turn.
user.drag_view(4, (0.3, 0.5), (0.35, 0.55), (0.4, 0.6), (0.45, 0.6), (0.5, 0.6))
user.python("settle_views()")
user.save_state("turned.pvsm")
user.undo()
user.undo()
user.save_state("undone.pvsm")
user.play(OPEN_JET + TRACE_FIRST_STEP)


def check_session(state, cutoffs=CUTOFFS):
    load(state)
    cells = views()
    assert [cell for cell, _ in cells] == [3, 4, 5, 6]
    scene, (left, top, right) = cells[0][1], [cells[i][1] for i in (1, 2, 3)]
    shown = [drawn(simple.FindSource("jet"), view) for view in (top, left, right)]
    for display, cutoff in zip(shown, cutoffs):
        assert display.SchlierenBench.Cutoff == cutoff and display.SchlierenBench.Density == ["POINTS", "rho"]
    check_linked(state, scene, top, left, right)
    assert simple.GetRepresentation(simple.FindSource("jet"), scene).Representation == "Volume"
    return shown, (top, left, right), [values(display.SchlierenBench) for display in shown]


shown, in_views, made = check_session("three.pvsm")
direction = in_views[0].GetActiveCamera().GetDirectionOfProjection()
for display, view in zip(shown, in_views):
    frame_view(view, 0.015)
    seen = pixels_of(view, SIZE)
    assert np.ptp(seen) > 25, display.SchlierenBench.Cutoff
    assert np.abs(seen - filter_like(display, view, SIZE)).max() <= GREY_LEVEL
check_baseline(list(in_views), "WindowThreeImages.png", SIZE)

play_trace("traced.pvsm", OPEN_JET)
assert check_session("traced.pvsm")[2] == made

check_session("colored.pvsm", ("Color Filter",) + CUTOFFS[1:])
assert check_session("grey.pvsm")[2] == made

turned = check_session("turned.pvsm")[1][2].GetActiveCamera().GetDirectionOfProjection()
assert np.dot(turned, direction) < 0.9, turned

load("undone.pvsm")
assert list(simple.GetSources().values()) == [simple.FindSource("jet")] and len(views()) == 1
