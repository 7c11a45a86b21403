# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""What Edit > Undo says of the toolbar and of the panel: what was done."""

from window_testing import BENCH, OPEN_JET, ViewsSession

user = ViewsSession(BENCH)


def check_undo(name):
    user.python(f"""
(action,) = [one for one in widget("menu_Edit").actions() if one.objectName() == "actionEditUndo"]
assert action.text() == "&Undo " + {name!r} and action.isEnabled(), action.text()
""")


user.press("OneImage")
user.python("until(shown_at_all)")
check_undo("Add Schlieren View")
user.choose("Cutoff/ComboBox", "Bright Field")
check_undo("Change Cutoff")
user.choose("Cutoff/ComboBox", "Knife Edge")
user.type("KnifeEdgeAngle/DoubleLineEdit0", "30")
check_undo("Change Knife Edge Angle")
user.python("""
(display,) = displays()
assert display.SchlierenBench.KnifeEdgeAngle == 30
menu = widget("propertiesPanel", "Cutoff").findChild(QtWidgets.QMenu, "PresetsMenu")
menu.actions()[0].trigger()
""")
check_undo("Bench: Knife Edge, vertical")
user.python("""
settle_views()
plane = widget("propertiesPanel", "SchlierenCutoff", "Plane")
plane.setFocus()
QTest.keyClick(plane, Qt.Key.Key_Right)
""")
check_undo("Drag Cutoff")

# Back through all of them.
for name in ("Bench: Knife Edge, vertical", "Change Knife Edge Angle"):
    user.undo()
    check_undo(name)
user.python("assert displays()[0].SchlierenBench.KnifeEdgeAngle == 30")
user.undo()
check_undo("Change Cutoff")
user.python("assert displays()[0].SchlierenBench.KnifeEdgeAngle == 0")
user.play(OPEN_JET)
