# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""A filter's settings in the properties panel, before Apply, cancelled, applied, undone, traced and kept: a value in
place of an automatic k, which begins with the k in use; a bench chosen from the presets; a colour filter loaded from a
PNG; and Quality, whose presets are seen before they are applied."""

import os

import numpy as np
from views_testing import (FOLDER, ViewsSession, image_array, load, png_of_text, simple, traced,
                           write_png)
from plugin_testing import Schlieren
from schlieren.vtkSchlierenFilters import vtkSchlierenFilter
from window_testing import PANEL, PROPERTIES

SETTINGS = {"ImageSize": [32, 32], "GladstoneDaleConstant": 2e-6, "Quality": "Interactive", "KMode": "Automatic"}


def scripted(**properties):
    flow = simple.Calculator(Input=simple.Wavelet(WholeExtent=3 * [-8, 8]), ResultArrayName="rho", Function="RTData")
    flow.UpdatePipeline()
    return Schlieren(Input=flow, **{**SETTINGS, **properties})


def trace_of(part):
    return os.path.join(FOLDER, part + ".py")


def kept(name):
    return np.load(os.path.join(FOLDER, name + ".npy"))


user = ViewsSession()
BENCH = "bench = FindSource('bench')\n"


def begin(part, more=""):
    """A new filter, and what is traced whenever something is applied."""
    user.python(f"""
from paraview import smtrace
if FindSource("bench"):
    smtrace.stop_trace()
    Delete(FindSource("bench"))
bench = Schlieren(Input=FindSource("flow"), registrationName="bench", **{SETTINGS})
{more}
SetActiveSource(bench)
smtrace.start_trace()
open({trace_of(part)!r}, "w").close()
def write(*_):
    with open({trace_of(part)!r}, "a") as file:
        file.write(smtrace.get_current_trace_output() + "\\n# next\\n")
bench.SMProxy.AddObserver("UpdateEvent", write)
""")


def keep(name, array="Intensity"):
    """The script that keeps the image."""
    return BENCH + f"""
