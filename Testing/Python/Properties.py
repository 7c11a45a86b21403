# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Names, values and defaults that scripts rely on, and what a change of each one does again."""

import numpy as np
from defaults_testing import check_defaults, property_tables
from plugin_testing import MadeByUsers, RefractiveIndex, Schlieren, gaussian_column, output, image_array
from schlieren.vtkSchlierenFilters import vtkRefractiveIndex, vtkSchlierenFilter

source = gaussian_column(32)

refractivity = RefractiveIndex(source)
bench = MadeByUsers(source)

# Proxies and classes have the XML's defaults.
checked = (check_defaults(refractivity, vtkRefractiveIndex(), property_tables.FILES[:1]) +
           check_defaults(bench, vtkSchlierenFilter(), property_tables.FILES))
assert len(checked) > 70, len(checked)
for proxy in (refractivity, bench):
    for name in ("Density", "Temperature", "Pressure", "Humidity", "IndexArray"):
        assert len(getattr(proxy, name)) == 2, name
for item in property_tables.read().values():
    if item.entries:
        assert set(bench.GetProperty(item.name).Available) == set(item.entries), item.name

# PrintSelf names them all.
printed = str(vtkSchlierenFilter())
for item in property_tables.read().values():
    if item.group not in ("Inputs", "Commands", "Information") and not item.is_array and item.command:
        name = item.command.replace("Set", "", 1).replace("Add", "", 1)
        forms = (f" {name}: ", f" {name}s:", f" {name}es:")
        assert any(form in printed for form in forms), name

# The panel shows what belongs to a cutoff: the XML's lists of cutoffs are those of the table in Optics/Techniques.h.
properties = property_tables.read()
CUTOFFS = properties["Cutoff"].entries
assert sorted(CUTOFFS.values()) == list(range(len(CUTOFFS)))
for text, number in CUTOFFS.items():
    assert getattr(vtkSchlierenFilter, text.upper().replace(" ", "_")) == number, text
made = vtkSchlierenFilter()
made.SetCutoff(1000)
assert made.GetCutoff() == max(CUTOFFS.values())
assert not vtkSchlierenFilter.CutoffHasK(-1) and not vtkSchlierenFilter.CutoffHasK(len(CUTOFFS))


def cutoffs_with(*features):
    return {number for number in CUTOFFS.values() if any(feature(number) for feature in features)}


WITH_K, WITH_EDGE, WITH_FRINGES, WITH_SCREEN, WITH_BACKGROUND = (
    cutoffs_with(getattr(vtkSchlierenFilter, "CutoffHas" + feature))
    for feature in ("K", "Edge", "Fringes", "Screen", "Background"))
shown_with = {}
for item in properties.values():
    first_page = {inner for outer in item.element.iter("PropertyWidgetDecorator") if outer.get("type") == "SchlierenFirstPage"
                  for inner in outer.iter()}
    for decorator in item.element.iter("PropertyWidgetDecorator"):
        if decorator.get("property") == "Cutoff" and decorator not in first_page:
            listed = {int(number) for number in (decorator.get("values") or decorator.get("value")).split()}
            if decorator.get("inverse") == "1":
                listed = set(CUTOFFS.values()) - listed
            shown_with[item.name] = shown_with.get(item.name, set()) | listed
for shown, names in (
        (WITH_K, "KMode KScale MirrorFocalLength SourceWidth"),
        (WITH_K | WITH_FRINGES | WITH_BACKGROUND, "Sensitivity"),
        (WITH_EDGE, "KnifeEdgeAngle CutoffOffset"),
        ({vtkSchlierenFilter.PHASE_CONTRAST}, "PhasePlateDiameter PhasePlateDelay PhasePlateTransmission"),
        (WITH_FRINGES | {vtkSchlierenFilter.PHASE_CONTRAST}, "Wavelength"), (WITH_FRINGES, "FringeSpacing"), (WITH_FRINGES | WITH_BACKGROUND, "FringeAngle"),
        (WITH_SCREEN, "ScreenDistance"), (set(CUTOFFS.values()) - WITH_SCREEN, "FocusOffset"),
        (WITH_BACKGROUND, "BackgroundPattern BackgroundDistance BackgroundPeriod BackgroundImage"),
        ({vtkSchlierenFilter.GRADED_FILTER}, "GradedFilter"), ({vtkSchlierenFilter.COLOR_FILTER}, "ColorFilterImage")):
    assert shown, names
    for name in names.split():
        assert shown_with.pop(name) == shown, f"{name} is shown with other cutoffs than {shown} that have it"
