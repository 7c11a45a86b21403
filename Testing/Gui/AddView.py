# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""One click on the toolbar: a flow drawn as Schlieren beside its volume, with all that is chosen for the user;
undone and redone in one step, kept in state files and in the Python trace. The same from the views that ParaView offers
in an empty cell of a layout."""

import os
import re

import numpy as np
from views_testing import (FOLDER, OPEN_WHOLE_JET, TRACE_FIRST_STEP, ViewsSession, check_baseline, check_linked, drawn,
                           frame_view, load, play_trace, simple, values, views)
from plugin_testing import MadeByUsers
from representation_testing import GREY_LEVEL, filter_like, pixels_of

SIZE = [360, 270]

user = ViewsSession()
user.python("import inside_window\ninside_window.camera = views()[0][1].CameraPosition[:]")
user.press("OneImage")
user.python("""
import inside_window
inside_window.added = values(drawn(FindSource("jet"), views()[1][1]).SchlierenBench)
""")
user.save_state("added.pvsm")
user.undo()
# All of it is undone, also what is shown in the 3-D view and how.
UNDONE = """
import inside_window
((cell, view),) = views()
assert cell == {cell} and np.allclose(view.CameraPosition, inside_window.camera)
outline = GetRepresentation(FindSource("jet"), view)
assert outline.Representation == "Outline" and not list(outline.ColorArrayName)[1]
assert not has_links(), "The link outlives its views"
"""
user.python(UNDONE.format(cell=0))
user.redo()
user.python("""
import inside_window
(_, scene), (_, view) = views()
redone = values(drawn(FindSource("jet"), view).SchlierenBench)
assert redone == inside_window.added, [(name, inside_window.added[name], redone[name]) for name in redone
                                       if inside_window.added[name] != redone[name]]
check_linked_now(scene, view)
assert GetRepresentation(FindSource("jet"), scene).Representation == "Volume"
""")
user.undo()

# In an empty cell.
user.python("""
layout = GetLayout(GetActiveView())
empty = layout.SplitVertical(0, 0.5) + 1
process_events()
frames = [one for one in QApplication.allWidgets() if one.metaObject().className() == "pqViewFrame"]
(frame,) = [one for one in frames if one.property("FRAME_INDEX") == empty]
buttons = [one for one in frame.findChildren(QtWidgets.QPushButton) if one.isVisible() and one.text()]
buttons.sort(key=lambda one: one.y())
texts = [one.text() for one in buttons]
place = texts.index("Schlieren View")
assert texts.count("Schlieren View") == 1 and texts[place - 1] < "Schlieren View" < texts[place + 1], texts
frame.grab().save(os.path.join(FOLDER, "empty.png"))
click(buttons[place])
until(lambda: displays())
(upper, scene), (lower, view) = views()
assert (upper, lower) == (1, 2)
assert drawn(FindSource("jet"), view).SchlierenBench.Density == ["POINTS", "rho"]
check_linked_now(scene, view)
""")
user.undo()
user.python(UNDONE.format(cell=1))
user.play(OPEN_WHOLE_JET + TRACE_FIRST_STEP)


def check_session(state):
    """What one click makes; returns how it is drawn, and all values."""
    load(state)
    (left, scene), (right, view) = views()
    assert (left, right) == (1, 2)
    assert list(simple.GetSources().values()) == [simple.FindSource("jet")]
    display = drawn(simple.FindSource("jet"), view)
    bench = display.SchlierenBench
    assert bench.Density == ["POINTS", "rho"] and bench.IndexModel == "Gladstone-Dale"
    alone = MadeByUsers(Input=simple.FindSource("jet"))  # as the filter begins, and every representation
    for begun in (bench, alone, simple.GetRepresentation(simple.FindSource("jet"), scene).SchlierenBench):
        assert begun.KMode == "Automatic Kept" and begun.Quality == "Automatic"
    simple.Delete(alone)
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
(_, (_, view)) = views()

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
check_baseline(view, "WindowAddView.png", SIZE)
seen = pixels_of(os.path.join(FOLDER, "WindowAddView.png"))
assert 0.02 < (np.abs(with_legend - seen) > 20).mean() < 0.3
assert np.ptp(seen) > 100
assert np.abs(seen - filter_like(display, view, SIZE)).max() <= GREY_LEVEL

# The trace makes the same from the same beginning.
play_trace("traced.pvsm", OPEN_WHOLE_JET)
_, traced = check_session("traced.pvsm")
for values_of in (traced, added):
    del values_of["LockedK"]  # which a script does not find before its image is complete
assert traced == added, [(name, added[name], traced[name]) for name in added
                         if added[name] != traced[name]]
