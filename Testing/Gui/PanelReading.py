# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The properties panel as it is read: units behind names, what is there without asking for advanced properties, notes that
look like notes, and texts that can be read with dark colours. The keyboard reaches its widgets, and k from optics is
that of the optics."""

from window_testing import OPEN_JET, PANEL, ViewsSession

user = ViewsSession()
user.choose_filter("Schlieren")
user.check("Grid/Note", "text", "known after Apply")
user.choose("ImageSize/LineEdit0", "64")
user.choose("ImageSize/LineEdit1", "64")
user.apply()
user.check("Grid/Note", "text", "60 x 33 x 33 points: the data's own")

# What the keyboard reaches from one property to the next.
user.python("""
def reached(name, most):
    QTest.keyClick(QApplication.focusWidget(), Qt.Key.Key_Tab)
    process_events()
    parents = [QApplication.focusWidget()]
    while parents[-1].parentWidget():
        parents.append(parents[-1].parentWidget())
    return any(one.objectName() == name for one in parents) or (most > 0 and reached(name, most - 1))
QApplication.setActiveWindow(widget())
widget("propertiesPanel", "Cutoff", "ComboBox").setFocus()
for name in ("Presets", "KnifeEdgeAngle", "CutoffOffset", "KMode", "FitKAgain", "Quality", "Plane"):
    assert reached(name, 2), name
""")
user.reset()

user.choose("KMode/ComboBox", "Bench")
user.choose("MirrorFocalLength/DoubleLineEdit0", "2")
user.choose("SourceWidth/DoubleLineEdit0", "4")
user.apply()
user.python("""
bench = FindSource("Schlieren1")
settle(bench)
assert information(bench, "KScaleUsed") == 500
""")
user.check("Sensitivity/Note", "text", "k = 500: full scale is a deflection of 1 mrad; optics: 2 m focal length, "
           "source 4 mm wide, the edge 0 mm in")


def check_label(name, text):
    user.check(name + "Label", "text", f"<p>{text}</p>")


# Data that are not in SI need these. Units stand where they are seen however wide the panel is.
for name, text in (("LengthScale", "Length Scale (m per unit)"),
                   ("ImageSize", "Image Size (px)"),
                   ("KnifeEdgeAngle", "Knife Edge Angle (°)")):
    user.check(name, "visible", "true")
    check_label(name, text)
user.check("FocalPoint", "visible", "false")

# An interferogram's wavelength, in the panel and among what its cutoff is sensitive to.
user.check("Wavelength", "visible", "false")
user.choose("Cutoff/ComboBox", "Interferogram")
user.check("Wavelength", "visible", "true")
user.apply()
user.python("settle(FindSource('Schlieren1'))")
user.check("Sensitivity/Note", "text",
           "a fringe is 632.8 nm of optical path: Wavelength, in the group Medium")

user.event(PANEL + "/SearchBox/AdvancedButton", "set_boolean", "true")
user.python("""
label = widget("propertiesPanel", "ProxyPanel").findChild(QtWidgets.QLabel, "FocalPointLabel")  # ParaView 5.11: within
assert label.isVisible() and label.text() == "<p>Focal Point (data units)</p>", label.text()
""")

# What is kept over a series, but not its numbers.
for name in ("LockedAmbient", "LockedDepth", "LockedK"):
    user.check(name, "visible", "false")

# Notes can be read and copied like other text in a window.
user.python("""
for name in ("Grid", "Status"):
    note = widget("propertiesPanel", name, "Note")
    around = widget("propertiesPanel", "ProxyPanel").grab().toImage().pixelColor(0, 0)
    behind = note.grab().toImage().pixelColor(note.width() - 1, 0)
    assert note.isEnabled() and behind == around, name
""")

# With dark colours, too, the plugin's own texts have the contrast of WCAG 2 to what is behind them, 4.5.
user.python("""
from collections import Counter
dark = QtGui.QPalette(QtGui.QColor("#353535"), QtGui.QColor("#303030"))
def luminance(color):
    linear = [value / 12.92 if value <= 0.04045 else ((value + 0.055) / 1.055)**2.4
              for value in (color.redF(), color.greenF(), color.blueF())]
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]
def contrast(one, top=0):
    "Of what stands out most from the colour that most of a widget has, from this row on."
    image = one.grab(one.rect().adjusted(0, top, 0, 0)).toImage()
    counts = Counter(image.pixel(x, y) for x in range(image.width()) for y in range(image.height()))
    values = {color: luminance(QtGui.QColor(color)) for color in counts}
    behind = values[max(counts, key=counts.get)]
    return max((max(value, behind) + 0.05) / (min(value, behind) + 0.05) for value in values.values())
def texts(row):
    "The labels and buttons of a property."
    found = row.findChildren(QtWidgets.QLabel) + row.findChildren(QtWidgets.QAbstractButton)
    return [one for one in found if one.isVisible() and one.isEnabled() and one.text() and not one.size().isEmpty()]
panel = widget("propertiesPanel", "PropertiesFrame", "ProxyPanel")
def check(name, places):
    assert places and all(contrast(one) >= 4.5 for one in places), (name, [contrast(one) for one in places])
usual = QApplication.palette()
for palette in usual, dark:
    QApplication.setPalette(palette)
    for name, value in (("Cutoff", "Color Filter"), ("IndexModel", "Auto")):
        widget("propertiesPanel", name, "ComboBox").setCurrentText(value)
    plane = panel.findChild(QWidget, "Plane")
    until(lambda: plane.isVisible() and plane.isEnabled() and plane.property("side") > 100)
    pause(0.1)
    assert (luminance(panel.grab().toImage().pixelColor(0, 0)) < 0.1) == (palette is dark)
    check("FocalPoint", [panel.findChild(QtWidgets.QLabel, "FocalPointLabel")])
    for name in ("Cutoff", "Sensitivity", "ColorFilterImage", "Status"):
        check(name, texts(panel.findChild(QWidget, name)))
    assert contrast(plane, top=round(plane.property("side")) + 5) >= 4.5
    for model, name in (("Transfer Functions", "SchlierenFields"),):
        widget("propertiesPanel", "IndexModel", "ComboBox").setCurrentText(model)
        until(panel.findChild(QWidget, name).isVisible)
        check(name, texts(panel.findChild(QWidget, name)))
        check(name, [one for one in panel.findChild(QWidget, name).findChildren(QtWidgets.QHeaderView) if one.isVisible()])
QApplication.setPalette(usual)
""")
user.reset()
user.play(OPEN_JET)