assert not shown_with, f"{shown_with} depend on Cutoff, but this test does not know by what"


def work(proxy):
    """How often it has built the medium, and how many rays it has traced."""
    proxy.UpdatePipeline()
    bench = proxy.GetClientSideObject()
    return (bench.GetMediumBuilds(), bench.GetTotalRaysTraced())


def current(name):
    """A property's value, which stays as it is when the property changes."""
    return bench.GetProperty(name).GetData()


# Every value reaches the filter: it changes what comes out.
bench.Density = ["POINTS", "rho"]
bench.ImageSize = [48, 32]
bench.PathModel = "Refracted"
bench.SamplesPerPixel = 4  # the first is at the pixel's centre
assert output(bench).GetDimensions() == (48, 32, 1)
before = work(bench)
reference = image_array(bench, "Intensity")
for name, value in (("KnifeEdgeAngle", 30), ("CutoffOffset", 0.1), ("Cutoff", "Shadowgraph")):
    default = current(name)
    setattr(bench, name, value)
    assert not np.array_equal(image_array(bench, "Intensity"), reference), name
    setattr(bench, name, default)
    assert np.array_equal(image_array(bench, "Intensity"), reference), name
bench.KMode = "Value"
bench.KScale = 10
assert np.abs(image_array(bench, "Intensity") - 0.5).max() < 0.1
bench.KMode = "Automatic"
assert work(bench) == before, "Cutoffs and k must need no re-tracing"

chained = Schlieren(refractivity)
chained.ImageSize = [48, 32]
before = work(chained)
chained.KnifeEdgeAngle = 90
assert work(chained) == before, "Neither must they after Refractive Index"

for name, value in (("ViewDirection", [1, 0, -1]), ("ViewUp", [1, 1, 0]), ("ParallelScale", 0.3),
                    ("StepSize", 0.7), ("SamplesPerPixel", 2),
                    ("PathModel", "Straight"),
                    ("Precision", "Double"), ("LengthScale", 0.1),
                    ("GladstoneDaleConstant", 1e-4), ("DensityScale", 2)):
    default = current(name)
    # Optical paths are those of pixels' centres, however many rays there are.
    array = "Intensity" if name == "SamplesPerPixel" else "OpticalPathDifference"
    reference = image_array(bench, array)
    setattr(bench, name, value)
    assert not np.array_equal(image_array(bench, array), reference), name
    setattr(bench, name, default)
    assert np.array_equal(image_array(bench, array), reference), name

# What light leaves the data into: angles by its index.
free = image_array(bench, "Deflection")
bench.ExitInto, bench.ExitRefractivity = "Custom", 0.5
assert np.allclose(image_array(bench, "Deflection"), free / 1.5, atol=1e-3 * np.abs(free).max())
bench.ExitInto = "Auto"
assert np.array_equal(image_array(bench, "Deflection"), free)

# The focal point: empty means the data's centre.
centred = output(bench).GetOrigin()
bench.FocalPoint = [0.25, -0.5, 3]
moved = output(bench).GetOrigin()
assert np.allclose(np.subtract(moved, centred), [0.25, -0.5, 0]), (moved, centred)
bench.FocalPoint = []
assert np.allclose(output(bench).GetOrigin(), centred)

# A shadowgraph's screen: an automatic one is further away than the far side of the data.
bench.Cutoff = "Shadowgraph"
automatic, bench.ScreenDistance = image_array(bench, "Intensity"), 0
assert automatic.std() > 2 * image_array(bench, "Intensity").std() > 0

field = output(bench).GetFieldData()
for name in ("Device", "PathModel", "KScale", "AmbientRefractivity", "ExitRefractivity", "RaysTraced", "RaysLost",
             "StepsTaken", "TraceSeconds", "MomentumDrift"):
    assert field.HasArray(name), name
