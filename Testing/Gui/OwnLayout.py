# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Three views beside a 3-D view that has company already get a tab of their own, which is undone, redone and traced with
them. The menu's guide is open beside them."""

import os

from views_testing import FOLDER, OPEN_JET, TRACE_FIRST_STEP, ViewsSession, drawn, load, play_trace, simple

SPLIT = """
layout = GetLayout(view)
layout.SplitHorizontal(0, 0.5)
beside = CreateView("RenderView")
AssignViewToLayout(beside, layout, 2)
SetActiveView(view)
"""

user = ViewsSession()
user.press("ThreeImages")
user.python("settle_views()")
user.save_state("made.pvsm")
user.undo()
user.save_state("undone.pvsm")
user.redo()
user.save_state("redone.pvsm")
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
user.play(OPEN_JET + SPLIT + TRACE_FIRST_STEP)


def layouts():
    """The cells with views of each tab, by its name."""
    return {key[0]: sorted(layout.GetViewLocation(view.SMProxy) for view in simple.GetRenderViews()
                           if layout.GetViewLocation(view.SMProxy) >= 0)
            for key, layout in simple.GetLayouts().items()}


play_trace("traced.pvsm", OPEN_JET + SPLIT)
for state in ("made.pvsm", "redone.pvsm", "traced.pvsm"):
    load(state)
    assert layouts() == {"Layout #1": [1, 2], "Schlieren Images": [1, 5, 6]}, (state, layouts())
    for view in simple.GetViewsInLayout(simple.GetLayoutByName("Schlieren Images")):
        drawn(simple.FindSource("jet"), view)
load("undone.pvsm")
assert layouts() == {"Layout #1": [1, 2]}, layouts()
