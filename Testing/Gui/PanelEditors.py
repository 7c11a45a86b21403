# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Gases, a gas mixture and fields with their transfer functions, made in the properties panel.

The window saves its state after every part; what the state holds is checked here, and what it shows
against a filter that was set up by a script.
"""

import os
import re
import sys

import numpy as np

sys.path.insert(0, os.path.join(os.environ["SCHLIEREN_SOURCE_DIR"], "Testing", "Python"))

from plugin_testing import Schlieren, image_array, simple  # noqa: E402
from paraview import smstate  # noqa: E402
from vtkmodules.util.numpy_support import numpy_to_vtk  # noqa: E402
from vtkmodules.vtkCommonDataModel import vtkImageData  # noqa: E402
from vtkmodules.vtkIOXML import vtkXMLImageDataWriter  # noqa: E402
from window_testing import FOLDER, PROPERTIES, Session  # noqa: E402

FLOW = os.path.join(FOLDER, "flow.vti")
TRACE = os.path.join(FOLDER, "trace.py")
POINTS = 24
LINE = [0, 0, 0.5, 0, 1, 1, 0.5, 0]  # points of the function that is not bent


def write_flow():
    """A column of helium in air, with some carbon dioxide and a temperature."""
    z, y, x = np.meshgrid(*3 * [np.linspace(-1, 1, POINTS)], indexing="ij")
    column = np.exp(-(x**2 + z**2) / 0.3**2)
    image = vtkImageData()
    image.SetDimensions(3 * [POINTS])
    image.SetOrigin(-1, -1, -1)
    image.SetSpacing(3 * [2 / (POINTS - 1)])
    for name, values in (("Y_CO2", 0.2 + 0.1 * y), ("Y_He", 0.5 * column),
                         ("rho", 1.2 - 0.8 * column), ("temperature", 300 + 100 * y)):
        array = numpy_to_vtk(values.ravel(), deep=True)
        array.SetName(name)
        image.GetPointData().AddArray(array)
    writer = vtkXMLImageDataWriter()
    writer.SetFileName(FLOW)
    writer.SetDataModeToBinary()
    writer.SetInputData(image)
    assert writer.Write() == 1


write_flow()
user = Session()
FIELDS, FIELD = "SchlierenFields", "SchlierenFields/Table/qt_scrollarea_viewport"

# One gas.
user.choose("Gas/ComboBox", "helium")
user.apply()
user.save_state("gas.pvsm")

# A mixture.
user.choose("IndexModel/ComboBox", "Gladstone-Dale Mixture")
user.check("Wavelength", "visible", "true")
user.python("""
for name, texts in (("MixtureArrays", ("Y_He", "Y_CO2")), ("MixtureGases", ("helium", "2.2e-4"))):
    found = widget("propertiesPanel", name)
    for text in texts:
        click(found.findChild(QtWidgets.QToolButton, "Add"))
        model = found.findChild(QtWidgets.QTableView).model()
        assert model.setData(model.index(model.rowCount() - 1, 0), text)
""")
user.type("Wavelength/DoubleLineEdit0", "500")
user.type("BackgroundGas/BackgroundGas", "nitrogen")
user.apply()
user.save_state("mixture.pvsm")

# Fields, one of them with a range; a point of the second one's function is made and moved.
user.choose("IndexModel/ComboBox", "Transfer Functions")
user.check(FIELDS + "/Table", "rowCount", 0)
user.click(FIELDS + "/Add")
user.choose(FIELD + "/Field0", "temperature")
user.click(FIELDS + "/Add")
user.choose(FIELD + "/Field1", "Y_He")
user.type(FIELD + "/From1", "0.1")
user.type(FIELD + "/To1", "0.4")
user.apply()
user.save_state("fields.pvsm")
CURVE = f"{PROPERTIES}/{FIELDS}/TransferFunction/1QVTKWidget0"
for event, x, y, buttons in (("mousePress", 0.5, 0.3, 1), ("mouseMove", 0.6, 0.2, 1),
                             ("mouseRelease", 0.6, 0.2, 0)):
    user.event(CURVE, event, f"({x},{y},1,{buttons},0)")
user.apply()
user.save_state("curve.pvsm")

# Fields go with one model.
user.check(FIELDS + "/TransferFunction", "visible", "true")
user.choose("IndexModel/ComboBox", "Gladstone-Dale")
user.check(FIELDS, "visible", "false")
user.reset()
user.check(FIELDS + "/TransferFunction", "visible", "true")

# Undone and done again; the last field removed; then the filter, while its editor is open.
user.click(FIELDS + "/Remove")
user.apply()
user.check(FIELDS + "/Table", "rowCount", 1)
user.save_state("removed.pvsm")
user.menu("menu_Edit", "actionEditUndo")
user.check(FIELDS + "/Table", "rowCount", 2)
user.save_state("undone.pvsm")
user.python(f"""
from paraview import smtrace
with open({TRACE!r}, "w") as file:
    file.write(smtrace.get_current_trace_output())
