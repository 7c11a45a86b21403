# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Quality in the properties panel: what a preset sets is seen before it is applied; Apply, Reset and Undo."""

import os
import sys

sys.path.insert(0, os.path.join(os.environ["SCHLIEREN_SOURCE_DIR"], "Testing", "Python"))

from plugin_testing import Schlieren, simple  # noqa: E402
from schlieren.vtkSchlierenFilters import vtkSchlierenFilter  # noqa: E402
from window_testing import FOLDER, PANEL, Session  # noqa: E402

TRACE = os.path.join(FOLDER, "trace.py")
SHOWN = {"StepSize": ("DoubleRangeWidget", "value"), "SamplesPerPixel": ("LineEdit0", "text2"),
         "HomogeneityTolerance": ("DoubleRangeWidget", "value"),
         "PathModel": ("ComboBox", "currentText"), "Precision": ("ComboBox", "currentText")}

source = simple.Calculator(Input=simple.Wavelet(), ResultArrayName="rho", Function="RTData")
source.UpdatePipeline()
bench = Schlieren(source)
PRESETS = {}
for preset in ("Interactive", "Fine", "Publication", "Reference"):
    bench.Quality = preset
    PRESETS[preset] = {name: bench.GetProperty(name).GetData() for name in SHOWN}
assert PRESETS["Interactive"]["StepSize"] != PRESETS["Fine"]["StepSize"]

user = Session()


def check(quality, preset=None, **changes):
    """The panel shows this."""
    user.check("Quality/ComboBox", "currentText", quality)
    for name, value in dict(PRESETS[preset or quality], **changes).items():
        widget, attribute = SHOWN[name]
        if isinstance(value, float):  # Qt 5 and 6 write numbers differently
            user.python(f"""
shown = widget("propertiesPanel", {name!r}, {widget!r}).property({attribute!r})
assert f"{{float(shown):g}}" == "{value:g}", ({name!r}, shown)
""")
        else:
            user.check(f"{name}/{widget}", attribute, value)


user.event(PANEL + "/SearchBox/AdvancedButton", "set_boolean", "true")
check("Interactive")
user.choose("Quality/ComboBox", "Fine")
check("Fine")
user.apply()
user.save_state("fine.pvsm")

# Cancelled.
user.choose("Quality/ComboBox", "Reference")
check("Reference")
user.reset()
check("Fine")
user.type("SamplesPerPixel/LineEdit0", "5")
check("Custom", "Fine", SamplesPerPixel=5)
user.reset()
check("Fine")

# Changed, changed back, and changed at last.
user.choose("Quality/ComboBox", "Publication")
user.type("SamplesPerPixel/LineEdit0", "5")
check("Custom", "Publication", SamplesPerPixel=5)
user.type("SamplesPerPixel/LineEdit0", str(PRESETS["Publication"]["SamplesPerPixel"]))
check("Publication")
user.type("SamplesPerPixel/LineEdit0", "3")
user.choose("PathModel/ComboBox", "Straight")
user.apply()
check("Custom", "Publication", SamplesPerPixel=3, PathModel="Straight")
user.save_state("custom.pvsm")
user.menu("menu_Edit", "actionEditUndo")
check("Fine")
user.save_state("undone.pvsm")
user.menu("menu_Edit", "actionEditRedo")
check("Custom", "Publication", SamplesPerPixel=3, PathModel="Straight")
user.save_state("redone.pvsm")

user.play(f"""
from paraview.simple import *
flow = Calculator(Input=Wavelet(WholeExtent=3 * [-8, 8]), ResultArrayName="rho", Function="RTData", registrationName="flow")
flow.UpdatePipeline()
bench = Schlieren(Input=flow, registrationName="bench", ImageSize=[16, 16])

# What is traced whenever something is applied.
from paraview import servermanager, smtrace
smtrace.start_trace()
def write(*_):
    with open({TRACE!r}, "w") as file:
        file.write(smtrace.get_current_trace_output())
bench.SMProxy.AddObserver("UpdateEvent", write)
""")


def check_kept(proxy, quality, preset=None, **changes):
    assert proxy.Quality == quality, proxy.Quality
    values = {name: proxy.GetProperty(name).GetData() for name in SHOWN}
    assert values == dict(PRESETS[preset or quality], **changes), values
    assert proxy.GetClientSideObject().GetQuality() == \
        (vtkSchlierenFilter.CUSTOM if quality == "Custom" else list(PRESETS).index(quality))


for state, kept in (("fine", ("Fine",)), ("undone", ("Fine",)), ("custom", ("Custom", "Publication")),
                    ("redone", ("Custom", "Publication"))):
    simple.ResetSession()
    simple.LoadState(os.path.join(FOLDER, state + ".pvsm"))
    changes = {"SamplesPerPixel": 3, "PathModel": "Straight"} if kept[0] == "Custom" else {}
    check_kept(simple.FindSource("bench"), *kept, **changes)

# The trace of what was applied.
with open(TRACE, encoding="utf-8") as file:
    script = file.read()
simple.ResetSession()
flow = simple.Calculator(Input=simple.Wavelet(WholeExtent=3 * [-8, 8]), ResultArrayName="rho", Function="RTData", registrationName="flow")
flow.UpdatePipeline()
simple.SetActiveSource(Schlieren(Input=flow, registrationName="bench", ImageSize=[16, 16]))
exec(script, {})  # pylint: disable=exec-used
check_kept(simple.FindSource("bench"), "Custom", "Publication", SamplesPerPixel=3,
           PathModel="Straight")