bench.UpdatePipeline()
image = bench.GetClientSideObject().GetOutputDataObject(0)
np.save(os.path.join(FOLDER, {name!r}), vtk_to_numpy(image.GetPointData().GetArray({array!r})))
"""


# A value in place of an automatic k: the image stays as it is.
automatic = scripted()
image_of_automatic = image_array(automatic, "Intensity")
k = automatic.FieldData["KScale"].GetRange()[0]
assert k > 0 and abs(k - 1000) > 100
KSCALE, MODE = "KScale/DoubleLineEdit0", "KMode/ComboBox"


def check_k(mode, value, name):
    user.check(MODE, "currentText", mode)
    user.check(KSCALE, "text", value)
    user.python(keep(name) + f"assert (bench.KMode, bench.KScale) == ({mode!r}, {value}), (bench.KMode, bench.KScale)")


begin("k", "Show(bench, GetActiveView())\nRender()")
user.check("KScale", "visible", "false")
for keeps in (False, True):
    user.choose(MODE, "Value")
    user.check("KScale", "visible", "true")
    user.check(KSCALE, "text", k)
    if not keeps:
        user.reset()
        check_k("Automatic", 1000, "reset")
user.apply()
check_k("Value", k, "off")
user.undo()
check_k("Automatic", 1000, "undone")
user.redo()
check_k("Value", k, "redone")

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

# Presets of benches.
begin("presets")


def choose_preset(name):
    user.event(f"{PROPERTIES}/Cutoff/Presets/PresetsMenu", "activate", name)


# What was set before leaves no trace: the same bench as by a script.
user.choose("CutoffOffset/DoubleLineEdit0", "0.3")
choose_preset("Phase Contrast, laser")
user.check("Cutoff/ComboBox", "currentText", "Phase Contrast")
user.check("PhasePlateDelay", "visible", "true")
user.check("KMode", "visible", "false")
choose_preset("Knife Edge, Toepler's bench: mirror of 1 m, slit of 1 mm")
user.check("KMode/ComboBox", "currentText", "Bench")
user.check("CutoffOffset/DoubleLineEdit0", "text", "0")
user.check("SourceLength", "visible", "true")
user.apply()

# Once there is an image, at once.
user.python("Show(FindSource('bench'))\nRender()\nsettle(FindSource('bench'))\n" + keep("toepler"))
choose_preset("Dark Field")
user.check_at(PANEL + "/Accept", "enabled", "false")
user.check("Cutoff/ComboBox", "currentText", "Dark Field")
user.check("KMode/ComboBox", "currentText", "Automatic Kept")
user.python(keep("dark"))
user.undo()
user.check("Cutoff/ComboBox", "currentText", "Knife Edge")
user.check("KMode/ComboBox", "currentText", "Bench")
user.python(keep("toepler again"))

# What is typed but not applied: of the bench it is gone, anything else waits on.
user.choose("CutoffOffset/DoubleLineEdit0", "0.3")
user.choose("ImageSize/LineEdit0", "40")
choose_preset("Interferogram, finite fringes")
user.check("Cutoff/ComboBox", "currentText", "Interferogram")
user.check("CutoffOffset", "visible", "false")
user.check("ImageSize/LineEdit0", "text", "40")
user.check_at(PANEL + "/Accept", "enabled", "true")
user.reset()
user.check("ImageSize/LineEdit0", "text", "32")
user.python(keep("fringes"))

# A preset begins with the name that its cutoff has in the panel, and in the legend.
user.python("""
cutoffs = widget("propertiesPanel", "Cutoff", "ComboBox")
names = [cutoffs.itemText(i) for i in range(cutoffs.count())]
presets = [action.text() for action in widget("propertiesPanel", "Cutoff").findChild(QtWidgets.QMenu, "PresetsMenu").actions()]
assert len(presets) > 10 and all(text.split(",")[0] in names for text in presets), (presets, names)
""")

# A colour filter: red where light is deflected to the right, green up, blue left, white down: row 0 is the lowest.
FILTER, TEXT = os.path.join(FOLDER, "quarters.png"), os.path.join(FOLDER, "text.png")
FILE_SIDE = 16
v, u = np.mgrid[:FILE_SIDE, :FILE_SIDE] - (FILE_SIDE - 1) / 2
COLORS = np.array([(255, 0, 0), (0, 255, 0), (0, 0, 255), (255, 255, 255)], np.uint8)[
    np.rint(np.arctan2(v, u) / (np.pi / 2)).astype(int) % 4]
write_png(COLORS, FILTER)
with open(TEXT, "w", encoding="utf-8") as file:
    file.write("This is no image.")
WIDGET, DIALOG = "ColorFilterImage", "pqClientMainWindow/LoadImageDialog"
FROM_FILE = f"quarters.png: {FILE_SIDE} x {FILE_SIDE} pixels"


def check_filter(note, can_clear):
    user.check(WIDGET + "/Note", "text", note)
    user.check(WIDGET + "/Clear", "enabled", str(can_clear).lower())


def load_file(widget, name):
    user.click(widget + "/Load")
    user.event(DIALOG, "filesSelected", name)


# It is there for the cutoff that takes it, with the keyboard too.
begin("filter")
user.check(WIDGET, "visible", "false")
user.choose("Cutoff/ComboBox", "Color Filter")
user.check(WIDGET, "visible", "true")
check_filter("the colour wheel", False)
user.apply()
user.python(keep("wheel", "Color"))
user.key(WIDGET + "/Load", "Space")
user.event(DIALOG, "filesSelected", FILTER)
check_filter(FROM_FILE, True)

# Cancelled, then kept.
user.reset()
check_filter("the colour wheel", False)
load_file(WIDGET, FILTER)
user.apply()
user.python(keep("loaded", "Color"))

# What is no image changes nothing.
load_file(WIDGET, TEXT)
check_filter(f"Cannot read '{TEXT}': Unsupported image format. The image is the one from before.", True)
user.python(keep("loaded still", "Color"))
user.undo()
check_filter("the colour wheel", False)
user.redo()
check_filter(FROM_FILE, True)
user.save_state("loaded.pvsm")
user.click(WIDGET + "/Clear")
check_filter("the colour wheel", False)
user.apply()
user.python(keep("cleared", "Color"))
user.choose("Cutoff/ComboBox", "Background Oriented")
user.choose("BackgroundPattern/ComboBox", "Picture")
user.check("BackgroundImage/Note", "text", "no image")
load_file("BackgroundImage", FILTER)
user.check("BackgroundImage/Note", "text", FROM_FILE)
user.apply()
user.save_state("background.pvsm")

# Quality.
SHOWN = {"StepSize": ("DoubleRangeWidget", "value"), "SamplesPerPixel": ("LineEdit0", "text2"),
         "PathModel": ("ComboBox", "currentText"), "Precision": ("ComboBox", "currentText")}
PRESETS = {}
for preset in ("Interactive", "Fine", "Publication", "Reference"):
    automatic.Quality = preset
    PRESETS[preset] = {name: automatic.GetProperty(name).GetData() for name in SHOWN}
assert PRESETS["Interactive"]["StepSize"] != PRESETS["Fine"]["StepSize"]


def check_quality(quality, base=None, **changes):
    """The panel shows this."""
    user.check("Quality/ComboBox", "currentText", quality)
    for name, value in dict(PRESETS[base or quality], **changes).items():
        widget, attribute = SHOWN[name]
        if isinstance(value, float):  # Qt 5 and 6 write numbers differently
            user.python(f"""
