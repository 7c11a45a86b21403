# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""A value in place of an automatic k in the properties panel: K Scale begins with the k in use, so that the image stays as
it is; before Apply, cancelled, undone, traced and kept. A script that chooses it sets nothing else."""

import os

import numpy as np
from views_testing import image_array, simple, traced
from plugin_testing import Schlieren
from window_testing import FOLDER, Session

TRACE = os.path.join(FOLDER, "trace.py")
SETTINGS = {"ImageSize": [32, 32], "GladstoneDaleConstant": 2e-6}


def scripted(**properties):
    flow = simple.Calculator(Input=simple.Wavelet(WholeExtent=3 * [-8, 8]), ResultArrayName="rho", Function="RTData")
    flow.UpdatePipeline()
    return Schlieren(Input=flow, **SETTINGS, **properties)


automatic = scripted()
image_of_automatic = image_array(automatic, "Intensity")
k = automatic.FieldData["KScale"].GetRange()[0]
assert k > 0 and abs(k - 1000) > 100

user = Session()
KSCALE, MODE = "KScale/DoubleLineEdit0", "KMode/ComboBox"
user.check("KScale", "visible", "false")
for keeps in (False, True):
    user.choose(MODE, "Value")
    user.check("KScale", "visible", "true")
    user.check(KSCALE, "text", k)
    if not keeps:
        user.reset()
        user.check(MODE, "currentText", "Automatic")
        user.check(KSCALE, "text", "1000")
user.save_state("before.pvsm")
user.apply()
user.save_state("off.pvsm")
user.menu("menu_Edit", "actionEditUndo")
user.check(MODE, "currentText", "Automatic")
user.check(KSCALE, "text", "1000")
user.save_state("undone.pvsm")
user.menu("menu_Edit", "actionEditRedo")
user.check(MODE, "currentText", "Value")
user.save_state("redone.pvsm")

# Another k, then automatic and off again: the k in use is the automatic one then.
user.choose(KSCALE, "500")
user.apply()
user.choose(MODE, "Automatic")
user.choose(MODE, "Value")
user.check(KSCALE, "text", "500")
user.choose(MODE, "Automatic")
user.apply()
user.choose(MODE, "Value")
user.check(KSCALE, "text", k)

# A script in the window gets what it sets.
user.reset()
user.python("FindSource('bench').KMode = 'Value'\nRender()")
user.check(MODE, "currentText", "Value")
user.check(KSCALE, "text", "500")

user.play(f"""
import sys
sys.path.insert(0, {os.path.dirname(os.path.abspath(__file__))!r})
from paraview.simple import *
flow = Calculator(Input=Wavelet(WholeExtent=3 * [-8, 8]), ResultArrayName="rho", Function="RTData", registrationName="flow")
flow.UpdatePipeline()
bench = Schlieren(Input=flow, registrationName="bench", **{SETTINGS})
Show(bench, GetActiveViewOrCreate("RenderView"))
Render()
SetActiveSource(bench)

# What is traced whenever something is applied.
from paraview import servermanager, smtrace
smtrace.start_trace()
def write(*_):
    with open({TRACE!r}, "a") as file:
        file.write(smtrace.get_current_trace_output() + "\\n# next\\n")
bench.SMProxy.AddObserver("UpdateEvent", write)
""")

for state, mode, value in (("before", "Automatic", 1000), ("off", "Value", k), ("undone", "Automatic", 1000),
                           ("redone", "Value", k)):
    simple.ResetSession()
    simple.LoadState(os.path.join(FOLDER, state + ".pvsm"))
    bench = simple.FindSource("bench")
    assert (bench.KMode, bench.KScale) == (mode, value), (state, bench.KMode, bench.KScale)
    assert np.abs(image_array(bench, "Intensity") - image_of_automatic).max() < 1e-6, state

with open(TRACE, encoding="utf-8") as file:
    text = file.read()
lines = traced(text, "bench")
off = lines.index(("KMode", "'Value'"))
assert lines[off + 1][0] == "KScale" and float(lines[off + 1][1]) == k, text

# A script of its own, too.
bench = scripted(KMode="Value")
bench.UpdatePipeline()
assert bench.KScale == 1000 and bench.FieldData["KScale"].GetRange()[0] == 1000
