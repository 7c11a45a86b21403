# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Compare With Photograph in scripts: defaults as the XML has them, a PNG file compared with the image of which it was made, another
view of it without another fit, ParaView's filters behind it, states, and a mistake in one message."""

import os
import re

import numpy as np
from defaults_testing import check_defaults, property_tables
from paraview import simple, smstate
from plugin_testing import CompareWithPhotograph, Schlieren, comes_back, gaussian_column, image_array, is_empty, output
from schlieren.vtkSchlierenFilters import vtkCompareWithPhotograph
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkIOImage import vtkPNGWriter

SIZE = 200
column = gaussian_column(48)
bench = Schlieren(column, Density=["POINTS", "rho"], KnifeEdgeAngle=0, ImageSize=[SIZE, SIZE], ParallelScale=0.6)


def write(values, name):
    """Values from 0 to 1 as an 8-bit PNG file; the file's reader."""
    image = vtkImageData()
    image.SetDimensions(values.shape[1], values.shape[0], 1)
    image.GetPointData().SetScalars(
        numpy_to_vtk(np.round(255 * np.clip(values, 0, 1)).astype(np.uint8).ravel(), deep=True))
    writer = vtkPNGWriter()
    writer.SetFileName(os.path.abspath(name))
    writer.SetInputData(image)
    writer.Write()
    return simple.PNGSeriesReader(FileNames=[os.path.abspath(name)])


# A photograph with another k, of a camera of gamma 2.2; one without flow.
deflection, k, offset, gamma = image_array(bench, "Deflection")[..., 0], 1.5 * bench.FieldData["KScale"].GetRange()[0], -0.1, 2.2
undisturbed = 0.5 - offset
light = np.clip(undisturbed + k * deflection, 0, 1)
assert (light == 1).mean() > 0.01
photograph = write((0.9 * light) ** (1 / gamma), "photograph.png")
without_flow = write(np.full((SIZE, SIZE), (0.9 * undisturbed) ** (1 / gamma)), "without_flow.png")
comparison = CompareWithPhotograph(Input=bench, Photograph=photograph, WithoutFlow=without_flow)

# Proxies and the class have the XML's defaults, and PrintSelf names them.
made = vtkCompareWithPhotograph()
checked = check_defaults(comparison, made, property_tables.PHOTOGRAPH_FILES)
assert len(checked) == 18, checked
assert all(f"{item.name}:" in str(made) for item in checked)


def field(name, proxy=comparison):
    return proxy.FieldData[name].GetRange()[0]


def report():
    comparison.UpdatePipeline()
    comparison.UpdatePropertyInformation()
    return str(comparison.GetProperty("Report").GetData())


comparison.Gamma = gamma
comparison.BlackLevel = 0
assert "k is" in report(), report()

assert abs(field("PhotographK") / k - 1) < 0.01, field("PhotographK") / k
assert abs(field("PhotographOffset") - offset) < 0.005, field("PhotographOffset")
assert field("PhotographResidual") < 0.01, field("PhotographResidual")
assert "along one direction only" in report() and report().count("at 0 degrees") == 1, report()
assert not {"PhotographAngle", "PhotographAngleUncertainty"} & set(comparison.FieldData.keys())
assert abs(field("PhotographScale") / output(bench).GetSpacing()[0] - 1) < 1e-6
notes = output(comparison).GetFieldData().GetAbstractArray("LegendNotes")
assert any("photograph: k" in notes.GetValue(i) for i in range(notes.GetNumberOfValues()))

# The column deflects light to its sides only: whatever the angle of the image's edge, what is found holds for that, and for
# an edge across the deflection where the image's is blind.
for angle, holds_for in ((40, 40), (150, 330), (90, 0)):
    bench.KnifeEdgeAngle = angle
    cosine = np.cos(np.deg2rad(holds_for))
    assert f"at {holds_for} degrees" in report() or angle == 90, report()
    assert abs(field("PhotographK") * cosine / k - 1) < 0.01, (angle, field("PhotographK") * cosine / k)
bench.KnifeEdgeAngle = 0

# The place under the mouse in words.
here = comparison.GetClientSideObject()
comparison.Placement = "By Hand"
comparison.PhotographPosition = [-3 * output(bench).GetSpacing()[0], 0]
report()
here.SetProbedPlace(0.2, 0.5)
assert re.search(r"photograph 0\.\d+, simulated 0\.\d+\nx, y: ", here.GetProbedPlace()), here.GetProbedPlace()
here.SetProbedPlace(1 - 0.5 / SIZE, 0.5)
assert here.GetProbedPlace().startswith("Beyond the photograph\n"), here.GetProbedPlace()
here.SetProbedPlace(2, 0.5)
assert here.GetProbedPlace() == ""
comparison.Placement = "Fill Image"
report()

# Another view changes the array that is shown, and fits nothing again.
swiped = image_array(comparison, "Comparison")
found = field("PhotographK")
comparison.Comparison = "Difference"
grey = image_array(comparison, "Comparison")
assert field("PhotographK") == found and np.abs(grey.astype(int) - 128).max() < 10 < np.ptp(swiped)

# ParaView's filters take the arrays.
line = simple.PlotOverLine(Input=comparison, Point1=[-0.5, 0, 0], Point2=[0.5, 0, 0])
line.UpdatePipeline()
assert {"Photograph", "Simulated", "Difference", "FeatureShift"} <= set(line.PointData.keys())

# One message for a photograph that lies elsewhere, and an image again.
comparison.Placement = "By Hand"
comparison.PhotographPosition = [50, 0]
assert is_empty(comparison)
comparison.Placement = "Fill Image"
assert "k is" in report()

simple.SaveState("photograph.pvsm")


def check():
    proxy = next(source for (name, _), source in simple.GetSources().items() if name.startswith("CompareWith"))
    assert proxy.Gamma == gamma and proxy.Comparison == "Difference" and proxy.Placement == "Fill Image"
    proxy.UpdatePipeline()
    assert abs(field("PhotographK", proxy) / k - 1) < 0.01


comes_back("photograph.pvsm", smstate.get_state(), check)