smtrace.stop_trace()
""")
user.click(FIELDS + "/Add")
user.delete()

# Refractive Index has the editor, too.
user.python("""
SetActiveSource(RefractiveIndex(Input=FindSource("flow"), registrationName="grid"))
""")
user.choose("IndexModel/ComboBox", "Transfer Functions")
user.click(FIELDS + "/Add")
user.choose(FIELD + "/Field0", "temperature")
user.apply()
user.python(f"""
grid = FindSource("grid")
assert list(grid.Fields) == ["temperature"] and list(grid.FieldRanges) == [0, 0]
assert [list(function.Points) for function in grid.TransferFunctions] == [{LINE}]
""")

user.play(f"""
from paraview.simple import *
flow = XMLImageDataReader(FileName=[{FLOW!r}], registrationName="flow")
flow.UpdatePipeline()
bench = Schlieren(Input=flow, registrationName="bench", Quality="Interactive", KMode="Automatic")
bench.Density = ["POINTS", "rho"]
bench.ImageSize = [32, 32]
from paraview import smtrace
smtrace.start_trace()
""")


def bench_of(state):
    simple.ResetSession()
    simple.LoadState(os.path.join(FOLDER, state))
    return simple.FindSource("bench")


def values(proxy, name):
    return list(proxy.GetProperty(name).GetData())


def scripted(**properties):
    """The image of a filter that a script has set up."""
    flow = simple.XMLImageDataReader(FileName=[FLOW])
    flow.UpdatePipeline()
    bench = Schlieren(Input=flow)
    bench.Density = ["POINTS", "rho"]
    bench.ImageSize = [32, 32]
    for name, value in properties.items():
        setattr(bench, name, value)
    return image_array(bench, "OpticalPathDifference")


def functions(proxy):
    return [list(function.Points) for function in proxy.TransferFunctions]


bench = bench_of("gas.pvsm")
assert bench.Gas == "helium" and bench.IndexModel == "Auto"
shown = image_array(bench, "OpticalPathDifference")
assert np.ptp(shown) > 0 and np.array_equal(shown, scripted(Gas="He"))

bench = bench_of("mixture.pvsm")
assert bench.IndexModel == "Gladstone-Dale Mixture" and bench.BackgroundGas == "nitrogen"
assert values(bench, "MixtureArrays") == ["Y_He", "Y_CO2"]
assert values(bench, "MixtureGases") == ["helium", "2.2e-4"]
shown = image_array(bench, "OpticalPathDifference")
assert np.ptp(shown) > 0 and np.array_equal(shown, scripted(
    IndexModel="Gladstone-Dale Mixture", Wavelength=500, MixtureArrays=["Y_He", "Y_CO2"],
    MixtureGases=["He", "2.2e-4"], BackgroundGas="N2"))

bench = bench_of("fields.pvsm")
assert values(bench, "Fields") == ["temperature", "Y_He"]
assert values(bench, "FieldRanges") == [0, 0, 0.1, 0.4]
assert functions(bench) == [LINE, LINE], functions(bench)
straight = image_array(bench, "OpticalPathDifference")

bench = bench_of("curve.pvsm")
first, curve = functions(bench)
assert first == LINE and len(curve) == 12 and curve[:4] == LINE[:4], (first, curve)
assert abs(curve[4] - 0.6) < 0.1 and abs(curve[5] - 0.8) < 0.1, curve  # 0.2 from the top
shown = image_array(bench, "OpticalPathDifference")
assert np.abs(shown - straight).max() > 0.01 * np.ptp(straight)
assert np.array_equal(shown, scripted(
    IndexModel="Transfer Functions", Fields=["temperature", "Y_He"], FieldRanges=[0, 0, 0.1, 0.4],
    TransferFunctions=[simple.CreatePiecewiseFunction(Points=points) for points in (LINE, curve)]))

# The state as a script brings all of it back.
simple.SetActiveSource(bench_of("curve.pvsm"))
script = smstate.get_state()
simple.ResetSession()
exec(script, {})  # pylint: disable=exec-used
bench = simple.FindSource("bench")
assert functions(bench) == [LINE, curve], functions(bench)
assert np.array_equal(image_array(bench, "OpticalPathDifference"), shown)

# So does the trace, up to where the last field was removed.
with open(TRACE, encoding="utf-8") as file:
    script = file.read()
last = re.search(r"^bench\.(Fields = |Set\(\n(    .*\n)*?    Fields=)\['temperature'\]", script,
                 re.MULTILINE).start()
simple.ResetSession()
flow = simple.XMLImageDataReader(FileName=[FLOW], registrationName="flow")
flow.UpdatePipeline()
bench = Schlieren(Input=flow, registrationName="bench")
bench.Density = ["POINTS", "rho"]
bench.ImageSize = [32, 32]
simple.SetActiveSource(bench)
exec(script[:last], {})  # pylint: disable=exec-used
assert functions(bench) == [LINE, curve], functions(bench)
assert values(bench, "MixtureGases") == ["helium", "2.2e-4"]
assert np.array_equal(image_array(bench, "OpticalPathDifference"), shown)

bench = bench_of("removed.pvsm")
assert values(bench, "Fields") == ["temperature"] and functions(bench) == [LINE]
assert len(bench.FieldRanges) == 2
with open(os.path.join(FOLDER, "removed.pvsm"), encoding="utf-8") as file:
    text = file.read()
assert "SchlierenField1." in text and "SchlierenField2." not in text  # nobody needs it

bench = bench_of("undone.pvsm")
assert values(bench, "Fields") == ["temperature", "Y_He"]
assert functions(bench) == [LINE, curve], functions(bench)
