# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""A colour filter loaded from a PNG in the properties panel: shown, applied, undone, cleared and kept."""

import base64
import os
import sys

import numpy as np

sys.path.insert(0, os.path.join(os.environ["SCHLIEREN_SOURCE_DIR"], "Testing", "Python"))

from plugin_testing import Schlieren, image_array, simple  # noqa: E402
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy  # noqa: E402
from vtkmodules.vtkCommonDataModel import vtkImageData  # noqa: E402
from vtkmodules.vtkIOImage import vtkPNGReader, vtkPNGWriter  # noqa: E402
from window_testing import FOLDER, PROPERTIES, Session  # noqa: E402

FILTER, TEXT = os.path.join(FOLDER, "quarters.png"), os.path.join(FOLDER, "text.png")
TRACE = os.path.join(FOLDER, "trace.py")

# Red where light is deflected to the right, green up, blue left, white down: row 0 is the lowest.
SIDE = 16
v, u = np.mgrid[:SIDE, :SIDE] - (SIDE - 1) / 2
COLORS = np.array([(255, 0, 0), (0, 255, 0), (0, 0, 255), (255, 255, 255)], np.uint8)[
    np.rint(np.arctan2(v, u) / (np.pi / 2)).astype(int) % 4]
image = vtkImageData()
image.SetDimensions(SIDE, SIDE, 1)
image.GetPointData().SetScalars(numpy_to_vtk(COLORS.reshape(-1, 3), deep=True))
writer = vtkPNGWriter()
writer.SetFileName(FILTER)
writer.SetInputData(image)
writer.Write()
with open(TEXT, "w", encoding="utf-8") as file:
    file.write("This is no image.")

user = Session()
WIDGET, DIALOG = "ColorFilterImage", "pqClientMainWindow/LoadImageDialog"


def check(note, can_clear):
    user.check(WIDGET + "/Note", "text", note)
    user.check(WIDGET + "/Clear", "enabled", str(can_clear).lower())


# It is there for the cutoff that takes it, with the keyboard too.
user.check(WIDGET, "visible", "false")
user.choose("Cutoff/ComboBox", "Color Filter")
user.check(WIDGET, "visible", "true")
check("the colour wheel", False)
user.apply()
user.save_state("wheel.pvsm")
user.key(WIDGET + "/Load", "Space")
user.event(DIALOG, "filesSelected", FILTER)
check(f"quarters.png: {SIDE} x {SIDE} pixels", True)

# Cancelled, then kept.
user.reset()
check("the colour wheel", False)
user.click(WIDGET + "/Load")
user.event(DIALOG, "filesSelected", FILTER)
user.apply()
user.save_state("loaded.pvsm")

# What is no image changes nothing.
user.click(WIDGET + "/Load")
user.event(DIALOG, "filesSelected", TEXT)
check(f"Cannot read '{TEXT}': Unsupported image format. The image is the one from before.", True)
user.save_state("kept.pvsm")

user.menu("menu_Edit", "actionEditUndo")
check("the colour wheel", False)
user.menu("menu_Edit", "actionEditRedo")
check(f"quarters.png: {SIDE} x {SIDE} pixels", True)
user.click(WIDGET + "/Clear")
check("the colour wheel", False)
user.apply()
user.save_state("cleared.pvsm")

user.choose("Cutoff/ComboBox", "Background Oriented")
user.choose("BackgroundPattern/ComboBox", "Picture")
user.check("BackgroundImage/Note", "text", "no image")
user.click("BackgroundImage/Load")
user.event(DIALOG, "filesSelected", FILTER)
user.check("BackgroundImage/Note", "text", f"quarters.png: {SIDE} x {SIDE} pixels")
user.apply()
user.save_state("background.pvsm")

user.play(f"""
from paraview.simple import *
flow = Calculator(Input=Wavelet(WholeExtent=3 * [-8, 8]), ResultArrayName="rho", Function="RTData", registrationName="flow")
flow.UpdatePipeline()
bench = Schlieren(Input=flow, registrationName="bench", ImageSize=[32, 32])
bench.GladstoneDaleConstant = 1e-6

# What is traced whenever something is applied.
from paraview import servermanager, smtrace
smtrace.start_trace()
def write(*_):
    text = smtrace.get_current_trace_output()
    if "base64" in text:
        with open({TRACE!r}, "w") as file:
            file.write(text)
        smtrace.stop_trace()
bench.SMProxy.AddObserver("UpdateEvent", write)
""")


def bench_of(state):
    simple.ResetSession()
    simple.LoadState(os.path.join(FOLDER, state + ".pvsm"))
    return simple.FindSource("bench")


def scripted(**properties):
    """The image of a filter that a script has set up."""
    flow = simple.Calculator(Input=simple.Wavelet(WholeExtent=3 * [-8, 8]), ResultArrayName="rho", Function="RTData")
    flow.UpdatePipeline()
    bench = Schlieren(Input=flow, ImageSize=[32, 32], GladstoneDaleConstant=1e-6, **properties)
    return image_array(bench, properties.get("Array", "Color"))


def decoded(text):
    """The image that a property holds: rows x columns x 3, lowest row first."""
    head = "data:image/png;base64,"
    assert text.startswith(head), text[:40]
    path = os.path.join(FOLDER, "decoded.png")
    with open(path, "wb") as file:
        file.write(base64.b64decode(text[len(head):]))
    reader = vtkPNGReader()
    reader.SetFileName(path)
    reader.Update()
    columns, rows, _ = reader.GetOutput().GetDimensions()
    return vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars()).reshape(rows, columns, 3)


bench = bench_of("wheel")
assert bench.ColorFilterImage == ""
wheel = image_array(bench, "Color")
assert np.array_equal(wheel, scripted(Cutoff="Color Filter"))

for state in ("loaded", "kept"):
    bench = bench_of(state)
    assert np.array_equal(decoded(bench.ColorFilterImage), COLORS)
    shown = image_array(bench, "Color")
    assert np.abs(shown.astype(int) - wheel).max() > 100, "The loaded filter changes nothing"
    # The same as the file that a script names.
    assert np.array_equal(shown, scripted(Cutoff="Color Filter", ColorFilterImage=FILTER))

bench = bench_of("cleared")
assert bench.ColorFilterImage == ""
assert np.array_equal(image_array(bench, "Color"), wheel)

assert np.array_equal(decoded(bench_of("background").BackgroundImage), COLORS)

with open(TRACE, encoding="utf-8") as file:
    script = file.read()
simple.ResetSession()
flow = simple.Calculator(Input=simple.Wavelet(WholeExtent=3 * [-8, 8]), ResultArrayName="rho", Function="RTData", registrationName="flow")
flow.UpdatePipeline()
simple.SetActiveSource(Schlieren(Input=flow, registrationName="bench", ImageSize=[32, 32]))
exec(script, {})  # pylint: disable=exec-used
assert np.array_equal(decoded(simple.FindSource("bench").ColorFilterImage), COLORS)
