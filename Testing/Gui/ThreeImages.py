# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Three images of one flow in one click, which has one medium: what is chosen in the panel changes the image of the
active view alone, each turns with all others, and all is undone. Beside a 3-D view that has company already they get a
tab of their own, which is undone, redone and traced with them. The menu's guide is open beside them."""

import os

import numpy as np
from views_testing import (FOLDER, OPEN_WHOLE_JET, TRACE_FIRST_STEP, ViewsSession, check_baseline, check_linked, drawn,
                           frame_view, load, play_trace, png, simple, views)
from representation_testing import GREY_LEVEL, filter_like
from window_testing import BENCH

SIZE = [240, 180]
CUTOFFS = ("Knife Edge", "Shadowgraph", "Interferogram")
SPLIT = """
view = GetActiveView()
layout = GetLayout(view)
layout.SplitHorizontal(0, 0.5)
beside = CreateView("RenderView")
AssignViewToLayout(beside, layout, 2)
SetActiveView(view)
"""
IN_VIEWS = """
import inside_window
cells = views()
assert [cell for cell, _ in cells] == [3, 4, 5, 6]
scene, (left, top, right) = cells[0][1], [cells[i][1] for i in (1, 2, 3)]
benches = [drawn(FindSource("jet"), view).SchlierenBench for view in (top, left, right)]
"""
# In a tab of their own: the cells with views of each tab, by its name.
LAYOUTS = """
cells = {key[0]: sorted(layout.GetViewLocation(view.SMProxy) for view in GetRenderViews()
                        if layout.GetViewLocation(view.SMProxy) >= 0)
         for key, layout in GetLayouts().items()}
"""
OWN_TAB = LAYOUTS + """
assert cells == {"Layout #1": [1, 2], "Schlieren Images": [1, 5, 6]}, cells
in_tab = GetViewsInLayout(GetLayoutByName("Schlieren Images"))
made = [values(drawn(FindSource("jet"), view).SchlierenBench) for view in in_tab]
"""

user = ViewsSession(BENCH)
user.press("ThreeImages")
user.python("until(shown_at_all)\n" + IN_VIEWS + """
assert sum(builds(bench) for bench in benches) == 1, "A medium for each view"
inside_window.made = [values(bench) for bench in benches]
""")
user.save_state("three.pvsm")

# The view with the knife edge is active.
user.choose("Cutoff/ComboBox", "Color Filter")
user.python(IN_VIEWS + 'assert [bench.Cutoff for bench in benches] == ["Color Filter", "Shadowgraph", "Interferogram"]')
user.undo()
user.python(IN_VIEWS + """
assert [values(bench) for bench in benches] == inside_window.made
assert information(benches[0], "AutomaticUsed") == benches[0].LockedK, "Another k than before"
""")

# Turned in the one that was made last: all turn.
user.drag_view(4, (0.3, 0.5), (0.35, 0.55), (0.4, 0.6), (0.45, 0.6), (0.5, 0.6))
user.python(IN_VIEWS + """
check_linked_now(scene, top, left, right)
direction = right.GetActiveCamera().GetDirectionOfProjection()
assert direction[2] > -0.9, direction
""")
user.undo()
user.undo()
user.python('assert list(GetSources().values()) == [FindSource("jet")] and len(views()) == 1' + SPLIT + TRACE_FIRST_STEP)
user.press("ThreeImages")
user.python(OWN_TAB + "import inside_window\ninside_window.made = made")
user.undo()
user.python(LAYOUTS + 'assert cells == {"Layout #1": [1, 2]}, cells')
user.redo()
user.python(OWN_TAB + "import inside_window\nassert inside_window.made == made")
has_help = (simple.GetParaViewVersion().major, simple.GetParaViewVersion().minor) != (5, 13)  # with Qt 6, none of plugins
user.python(f"assert widget('menuSchlieren').findChild(QAction, 'actionGuide').isVisible() is {has_help}")
if has_help:
    user.menu("menuSchlieren", "actionGuide")
    user.python(f"""
def page():
    return [browser for window in QApplication.topLevelWidgets() if window.inherits("pqHelpWindow")
            for browser in window.findChildren(QtWidgets.QTextBrowser) if "Knife Edge" in browser.toPlainText()]
until(page)
page()[0].window().grab().save({os.path.join(FOLDER, "guide.png")!r})
page()[0].window().close()
""")
user.play(OPEN_WHOLE_JET)

load("three.pvsm")
cells = views()
assert [cell for cell, _ in cells] == [3, 4, 5, 6]
scene, (left, top, right) = cells[0][1], [cells[i][1] for i in (1, 2, 3)]
in_views = (top, left, right)
jet = simple.FindSource("jet")
check_linked("three.pvsm", scene, *in_views)
assert simple.GetRepresentation(jet, scene).Representation == "Volume"
for view in in_views:
    frame_view(view, 0.015)
check_baseline(list(in_views), "WindowThreeImages.png", SIZE)
made = np.split(png(os.path.join(FOLDER, "WindowThreeImages.png"))[..., 0], 3, axis=1)
for view, cutoff, seen in zip(in_views, CUTOFFS, made):
    display = drawn(jet, view)
    assert display.SchlierenBench.Cutoff == cutoff and display.SchlierenBench.Density == ["POINTS", "rho"]
    assert np.ptp(seen) > 25, cutoff
    assert np.abs(seen - filter_like(display, view, SIZE)).max() <= GREY_LEVEL

play_trace("traced.pvsm", OPEN_WHOLE_JET + SPLIT)
load("traced.pvsm")
in_tabs = {key[0]: sorted(layout.GetViewLocation(view.SMProxy) for view in simple.GetRenderViews()
                          if layout.GetViewLocation(view.SMProxy) >= 0)
           for key, layout in simple.GetLayouts().items()}
assert in_tabs == {"Layout #1": [1, 2], "Schlieren Images": [1, 5, 6]}, in_tabs
in_tab = simple.GetViewsInLayout(simple.GetLayoutByName("Schlieren Images"))
cutoffs = [drawn(simple.FindSource("jet"), view).SchlierenBench.Cutoff for view in in_tab]
assert len(cutoffs) == 3 and all(name in cutoffs for name in CUTOFFS), cutoffs
