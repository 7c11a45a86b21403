# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Three pictures of one medium in one click; the light that a cutoff makes is shown in what suits it, and
following is switched off and on."""

import numpy as np
from views_testing import (OPEN_JET, TRACE_FIRST_STEP, ViewsSession, check_baseline, check_camera,
                           check_display, check_picture_view, filters, frame, load, picture, play_trace,
                           shown, simple, values, views)
from plugin_testing import Schlieren

user = ViewsSession()
user.press("ThreePictures")
user.save_state("three.pvsm")

# The first picture, of the knife edge, is selected.
user.choose("Cutoff/ComboBox", "Color Filter")
user.apply()
user.save_state("colored.pvsm")
user.choose("Cutoff/ComboBox", "Shadowgraph")
user.apply()
user.save_state("shadow.pvsm")
user.undo()
user.undo()
user.save_state("grey.pvsm")

user.check_button("Follow", "checked", "true")
user.press("Follow")
user.check_button("Follow", "checked", "false")
user.save_state("still.pvsm")
user.undo()
user.check_button("Follow", "checked", "true")
user.press("Follow")
user.press("Follow")
user.check_button("Follow", "checked", "true")
user.save_state("following.pvsm")
user.undo()
user.undo()
user.undo()
user.save_state("undone.pvsm")
user.play(OPEN_JET + TRACE_FIRST_STEP)


def pictures():
    """The filters in the order in which they are made."""
    found = filters()
    assert len(found) == 3
    return {name: found[name] for name in ("KnifeEdge1", "Shadowgraph1", "Interferogram1")}


def check_session():
    benches = pictures()
    cells = views()
    assert [cell for cell, _ in cells] == [3, 4, 5, 6]
    scene, (left, top, right) = cells[0][1], [cells[i][1] for i in (1, 2, 3)]
    medium = benches["KnifeEdge1"].Input
    assert medium.GetXMLName() == "RefractiveIndex" and medium.Density == ["POINTS", "rho"]
    assert medium.Input == simple.FindSource("jet")
    for (name, bench), cutoff, view, white in zip(
            benches.items(), ("Knife Edge", "Shadowgraph", "Interferogram"), (top, left, right),
            (1, 2, 1)):
        assert bench.Input == medium, f"{name} has a medium of its own"
        assert bench.IndexModel == "Refractivity" and bench.Cutoff == cutoff
        assert bench.FollowedView == "RenderView1" or bench.FollowedView.startswith("RenderView")
        check_camera(bench, scene)
        check_display(shown(bench, view), white)
        check_picture_view(view, bench)
    volume = simple.GetRepresentation(simple.FindSource("jet"), scene)
    assert volume.Representation == "Volume"
    return benches, [values(bench) for bench in benches.values()]


load("three.pvsm")
benches, made = check_session()

# The medium in between makes no difference to pictures that a script makes straight from the flow.
for bench in benches.values():
    by_script = Schlieren(
        Input=simple.FindSource("jet"), Density=["POINTS", "rho"], Cutoff=bench.Cutoff,
        **{name: bench.GetPropertyValue(name)
           for name in ("ImageSize", "ViewDirection", "ViewUp", "FocalPoint", "ParallelScale")})
    assert np.abs(picture(bench, "Intensity") - picture(by_script, "Intensity")).max() < 1e-4
    assert np.ptp(picture(bench, "Intensity")) > 0.1
    simple.Delete(by_script)

# Knife edge, shadowgraph and interferogram side by side.
(_, left), (_, top), (_, right) = views()[1:]
for bench, view in zip(benches.values(), (top, left, right)):
    frame(bench, view, [240, 180], 0.015)
check_baseline([top, left, right], "WindowThreePictures.png", [240, 180])

play_trace("traced.pvsm", OPEN_JET)
load("traced.pvsm")
assert check_session()[1] == made

# The colours of one picture change and those of the others do not.
for state, array, white in (("colored", "Color", 1), ("shadow", "Intensity", 2),
                            ("grey", "Intensity", 1)):
    load(state + ".pvsm")
    benches = pictures()
    (_, left), (_, top), (_, right) = views()[1:]
    display = shown(benches["KnifeEdge1"], top)
    if array == "Color":
        assert list(display.ColorArrayName)[:2] == ["POINTS", "Color"] and display.MapScalars == 0
    else:
        check_display(display, white)
    check_display(shown(benches["Shadowgraph1"], left), 2)
    check_display(shown(benches["Interferogram1"], right), 1)
    for bench, view in zip(benches.values(), (top, left, right)):
        assert not [name for name in simple.GetRepresentations() if "ScalarBar" in name[0]]

load("still.pvsm")
benches = pictures()
assert benches["KnifeEdge1"].FollowedView == "" and benches["Shadowgraph1"].FollowedView != ""
load("following.pvsm")
assert filters()["KnifeEdge1"].FollowedView == filters()["Shadowgraph1"].FollowedView != ""

load("undone.pvsm")
assert list(simple.GetSources().values()) == [simple.FindSource("jet")] and len(views()) == 1
