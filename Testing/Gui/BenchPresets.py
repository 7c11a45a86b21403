# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""A bench chosen from the presets: shown, applied, given up, taken back; and the units behind the entries."""

import os
import sys

import numpy as np

sys.path.insert(0, os.path.join(os.environ["SCHLIEREN_SOURCE_DIR"], "Testing", "Python"))

from plugin_testing import Schlieren, picture, simple  # noqa: E402
from window_testing import FOLDER, PROPERTIES, Session  # noqa: E402

user = Session()


def choose_preset(name):
    user.event(f"{PROPERTIES}/Cutoff/Presets/PresetsMenu", "activate", name)


user.check("Wavelength/Unit", "text", "nm")
user.check("ImageSize/Unit", "text", "px")
user.check("KnifeEdgeAngle/Unit", "text", "°")

# What was set before leaves no trace: the same bench as by a script.
user.click("InvertCutoff/CheckBox")
user.choose("CutoffOffset/DoubleLineEdit0", "0.3")
choose_preset("Toepler bench: mirror of 1 m, slit of 1 mm")
user.check("KFromOptics/CheckBox", "checked", "true")
user.check("InvertCutoff/CheckBox", "checked", "false")
user.check("SourceLength", "visible", "true")
user.apply()
user.save_state("toepler.pvsm")
choose_preset("Dark field")
user.check("Cutoff/ComboBox", "currentText", "Circular Complement")
user.reset()
user.check("Cutoff/ComboBox", "currentText", "Knife Edge")
user.check("KFromOptics/CheckBox", "checked", "true")
choose_preset("Interferogram, finite fringes")
user.apply()
user.save_state("fringes.pvsm")
user.menu("menu_Edit", "actionEditUndo")
user.check("Cutoff/ComboBox", "currentText", "Knife Edge")
user.save_state("undone.pvsm")
user.play("""
from paraview.simple import *
flow = Wavelet(WholeExtent=3 * [-8, 8], registrationName="flow")
flow.UpdatePipeline()
bench = Schlieren(Input=flow, registrationName="bench", ImageSize=[32, 32])
bench.GladstoneDaleConstant = 1e-6
""")


def shown(state):
    simple.ResetSession()
    simple.LoadState(os.path.join(FOLDER, state + ".pvsm"))
    return picture(simple.FindSource("bench"), "Intensity")


def scripted(**properties):
    flow = simple.Wavelet(WholeExtent=3 * [-8, 8])
    flow.UpdatePipeline()
    return picture(Schlieren(Input=flow, ImageSize=[32, 32], GladstoneDaleConstant=1e-6, **properties),
                   "Intensity")


toepler = shown("toepler")
assert np.ptp(toepler) > 0
assert np.array_equal(toepler, scripted(KFromOptics=1, SourceShape="Slit"))
assert np.array_equal(toepler, shown("undone"))
fringes = shown("fringes")
assert np.array_equal(fringes, scripted(Cutoff="Interferogram", FringeMode="Finite", FringeAngle=90))
assert np.ptp(fringes) > 0.5
