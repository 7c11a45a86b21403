# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The filter from the menu, chosen and applied: Apply gives it a grey image in a 2-D view of its own beside the
3-D view, undone and redone in one step and traced."""

import re

import numpy as np
from views_testing import (INSIDE, OPEN_JET, TRACE, ViewsSession, check_display, filters, load, image_array,
                           play_trace, shown, simple, values, views)

user = ViewsSession()
user.python("from paraview import smtrace\nsmtrace.start_trace()")
user.choose_filter("Schlieren")
user.save_state("before.pvsm")
user.apply()
user.python(f"""
from paraview import smtrace
with open({TRACE!r}, "w") as file:
    file.write(smtrace.get_current_trace_output())
smtrace.stop_trace()
""")
user.save_state("applied.pvsm")
user.undo()
user.save_state("undone.pvsm")
user.redo()
user.save_state("redone.pvsm")

# The display suits the cutoff, unless somebody has chosen another one.
for state, cutoff in (("colored", "Color Filter"), ("shadow", "Shadowgraph")):
    user.choose("Cutoff/ComboBox", cutoff)
    user.apply()
    user.save_state(state + ".pvsm")
user.undo()
user.save_state("colored_again.pvsm")
user.undo()
user.save_state("grey_again.pvsm")
user.python("ColorBy(GetDisplayProperties(FindSource('Schlieren1'), FindView('Image of Schlieren1')), ('POINTS', 'OpticalPathDifference'))")
user.choose("Cutoff/ComboBox", "Shadowgraph")
user.apply()
user.save_state("chosen.pvsm")
user.choose("Cutoff/ComboBox", "Knife Edge")
user.apply()
user.delete()
user.play(INSIDE + OPEN_JET)


def is_visible(bench, view):
    display = shown(bench, view)
    return display is not None and display.Visibility == 1


for state in ("before", "undone"):
    load(state + ".pvsm")
    ((cell, view),) = views()
    assert cell == 0
    assert simple.GetRepresentation(simple.FindSource("jet"), view).Visibility == 1
    (bench,) = filters().values()
    assert not is_visible(bench, view)
    camera = np.array(view.CameraPosition)
    if state == "before":
        first = camera
    assert np.allclose(camera, first)


def check(state):
    load(state)
    (left, scene), (right, flat) = views()
    assert (left, right) == (1, 2)
    (bench,) = filters().values()
    assert not is_visible(bench, scene) and simple.GetRepresentation(simple.FindSource("jet"), scene).Visibility == 1
    check_display(shown(bench, flat))
    assert flat.InteractionMode == "2D" and flat.CameraParallelProjection == 1
    bench.UpdatePipeline()
    low, high = np.reshape(bench.GetDataInformation().GetBounds(), (3, 2))[:2].T
    assert np.allclose(flat.CameraFocalPoint[:2], (low + high) / 2, atol=0.01 * (high - low)[0])
    # All of it is seen, in a view that is higher than wide, with no more room around it than that needs.
    assert 1 < flat.CameraParallelScale / ((high - low)[1] / 2) < 2
    return values(bench), image_array(bench, "Intensity")


with open(TRACE, encoding="utf-8") as file:
    trace = file.read()
# What is not used is not traced. ParaView 6.1 sets several properties in one call.
assert re.search(r"\bDensity ?= ?\['POINTS', 'rho'\]", trace), trace
assert not re.search(r"\b(Temperature|Pressure|Humidity|IndexArray) ?=", trace), trace
made, intensity = check("applied.pvsm")
assert np.ptp(intensity) > 0.2
play_trace("traced.pvsm", OPEN_JET)
for state in ("redone.pvsm", "traced.pvsm"):
    again, same = check(state)
    assert again == made, [(name, made[name], again[name]) for name in made if made[name] != again[name]]
    assert np.abs(same - intensity).max() < 1e-5

for state, array, white in (("colored", "Color", 0), ("shadow", "Intensity", 2), ("colored_again", "Color", 0),
                            ("grey_again", "Intensity", 1), ("chosen", "OpticalPathDifference", 0)):
    load(state + ".pvsm")
    (bench,), (_, (_, flat)) = filters().values(), views()
    if white:
        check_display(shown(bench, flat), white)
    else:
        assert list(shown(bench, flat).ColorArrayName)[:2] == ["POINTS", array], state
        assert array != "Color" or shown(bench, flat).MapScalars == 0
