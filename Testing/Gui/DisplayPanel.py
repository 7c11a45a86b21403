# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""What the panel shows of data drawn as Schlieren: nothing that has no effect on the image, such as colours, opacity and
lighting, which are there again with any other representation; whatever chooses the representation, on all kinds of
data, with advanced properties and in a search, too."""

import os

from window_testing import DISPLAY, FOLDER, PANEL, ViewsSession

BOX = DISPLAY + "/Representation/displayRepresentationWidget/comboBox"
SEARCH = PANEL + "/SearchBox/"

LOOK = """
OURS = ["Representation", "DataAxesGrid", "SchlierenBench", "SchlierenLegend"]
LEGEND = ["SchlierenLegend", "SchlierenLegendCorner"]

def seen():
    "The properties and the headings of the display's part of the panel."
    pause(0.1)  # the panel waits for the end of what is done to it
    panel = widget("propertiesPanel", "DisplayFrame", "ProxyPanel")
    shown = [one for one in panel.findChildren(QWidget, options=Qt.FindChildOption.FindDirectChildrenOnly)
             if one.isVisibleTo(panel)]
    properties = [one.objectName() for one in shown if one.inherits("pqPropertyWidget")]
    texts = [label.text() for one in shown if not one.inherits("pqPropertyWidget")
             for label in one.findChildren(QtWidgets.QLabel)]
    return properties, [text.split("<b>")[1].split("</b>")[0] for text in texts]

def check(properties, *headings):
    found = seen()
    assert (sorted(found[0]), found[1]) == (sorted(properties), list(headings)), found

def check_schlieren():
    check(OURS, "Schlieren")

def check_other(*more):
    properties, headings = seen()
    assert {"Representation", "DataAxesGrid", "ColorEditor", "Opacity", "Specular", *more} <= set(properties), properties
    assert {"Coloring", "Styling", "Lighting"} <= set(headings), headings
    assert not {"SchlierenBench", "SchlierenLegend"} & set(properties) and "Schlieren" not in headings, headings
"""


def look(script):
    user.python(LOOK + script + "\n")


user = ViewsSession()
look("check_other()")
user.event(BOX, "set_string", "Schlieren")
look("check_schlieren()")
user.event(BOX, "set_string", "Wireframe")
look("check_other()")
user.undo()
look("check_schlieren()")
user.undo()
look("check_other()")
user.redo()
look("check_schlieren()")

# Searched for, and with advanced properties.
user.event(SEARCH + "SearchLineEdit", "set_string", "specular")
look("check([])")
user.event(SEARCH + "SearchLineEdit", "set_string", "legend")
look("assert set(LEGEND) <= set(seen()[0]) and seen()[1] == ['Schlieren'], seen()")
# What the filter inside has, however long it is searched for.
for text, found, other in (("quality", "Quality", "IndexModel"), ("KNIFE edge ang", "KnifeEdgeAngle", "KMode"),
                           ("length sc", "LengthScale", "Density"), ("nothing of this kind", None, "Quality")):
    user.event(SEARCH + "SearchLineEdit", "set_string", text)
    user.python(f"""
bench = GetDisplayProperties(FindSource("flow")).SchlierenBench
for angle in 10, 0:
    bench.KnifeEdgeAngle = angle
    pause(0.2)
    panel = widget("propertiesPanel", "BenchPanel")
    found = [one.objectName() for one in panel.findChildren(QWidget) if one.inherits("pqPropertyWidget") and one.isVisible()]
    assert found == [] if {found!r} is None else {found!r} in found and {other!r} not in found, ({text!r}, found)
""")
user.event(SEARCH + "SearchLineEdit", "set_string", "")
look("check_schlieren()")
user.event(SEARCH + "AdvancedButton", "set_boolean", "true")
look("check(sorted({*OURS, *LEGEND, 'PolarAxes'}), 'Annotations', 'Schlieren')")
user.event(BOX, "set_string", "Surface")
look("check_other('Diffuse', 'Orientation', 'PolarAxes')")
user.event(BOX, "set_string", "Schlieren")
user.event(SEARCH + "AdvancedButton", "set_boolean", "false")
look("check_schlieren()")

# Other data, whose display is another one, and a state.
look("SetActiveSource(FindSource('mesh'))\ncheck_other()")
look("SetActiveSource(FindSource('flow'))\ncheck_schlieren()")
user.save_state("schlieren.pvsm")
look("GetDisplayProperties(FindSource('flow')).SetRepresentationType('Surface')\nRender()\ncheck_other()")
look("for name in ('flow', 'mesh'):\n    RenameSource('closed ' + name, FindSource(name))")
user.menu("menu_File", "actionFileLoadServerState")
user.event("pqClientMainWindow/FileLoadServerStateDialog", "filesSelected", os.path.join(FOLDER, "schlieren.pvsm"))
user.idle()
look("SetActiveSource(FindSource('mesh'))\ncheck_other()")
look("SetActiveSource(FindSource('flow'))\ncheck_schlieren()")

# Data of the other kinds that ParaView has displays for.
for data in ("AppendDatasets(Input=[flow])", "Transform(Input=flow)", "GroupDatasets(Input=[flow])",
             "Calculator(Input=HierarchicalFractal(), AttributeType='Cell Data', ResultArrayName='rho', Function='1+Depth')"):
    look(f"""
flow = FindSource("flow")
Hide(flow)
data = {data}
data.UpdatePipeline()
display = Show(data)
display.SchlierenBench.GladstoneDaleConstant = 1e-6
display.SetRepresentationType("Schlieren")
SetActiveSource(data)
check_schlieren()
display.SetRepresentationType("Outline")
check_other()
Delete(data)
""")
user.play("""
from paraview.simple import *
flow = Calculator(Input=Wavelet(WholeExtent=3 * [-8, 8]), ResultArrayName="rho", Function="1+1e-3*RTData",
                  registrationName="flow")
mesh = AppendDatasets(Input=[flow], registrationName="mesh")
for data in mesh, flow:
    Show(data)
    SetActiveSource(data)
Render()
""")
