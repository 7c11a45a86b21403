# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Schlieren View among the views that ParaView offers in an empty cell of a layout."""

from views_testing import OPEN_JET, ViewsSession, check_linked, drawn, load, simple, views

user = ViewsSession()
user.python("""
import os
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
settle_views()
""")
user.save_state("added.pvsm")
user.undo()
user.save_state("undone.pvsm")
user.play(OPEN_JET)

load("added.pvsm")
(upper, scene), (lower, view) = views()
assert (upper, lower) == (1, 2)
assert drawn(simple.FindSource("jet"), view).SchlierenBench.Density == ["POINTS", "rho"]
check_linked("added.pvsm", scene, view)

load("undone.pvsm")
((cell, _),) = views()
assert cell == 1
