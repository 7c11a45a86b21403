# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The filter from the menu, chosen and applied: Apply gives it a grey image in a 2-D view of its own beside the
3-D view, undone and redone in one step and traced."""

import re

import numpy as np
from views_testing import (OPEN_JET, TRACE, ViewsSession, check_display, filters, load, image_array,
                           play_trace, shown, simple, values, views)

HELPERS = """
import inside_window
(bench,) = filters().values()
def is_visible(view):
    display = shown(bench, view)
    return display is not None and display.Visibility == 1
def check_one():
    "There is no image, and the flow is seen as before."
    ((cell, view),) = views()
    assert cell == 0 and GetRepresentation(FindSource("jet"), view).Visibility == 1 and not is_visible(view)
    return np.array(view.CameraPosition)
def check_display_of(array, white=0):
    "White is 0 where the array is not a light's brightness."
    (_, (_, flat)) = views()
    if white:
        check_display(shown(bench, flat), white)
    assert list(shown(bench, flat).ColorArrayName)[:2] == ["POINTS", array], shown(bench, flat).ColorArrayName
    assert array != "Color" or shown(bench, flat).MapScalars == 0
"""

user = ViewsSession()
user.python("from paraview import smtrace\nsmtrace.start_trace()")
user.choose_filter("Schlieren")
user.choose("ImageSize/LineEdit0", "128")
user.choose("ImageSize/LineEdit1", "128")
user.python(HELPERS + "inside_window.camera = check_one()")
user.apply()
user.python(f"""
from paraview import smtrace
with open({TRACE!r}, "w") as file:
    file.write(smtrace.get_current_trace_output())
smtrace.stop_trace()
""")
user.save_state("applied.pvsm")
user.python(HELPERS + "inside_window.made = values(bench), intensity(bench)\nassert is_visible(views()[1][1])")
user.undo()
user.python(HELPERS + "assert np.allclose(inside_window.camera, check_one())")
user.redo()
user.python(HELPERS + """
until(lambda: len(views()) == 2)
RenderAllViews()
assert is_visible(views()[1][1]) and not is_visible(views()[0][1])
made, image = inside_window.made
assert values(bench) == made and np.abs(intensity(bench) - image).max() < 1e-5
check_display_of("Intensity", 1)
""")

# The display suits the cutoff, unless somebody has chosen another one.
for cutoff, array, white in (("Color Filter", "Color", 0), ("Shadowgraph", "Intensity", 2)):
    user.choose("Cutoff/ComboBox", cutoff)
    user.apply()
    user.python(HELPERS + f"check_display_of({array!r}, {white})")
user.undo()
user.python(HELPERS + "check_display_of('Color')")
user.undo()
user.python(HELPERS + """
check_display_of("Intensity", 1)
ColorBy(shown(bench, views()[1][1]), ("POINTS", "OpticalPathDifference"))
""")
user.choose("Cutoff/ComboBox", "Shadowgraph")
user.apply()
user.python(HELPERS + "check_display_of('OpticalPathDifference')")
user.choose("Cutoff/ComboBox", "Knife Edge")
user.apply()
user.delete()
user.play(OPEN_JET)


def check(state):
    load(state)
    (left, scene), (right, flat) = views()
    assert (left, right) == (1, 2)
    (bench,) = filters().values()
    hidden = shown(bench, scene)
    assert hidden is None or hidden.Visibility == 0
    assert simple.GetRepresentation(simple.FindSource("jet"), scene).Visibility == 1
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
again, same = check("traced.pvsm")
assert again == made, [(name, made[name], again[name]) for name in made if made[name] != again[name]]
assert np.abs(same - intensity).max() < 1e-5
