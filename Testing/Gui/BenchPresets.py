# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""A bench chosen from the presets: shown and applied before the first image, at once in the image after it, undone;
and what was typed but not applied waits on."""

import os
import sys

import numpy as np

sys.path.insert(0, os.path.join(os.environ["SCHLIEREN_SOURCE_DIR"], "Testing", "Python"))

from plugin_testing import Schlieren, image_array, simple  # noqa: E402
from views_testing import traced  # noqa: E402
from window_testing import FOLDER, PANEL, PROPERTIES, Session  # noqa: E402

TRACE = os.path.join(FOLDER, "trace.py")
user = Session()


def choose_preset(name):
    user.event(f"{PROPERTIES}/Cutoff/Presets/PresetsMenu", "activate", name)


# What was set before leaves no trace: the same bench as by a script.
user.click("InvertCutoff/CheckBox")
user.choose("CutoffOffset/DoubleLineEdit0", "0.3")
choose_preset("Phase Contrast, laser")
user.check("Cutoff/ComboBox", "currentText", "Phase Contrast")
user.check("PhasePlateDelay", "visible", "true")
user.check("KMode", "visible", "false")
choose_preset("Knife Edge, Toepler's bench: mirror of 1 m, slit of 1 mm")
user.check("KMode/ComboBox", "currentText", "Bench")
user.check("InvertCutoff/CheckBox", "checked", "false")
user.check("SourceLength", "visible", "true")
user.apply()
user.save_state("toepler.pvsm")

# Once there is an image, at once.
user.python("Show(FindSource('bench'))\nRender()\nsettle(FindSource('bench'))")
choose_preset("Circular Complement, dark field")
user.check_at(PANEL + "/Accept", "enabled", "false")
user.check("Cutoff/ComboBox", "currentText", "Circular Complement")
user.check("KMode/ComboBox", "currentText", "Automatic")
user.save_state("dark.pvsm")
user.menu("menu_Edit", "actionEditUndo")
user.check("Cutoff/ComboBox", "currentText", "Knife Edge")
user.check("KMode/ComboBox", "currentText", "Bench")
user.save_state("undone.pvsm")

# What is typed but not applied: of the bench it is gone, anything else waits on.
user.choose("CutoffPosition/DoubleLineEdit0", "0.3")
user.choose("ImageSize/LineEdit0", "40")
choose_preset("Interferogram, finite fringes")
user.check("Cutoff/ComboBox", "currentText", "Interferogram")
user.check("CutoffPosition/DoubleLineEdit0", "text", "0")
user.check("ImageSize/LineEdit0", "text", "40")
user.check_at(PANEL + "/Accept", "enabled", "true")
user.reset()
user.check("ImageSize/LineEdit0", "text", "32")
user.save_state("fringes.pvsm")

# An automatic k that is kept stays so.
user.choose("Cutoff/ComboBox", "Knife Edge")
user.choose("KMode/ComboBox", "Automatic Kept")
user.apply()
choose_preset("Circular, bright field")
user.check("KMode/ComboBox", "currentText", "Automatic Kept")

# A preset begins with the name that its cutoff has in the panel, and in the legend.
user.python("""
cutoffs = widget("propertiesPanel", "Cutoff", "ComboBox")
names = [cutoffs.itemText(i) for i in range(cutoffs.count())]
presets = [action.text() for action in widget("propertiesPanel", "Cutoff").findChild(QtWidgets.QMenu, "PresetsMenu").actions()]
assert len(presets) > 10 and all(text.split(",")[0] in names for text in presets), (presets, names)
""")
user.play(f"""
import sys
sys.path.insert(0, {os.path.dirname(os.path.abspath(__file__))!r})
from paraview.simple import *
flow = Calculator(Input=Wavelet(WholeExtent=3 * [-8, 8]), ResultArrayName="rho", Function="RTData", registrationName="flow")
flow.UpdatePipeline()
bench = Schlieren(Input=flow, registrationName="bench", ImageSize=[32, 32])
bench.GladstoneDaleConstant = 1e-6
SetActiveSource(bench)

# What is traced whenever something is applied.
from paraview import servermanager, smtrace
smtrace.start_trace()
def write(*_):
    with open({TRACE!r}, "w") as file:
        file.write(smtrace.get_current_trace_output())
bench.SMProxy.AddObserver("UpdateEvent", write)
""")


def shown(state):
    simple.ResetSession()
    simple.LoadState(os.path.join(FOLDER, state + ".pvsm"))
    return image_array(simple.FindSource("bench"), "Intensity")


def scripted(**properties):
    flow = simple.Calculator(Input=simple.Wavelet(WholeExtent=3 * [-8, 8]), ResultArrayName="rho", Function="RTData")
    flow.UpdatePipeline()
    return image_array(Schlieren(Input=flow, ImageSize=[32, 32], GladstoneDaleConstant=1e-6, **properties),
                   "Intensity")


toepler = shown("toepler")
assert np.ptp(toepler) > 0
assert np.array_equal(toepler, scripted(KMode="Bench", SourceShape="Slit"))
assert np.array_equal(toepler, shown("undone"))
assert np.array_equal(shown("dark"), scripted(Cutoff="Circular Complement"))
fringes = shown("fringes")
assert np.array_equal(fringes, scripted(Cutoff="Interferogram", FringeSpacing=-10, FringeAngle=90))
assert np.ptp(fringes) > 0.5

# Each preset is one entry of the trace.
with open(TRACE, encoding="utf-8") as file:
    script = file.read()
lines = traced(script, "bench")
dark = lines.index(("Cutoff", "'Circular Complement'"))
assert set(lines[dark:dark + 3]) == {("Cutoff", "'Circular Complement'"), ("KMode", "'Automatic'"),
                                     ("SourceShape", "'Point'")}, lines
