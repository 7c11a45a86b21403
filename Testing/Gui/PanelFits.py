# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The keyboard reaches the widgets of the properties panel, and k from optics is that of the optics."""

import os

from views_testing import FOLDER, INSIDE, OPEN_JET, ViewsSession

REPORT = os.path.join(FOLDER, "report.txt")

user = ViewsSession()
user.choose_filter("Schlieren")
user.choose("ImageSize/LineEdit0", "64")
user.choose("ImageSize/LineEdit1", "64")
user.apply()

# What the keyboard reaches from one property to the next.
user.python(f"""
def reached(name, most):
    QTest.keyClick(QApplication.focusWidget(), Qt.Key.Key_Tab)
    process_events()
    parents = [QApplication.focusWidget()]
    while parents[-1].parentWidget():
        parents.append(parents[-1].parentWidget())
    return any(one.objectName() == name for one in parents) or (most > 0 and reached(name, most - 1))
QApplication.setActiveWindow(widget())
widget("propertiesPanel", "Cutoff", "ComboBox").setFocus()
for name in ("Presets", "KnifeEdgeAngle", "CutoffOffset", "KMode", "FitKAgain", "FitKOverSeries", "Plane", "Quality"):
    assert reached(name, 2), name
with open({REPORT!r}, "w") as file:
    file.write("reached\\n")
""")
user.reset()

user.choose("KMode/ComboBox", "Bench")
user.choose("FocalLength/DoubleLineEdit0", "2")
user.choose("SourceWidth/DoubleLineEdit0", "4")
user.apply()
user.python(f"""
bench = FindSource("Schlieren1")
settle(bench)
assert information(bench, "KScaleUsed") == 500
with open({REPORT!r}, "a") as file:
    file.write("optics\\n")
""")
user.check("Sensitivity/Note", "text", "k = 500: full scale is a deflection of 1 mrad; optics: 2 m focal length, "
           "source 4 mm wide, the edge 0 mm in (offset 0)")
user.play(INSIDE + OPEN_JET)

with open(REPORT, encoding="utf-8") as file:
    assert file.read().split() == ["reached", "optics"]
