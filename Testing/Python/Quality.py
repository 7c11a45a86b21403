# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The presets of Quality and the properties that they set, as scripts, state files and traces have them."""

import os
import re

from paraview import simple, smstate, smtrace
from plugin_testing import MadeByUsers, Schlieren, comes_back, gaussian_column
from schlieren.vtkSchlierenFilters import vtkSchlierenFilter

PRESETS = ("Interactive", "Fine", "Publication", "Reference", "Automatic")
SETTINGS = []
while vtkSchlierenFilter.GetQualitySetting(len(SETTINGS)):
    SETTINGS.append(vtkSchlierenFilter.GetQualitySetting(len(SETTINGS)))
assert len(SETTINGS) == 6

source = gaussian_column(16)


def values(proxy):
    """The settings as a script sees them."""
    return {name: proxy.GetProperty(name).GetData() for name in SETTINGS}


def check(proxy, quality, **changes):
    """The proxy has this quality and the values of the preset, but for `changes` (and `preset`)."""
    expected = dict(table[changes.pop("preset", quality)], **changes)
    assert proxy.GetProperty("Quality").GetData() == quality, (proxy.Quality, quality)
    assert values(proxy) == expected, (values(proxy), expected)
    # The filter itself has the same.
    made = proxy.GetClientSideObject()
    for name in SETTINGS:
        there, here = getattr(made, "Get" + name)(), proxy.GetProperty(name).SMProperty.GetElement(0)
        assert there == here, (name, there, here)
    assert (PRESETS + ("Custom",))[made.GetQuality()] == quality


# What a preset is made of: the filter's table, the properties' defaults and the document agree.
bench = Schlieren(source)
table = {}
for number, preset in enumerate(PRESETS):
    bench.Quality = preset
    table[preset] = values(bench)
    for i, name in enumerate(SETTINGS):
        assert bench.GetProperty(name).SMProperty.GetElement(0) == \
            vtkSchlierenFilter.GetQualityValue(number, i), (preset, name)
assert len({str(settings) for settings in table.values()}) == 5, "Two presets are the same"
with open(os.path.join(os.environ["SCHLIEREN_SOURCE_DIR"], "Documentation", "quality.md"),
          encoding="utf-8") as file:
    rows = [[cell.strip() for cell in line.split("|")[1:-1]] for line in file if line[0] == "|"]
assert rows[0] == ["property", *PRESETS], rows[0]
documented = {row[0]: row[1:] for row in rows[2:2 + len(SETTINGS)]}
assert list(documented) == SETTINGS, documented
for number, preset in enumerate(PRESETS):
    for name in SETTINGS:
        value = table[preset][name]
        assert documented[name][number] == (value if isinstance(value, str) else f"{value:.10g}"), \
            (preset, name, documented[name][number], value)
check(MadeByUsers(source), "Automatic")

# A preset first, then what shall differ from it.
check(Schlieren(Input=source, Quality="Fine"), "Fine")
check(Schlieren(Input=source, Quality="Fine", SamplesPerPixel=17), "Custom", preset="Fine",
      SamplesPerPixel=17)
check(Schlieren(Input=source, Quality="Fine", SamplesPerPixel=4), "Fine")
bench = Schlieren(source, StepSize=0.5)
check(bench, "Custom", preset="Interactive", StepSize=0.5)
bench.Quality = "Reference"
check(bench, "Reference")
for name, value in (("PathModel", "Straight"), ("StepSize", 0.3),
                    ("SamplesPerPixel", 7), ("Precision", "Single"),
                    ("MediumTolerance", 0.3), ("TargetError", 0.3)):
    before = bench.GetProperty(name).GetData()
    setattr(bench, name, value)
    check(bench, "Custom", preset="Reference", **{name: value})
    bench.Quality = "Custom"  # sets nothing
    check(bench, "Custom", preset="Reference", **{name: value})
    setattr(bench, name, before)
    check(bench, "Reference")

# Another value of a setting has its effect.
for name, value in (("StepSize", 0.3), ("SamplesPerPixel", 7), ("TargetError", 0.3)):
    bench.Quality = "Automatic"
    check(bench, "Automatic")
    setattr(bench, name, value)
    check(bench, "Custom", preset="Automatic", **{"TargetError": 0, name: value})

# The path model has its effect with a target, too.
bench.Quality = "Automatic"
bench.PathModel = "Straight"
check(bench, "Custom", preset="Automatic", PathModel="Straight")
bench.PathModel = "Refracted"
check(bench, "Automatic")

# A filter with each quality, brought back by a state file, a script and a trace.
benches = {preset: Schlieren(Input=source, registrationName=preset, Quality=preset)
           for preset in PRESETS}
benches["Odd"] = Schlieren(Input=source, registrationName="Odd", Quality="Reference",
                           SamplesPerPixel=3, PathModel="Straight")
# As by default in what is not so in the preset.
benches["Mixed"] = Schlieren(Input=source, registrationName="Mixed", Quality="Publication",
                             StepSize=table["Interactive"]["StepSize"])
kept = {name: (str(proxy.Quality), values(proxy)) for name, proxy in benches.items()}
simple.SaveState("quality.pvsm")
script = smstate.get_state()
del benches
smtrace.start_trace()
for name, (quality, settings) in kept.items():
    Schlieren(Input=source, registrationName=name, **settings)
trace = smtrace.stop_trace()


def check_kept(found=simple.FindSource):
    for name, (quality, settings) in kept.items():
        proxy = found(name)
        assert (str(proxy.Quality), values(proxy)) == (quality, settings), (name, values(proxy))
        made = proxy.GetClientSideObject()
        assert str(proxy.Quality) == repr((PRESETS + ("Custom",))[made.GetQuality()])


comes_back("quality.pvsm", script, check_kept)

# A state file in which properties have no elements is loaded, however little sense it makes.
with open("quality.pvsm", encoding="utf-8") as file:
    state = file.read()
for name in table["Interactive"]:
    broken, count = re.subn(rf'(<Property name="{name}"[^>]*number_of_elements=")1(">)\s*<Element [^>]*/>', r"\g<1>0\2", state)
    assert count >= len(kept), (name, count)
    with open("broken.pvsm", "w", encoding="utf-8") as file:
        file.write(broken)
    simple.ResetSession()
    simple.LoadState(os.path.abspath("broken.pvsm"))
    assert simple.FindSource("Odd"), name
simple.ResetSession()
simple.XMLImageDataReader(FileName=[os.path.abspath("column16.vti")], registrationName=re.search(
    r"FindSource\('(XMLImageDataReader\d*)'\)", trace).group(1)).UpdatePipeline()
exec(trace, {})  # pylint: disable=exec-used
check_kept()
