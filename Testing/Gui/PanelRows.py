# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The panel opens with a page: technique first, what has an effect with it and with these data, and about ten rows, in ParaView's
narrowest panel; all else is among the advanced properties. Screenshots of the panel are in the test's folder."""

import json
import os

from window_testing import FOLDER, ViewsSession

# The rows of techniques, of data, and of all.
OF_TECHNIQUE = {
    "Knife Edge": ["KnifeEdgeAngle", "CutoffOffset", "KMode", "Sensitivity"],
    "Shadowgraph": ["ScreenDistance"],
    "Interferogram": ["Sensitivity", "FringeSpacing"],
    "Background Oriented": ["Sensitivity", "BackgroundPattern", "BackgroundDistance", "BackgroundPeriod"],
}
CAMERA = ["FNumber", "SensorWidth"]
OF_DATA = {
    "density": ["Density", "Gas"],
    "pt": ["Temperature", "Pressure", "ArraysUsed"],
    "flat": ["Density", "Gas", "Symmetry", "Depth"],
    "mesh": ["Density", "Gas", "Outside"],
}
HAS_PLANE = ["Knife Edge"]
MOST = 14  # rows with the legend's, without the plane, of any technique and data


def rows(data, technique):
    plane = ["SchlierenCutoff"] if technique in HAS_PLANE else []
    wavelength = ["Wavelength"] if technique == "Interferogram" else []
    medium = OF_DATA[data] + wavelength
    if wavelength:  # among others of the medium, as the XML has them
        medium.sort(key="Density Gas Temperature Pressure Wavelength Symmetry ArraysUsed Depth Outside".split().index)
    return (["Cutoff"] + OF_TECHNIQUE[technique] + ["Quality"] + plane + medium + ["LengthScale"]
            + (CAMERA if technique == "Background Oriented" else []) + ["SchlierenLegend"])


with open(os.path.join(FOLDER, "rows.json"), "w", encoding="utf-8") as file:
    json.dump({data: {technique: rows(data, technique) for technique in OF_TECHNIQUE} for data in OF_DATA}, file)

LOOK = f"""
import json
def seen(panel):
    "The properties in the panel, without ParaView's own."
    found = []
    for one in panel.findChildren(QWidget, options=Qt.FindChildOption.FindDirectChildrenOnly):
        if one.isVisibleTo(panel) and one.inherits("pqPropertyWidget"):
            inner = one.findChild(QWidget, "BenchPanel")
            found += seen(inner) if inner else [one.objectName()]
    return [name for name in found if name not in ("Representation", "DataAxesGrid")]

def look(data, technique):
    pause(0.2)
    panel = widget("propertiesPanel", "DisplayFrame", "ProxyPanel")
    found = seen(panel)
    with open(os.path.join(FOLDER, "rows.json")) as file:
        assert found == json.load(file)[data][technique], (data, technique, found)
    assert len([name for name in found if name != "SchlierenCutoff"]) <= {MOST}, (data, technique, found)
    least = widget("propertiesPanel", "BenchPanel").minimumSizeHint().width()
    assert least <= 250, least
    widget("propertiesPanel", "scrollArea").verticalScrollBar().setValue(0)
    widget("propertiesDock").grab().save(os.path.join(FOLDER, "panel, %s, %s.png" % (data, technique)))

def remark(name):
    return widget("propertiesPanel", "BenchPanel", name, "Remark").text()
"""
user = ViewsSession()
user.python("""
widget("propertiesDock").setFixedWidth(250)
widget("propertiesPanel", "PropertiesButton").setChecked(False)
widget("pipelineBrowserDock").hide()
widget().resize(940, 900)
""")
for data in OF_DATA:
    user.python(LOOK + f"""
for one in {list(OF_DATA)}:
    Hide(FindSource(one))
flow = FindSource({data!r})
display = Show(flow)
display.SetRepresentationType("Schlieren")
SetActiveSource(flow)
for technique in {list(OF_TECHNIQUE)}:
    display.SchlierenBench.Cutoff = technique
    Render()
    until(shown_at_all)
    look({data!r}, technique)
""")

# What values mean.
user.python(LOOK + """
bench = displays()[0].SchlierenBench
bench.Cutoff = "Knife Edge"
for name, value, text in (("KnifeEdgeAngle", 0, "vertical edge"), ("KnifeEdgeAngle", 270, "horizontal edge"),
                          ("KnifeEdgeAngle", 30, ""), ("LengthScale", 1, "16 × 16 × 8 m"),
                          ("LengthScale", 1e-3, "16 × 16 × 8 mm"), ("Quality", "Fine", "errors of up to 3 %, 5 times the time"),
                          ("Quality", "Automatic", "errors that cannot be seen")):
    setattr(bench, name, value)
    assert remark(name) == text, (name, value, remark(name))
""")

# A preset leaves its button under the mouse, though the lines below it are others.
user.python("""
button = widget("propertiesPanel", "BenchPanel", "Presets")
mouse = button.mapToGlobal(button.rect().center())
action = button.menu().findChild(QAction, "Interferogram, finite fringes")
QTimer.singleShot(0, action.trigger)
settle_views()
assert displays()[0].SchlierenBench.Cutoff == "Interferogram"
assert button.rect().contains(button.mapFromGlobal(mouse)), (button.mapFromGlobal(mouse), button.rect())
displays()[0].SchlierenBench.Cutoff = "Knife Edge"
""")

# The filter, before Apply; the air of a room has a temperature alone.
OF_FILTER = (["Cutoff"] + OF_TECHNIQUE["Knife Edge"] + ["Quality", "SchlierenCutoff", "Density", "Gas",
             "UniformPressure", "ArraysUsed", "LengthScale", "ViewDirection", "ImageSize", "Status"])
user.python("""
widget("propertiesPanel", "PropertiesButton").setChecked(True)
SetActiveSource(FindSource("warm"))
""")
user.choose_filter("Schlieren")
user.python(LOOK + f"""
pause(0.2)
found = seen(widget("propertiesPanel", "PropertiesFrame", "ProxyPanel"))
assert found == {OF_FILTER}, found
""")
user.delete()
user.python("""
widget("propertiesDock").setMinimumWidth(0)
widget("propertiesDock").setMaximumWidth(10000)
widget("pipelineBrowserDock").show()
""")

user.play("""
from paraview.simple import *
view = GetActiveViewOrCreate("RenderView")
def flow(name, extent, mesh=False, **arrays):
    source = Wavelet(WholeExtent=extent)
    for array, function in arrays.items():
        source = Calculator(Input=source, ResultArrayName=array, Function=function)
    if mesh:
        source = Clip(Input=source, ClipType="Plane")
        source.ClipType.Normal = [0, 0, 1]
    RenameSource(name, source)
    source.UpdatePipeline()
    Show(source, view)
flow("density", 3 * [-8, 8], rho="1+1e-3*RTData")
flow("pt", 3 * [-8, 8], p="101325+RTData", T="300+0.1*RTData")
flow("warm", 3 * [-8, 8], T="300+0.1*RTData")
flow("flat", [-8, 8, -8, 8, 0, 0], rho="1+1e-3*RTData")
flow("mesh", 3 * [-8, 8], mesh=True, rho="1+1e-3*RTData")
view.ResetCamera()
""")
