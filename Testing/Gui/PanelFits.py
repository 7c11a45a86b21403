# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The properties panel of each cutoff is no wider than ParaView's, with advanced properties, too; the keyboard reaches
its widgets; a phase contrast that is chosen by hand is made of waves, in one step of undo; and k from optics is that of
the optics."""

import os

from views_testing import FOLDER, INSIDE, OPEN_JET, ViewsSession

REPORT = os.path.join(FOLDER, "report.txt")

user = ViewsSession()
user.choose_filter("Schlieren")
user.choose("ImageSize/LineEdit0", "64")
user.choose("ImageSize/LineEdit1", "64")
user.apply()

# As wide as the window has made the panel; what the keyboard reaches from one property to the next.
user.python(f"""
panel = widget("propertiesPanel", "PropertiesFrame", "ProxyPanel")
room = widget("propertiesPanel", "scrollArea").viewport().width()
names = widget("propertiesPanel", "Cutoff", "ComboBox")
settings = [dict(Cutoff=names.itemText(i)) for i in range(names.count())]
settings += [dict(IndexModel=model, Cutoff="Knife Edge") for model in ("Ciddor", "Gladstone-Dale Mixture", "Transfer Functions")]
settings += [dict(IndexModel="Auto", KFromOptics=True), dict(KFromOptics=False, AutoKScale=False), dict(AutoKScale=True)]
for _ in "usual", "advanced":
    for change in settings:
        for name, value in change.items():
            if isinstance(value, bool):
                widget("propertiesPanel", name, "CheckBox").setChecked(value)
            else:
                widget("propertiesPanel", name, "ComboBox").setCurrentText(value)
        process_events()
        assert panel.minimumSizeHint().width() <= room, (change, panel.minimumSizeHint().width(), room)
    click(widget("propertiesPanel", "SearchBox", "AdvancedButton"))

def reached(name, most):
    QTest.keyClick(QApplication.focusWidget(), Qt.Key.Key_Tab)
    process_events()
    parents = [QApplication.focusWidget()]
    while parents[-1].parentWidget():
        parents.append(parents[-1].parentWidget())
    return any(one.objectName() == name for one in parents) or (most > 0 and reached(name, most - 1))
QApplication.setActiveWindow(widget())
widget("propertiesPanel", "Cutoff", "ComboBox").setFocus()
for name in ("Presets", "KnifeEdgeAngle", "CutoffOffset", "LockK", "FitK", "KFromOptics", "Plane", "Quality"):
    assert reached(name, 2), name
with open({REPORT!r}, "w") as file:
    file.write("fits\\n")
""")
user.reset()


def check(cutoff, model, isSeen):
    user.check("Cutoff/ComboBox", "currentText", cutoff)
    user.check("LightModel/ComboBox", "currentText", model)
    user.check("LightModel", "visible", isSeen)


check("Knife Edge", "Rays", "false")
user.choose("Cutoff/ComboBox", "Phase Contrast")
check("Phase Contrast", "Auto", "true")
user.choose("Cutoff/ComboBox", "Circular")
check("Circular", "Rays", "false")
user.choose("Cutoff/ComboBox", "Phase Contrast")
user.reset()
check("Knife Edge", "Rays", "false")
user.choose("Cutoff/ComboBox", "Phase Contrast")
user.apply()
user.python(f"""
bench = FindSource("Schlieren1")
settle(bench)
assert "waves" in information(bench, "Status"), information(bench, "Status")
with open({REPORT!r}, "a") as file:
    file.write("waves\\n")
""")
user.undo()
check("Knife Edge", "Rays", "false")
user.redo()
check("Phase Contrast", "Auto", "true")
user.choose("Cutoff/ComboBox", "Knife Edge")
user.click("KFromOptics/CheckBox")
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
    assert file.read().split() == ["fits", "waves", "optics"]