shown = widget("propertiesPanel", {name!r}, {widget!r}).property({attribute!r})
assert f"{{float(shown):g}}" == "{value:g}", ({name!r}, shown)
""")
        else:
            user.check(f"{name}/{widget}", attribute, value)


begin("quality")
user.event(PANEL + "/SearchBox/AdvancedButton", "set_boolean", "true")
check_quality("Interactive")
user.choose("Quality/ComboBox", "Fine")
check_quality("Fine")
user.apply()

# Cancelled.
user.choose("Quality/ComboBox", "Reference")
check_quality("Reference")
user.reset()
check_quality("Fine")
user.type("SamplesPerPixel/LineEdit0", "5")
check_quality("Custom", "Fine", SamplesPerPixel=5)
user.reset()
check_quality("Fine")

# Changed, changed back, and changed at last.
user.choose("Quality/ComboBox", "Publication")
user.type("SamplesPerPixel/LineEdit0", "5")
check_quality("Custom", "Publication", SamplesPerPixel=5)
user.type("SamplesPerPixel/LineEdit0", str(PRESETS["Publication"]["SamplesPerPixel"]))
check_quality("Publication")
user.type("SamplesPerPixel/LineEdit0", "3")
user.choose("PathModel/ComboBox", "Straight")
user.apply()
CUSTOM = {"SamplesPerPixel": 3, "PathModel": "Straight"}
check_quality("Custom", "Publication", **CUSTOM)
user.undo()
check_quality("Fine")
user.python(BENCH + "assert bench.Quality == 'Fine', bench.Quality")
user.redo()
check_quality("Custom", "Publication", **CUSTOM)
user.save_state("custom.pvsm")

user.play("""
from paraview.simple import *
flow = Calculator(Input=Wavelet(WholeExtent=3 * [-8, 8]), ResultArrayName="rho", Function="RTData", registrationName="flow")
flow.UpdatePipeline()
GetActiveViewOrCreate("RenderView")
SetActiveSource(flow)
""")


def text_of(part):
    with open(trace_of(part), encoding="utf-8") as trace:
        return trace.read()


for name in ("reset", "off", "undone", "redone"):
    assert np.abs(kept(name) - image_of_automatic.ravel()).max() < 1e-6, name
lines = traced(text_of("k"), "bench")
off = lines.index(("KMode", "'Value'"))
assert lines[off + 1][0] == "KScale" and float(lines[off + 1][1]) == k, lines
# A script of its own sets nothing else, too.
bench = scripted(KMode="Value")
bench.UpdatePipeline()
assert bench.KScale == 1000 and bench.FieldData["KScale"].GetRange()[0] == 1000

for name, properties in (("toepler", {"KMode": "Bench", "SourceShape": "Slit"}), ("dark", {"Cutoff": "Dark Field"}),
                         ("fringes", {"Cutoff": "Interferogram", "FringeSpacing": -10, "FringeAngle": 90})):
    assert np.array_equal(kept(name), image_array(scripted(**properties), "Intensity").ravel()), name
    assert np.ptp(kept(name)) > 0
assert np.array_equal(kept("toepler"), kept("toepler again"))
# Each preset is one entry of the trace.
lines = traced(text_of("presets"), "bench")
dark = lines.index(("Cutoff", "'Dark Field'"))
assert set(lines[dark:dark + 3]) == {("Cutoff", "'Dark Field'"), ("KMode", "'Automatic Kept'"),
                                     ("SourceShape", "'Point'")}, lines

wheel = kept("wheel")
assert np.array_equal(wheel.reshape(32, 32, 3), image_array(scripted(Cutoff="Color Filter"), "Color"))
assert np.array_equal(wheel, kept("cleared")) and np.array_equal(kept("loaded"), kept("loaded still"))
assert np.abs(kept("loaded").astype(int) - wheel).max() > 100, "The loaded filter changes nothing"
# The same as the file that a script names.
assert np.array_equal(kept("loaded").reshape(32, 32, 3),
                      image_array(scripted(Cutoff="Color Filter", ColorFilterImage=FILTER), "Color"))
for state, name in (("loaded", "ColorFilterImage"), ("background", "BackgroundImage")):
    load(state + ".pvsm")
    assert np.array_equal(png_of_text(simple.FindSource("bench").GetPropertyValue(name)), COLORS), state


def check_custom(bench):
    assert bench.Quality == "Custom", bench.Quality
    found = {name: bench.GetProperty(name).GetData() for name in SHOWN}
    assert found == dict(PRESETS["Publication"], **CUSTOM), found
    assert bench.GetClientSideObject().GetQuality() == vtkSchlierenFilter.CUSTOM


load("custom.pvsm")
check_custom(simple.FindSource("bench"))
# The traces of what was applied.
for part in ("filter", "quality"):
    simple.ResetSession()
    flow = simple.Calculator(Input=simple.Wavelet(WholeExtent=3 * [-8, 8]), ResultArrayName="rho", Function="RTData",
                             registrationName="flow")
    flow.UpdatePipeline()
    simple.SetActiveSource(Schlieren(Input=flow, registrationName="bench", **SETTINGS))
    traces = [text for text in text_of(part).split("# next\n") if ("base64" if part == "filter" else "bench") in text]
    exec(traces[0 if part == "filter" else -1], {})  # pylint: disable=exec-used
    bench = simple.FindSource("bench")
    if part == "filter":
        assert np.array_equal(png_of_text(bench.ColorFilterImage), COLORS)
    else:
        check_custom(bench)
