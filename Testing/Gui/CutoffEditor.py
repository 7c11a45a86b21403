# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The cutoff plane in the properties panel: what is dragged by so many pixels is what the geometry says, and
is at once in the image; undone, traced and kept like anything else."""

import json
import os

import numpy as np
from views_testing import image_array, simple
from plugin_testing import Schlieren
from window_testing import FOLDER, PANEL, PROPERTIES, Session

SIDE, RANGE, K = 280, 0.005, 200  # pixels, radians
PIXEL = 2 * RANGE / SIDE
MIDDLE = np.array([20 + SIDE / 2, 2 + SIDE / 2])  # of the widget; pixels, give or take a few
PLANE = "SchlierenCutoff/Plane"
SHIFT = 0x02000000
TRACE, LOG = os.path.join(FOLDER, "trace.py"), os.path.join(FOLDER, "log.json")
FOCAL_LENGTH = 1e-3 * K  # metres: of a source 1 mm wide k is K
SETTINGS = {"ImageSize": [32, 32], "GladstoneDaleConstant": 2e-6, "MirrorFocalLength": FOCAL_LENGTH,
            "Quality": "Interactive"}

user = Session()
saved = {}


def scripted(**properties):
    """A filter that a script has set up."""
    flow = simple.Calculator(Input=simple.Wavelet(WholeExtent=3 * [-8, 8]), ResultArrayName="rho", Function="RTData")
    flow.UpdatePipeline()
    bench = Schlieren(Input=flow, **SETTINGS, **properties)
    bench.UpdatePipeline()
    return bench


def automatic_k(cutoff):
    return scripted(Cutoff=cutoff).FieldData["KScale"].GetRange()[0]


def drag(begin, *ways, modifiers=0):
    """From a place given from the middle, u right and v up, by ways from there, pixels."""
    places = [MIDDLE + (begin[0], -begin[1])]
    places += [places[0] + (u, -v) for u, v in ways]
    user.drag(PLANE, *[tuple(np.rint(place).astype(int)) for place in places], modifiers=modifiers)


def expect(name, **properties):
    """From here on the state has these properties, and nothing waits for Apply."""
    user.check_at(PANEL + "/Accept", "enabled", "false")
    saved[name] = {**(list(saved.values()) or [{}])[-1], **properties}
    user.python(f"""
import json
bench = FindSource("bench")
until(lambda: finished(bench))
bench.UpdatePipeline()
np.save(os.path.join(FOLDER, {name + ".npy"!r}), intensity(bench))
with open(os.path.join(FOLDER, {name + ".json"!r}), "w") as file:
    json.dump({{key: bench.GetProperty(key).GetData() for key in {sorted(saved[name])}}}, file)
""")


def settle():
    """Until the light of another image is shown, which waits a moment for yet another."""
    user.python("bench = FindSource('bench')\nuntil(lambda: finished(bench))\npause(0.3)")


settle()
user.check(PLANE, "enabled", "true")
user.size_plane(SIDE)
user.check(PLANE, "range", RANGE)

# The edge: 21 pixels to the right, where the mouse is released without a move there. In between 40; the image is there before that.
edge, on_the_way = round(K * 21 * PIXEL, 3), round(K * 40 * PIXEL, 3)
x, y = (MIDDLE + (0, -30)).astype(int)
user.event(f"{PROPERTIES}/{PLANE}", "mousePress", f"1,1,0,{x},{y}")
user.event(f"{PROPERTIES}/{PLANE}", "mouseMove", f"0,1,0,{x + 40},{y}")
user.python(f"until(lambda: '{on_the_way}' in open({LOG!r}).read())")
user.event(f"{PROPERTIES}/{PLANE}", "mouseRelease", f"1,0,0,{x + 21},{y}")
user.check("CutoffOffset/DoubleLineEdit0", "text", edge)
expect("edge", CutoffOffset=edge, KMode="Value", KScale=K, KnifeEdgeAngle=0)

# Turned by 60 degrees and a little, in steps of 15; back by 30 with less than a pixel's error.
R = 0.84 * SIDE / 2
drag((R, 0), (R * np.cos(np.radians(63)) - R, R * np.sin(np.radians(63))), modifiers=SHIFT)
user.check("KnifeEdgeAngle/DoubleLineEdit0", "text", 60)
expect("turned", KnifeEdgeAngle=60)

# A click and what is cancelled change nothing; nor does it make a step that can be undone.
drag((0, 0), (0, 0))
expect("clicked")

# Full light at half the distance is twice the sensitivity; undisturbed light is as bright as before.
along = np.array([np.cos(np.radians(60)), np.sin(np.radians(60))])
full = (0.5 + edge) / K
way = np.rint(-0.5 * full / PIXEL * along)
drag(np.rint(full / PIXEL * along), tuple(way))
scaled = float(f"{K * full / (full + PIXEL * way @ along):.4g}")
assert abs(scaled - 2 * K) < 0.05 * K
expect("scaled", KScale=scaled)
user.menu("menu_Edit", "actionEditUndo")
user.check("KScale/DoubleLineEdit0", "text", K)
user.check("KnifeEdgeAngle/DoubleLineEdit0", "text", 60)
expect("undone", KScale=K)
user.menu("menu_Edit", "actionEditUndo")
user.check("KnifeEdgeAngle/DoubleLineEdit0", "text", 0)
user.check("CutoffOffset/DoubleLineEdit0", "text", edge)
user.menu("menu_Edit", "actionEditRedo")

# By keys: the edge by a hundredth of the range, and by a degree. In smaller pixels everything fits.
for key in ("Right", "Up", "Minus"):
    user.key(PLANE, key)
keyed = round(edge + K * RANGE / 100, 3)
user.check("CutoffOffset/DoubleLineEdit0", "text", keyed)
user.check(PLANE, "range", 2 * RANGE)
expect("keyed", CutoffOffset=keyed, KScale=float(f"{1.02 * K:.4g}"))
user.key(PLANE, "Home")
user.check(PLANE, "range", RANGE)

# What is typed but not applied waits on.
user.choose("ImageSize/LineEdit0", "40")
drag(np.rint(keyed / (1.02 * K) / PIXEL * along), tuple(np.rint(30 * along)))
user.check("ImageSize/LineEdit0", "text", "40")
user.check_at(PANEL + "/Accept", "enabled", "true")
user.reset()
user.check("ImageSize/LineEdit0", "text", "32")
further = round(keyed + 1.02 * K * PIXEL * (np.rint(30 * along) @ along), 3)
expect("waited", CutoffOffset=further)

# A circle, whose sensitivity was automatic before its radius was dragged; undone at one go.
automatic = automatic_k("Bright Field")
circle = next(r for r in (0.001, 0.002, 0.005, 0.01) if r > 1.3 / automatic)
user.choose("Cutoff/ComboBox", "Bright Field")
user.choose("KMode/ComboBox", "Automatic")
user.apply()
settle()
user.check(PLANE, "range", circle)
rim = round(1 / automatic / (2 * circle / SIDE))
drag((0, rim), (0, -20))
user.check("KMode/ComboBox", "currentText", "Value")
narrower = 1 / (1 / automatic - 20 * 2 * circle / SIDE)
expect("circle", Cutoff="Bright Field", KScale=float(f"{narrower:.4g}"))
user.menu("menu_Edit", "actionEditUndo")
user.check("KMode/ComboBox", "currentText", "Automatic")

# Real optics: where the edge is, and the width of the source.
user.choose("Cutoff/ComboBox", "Knife Edge")
user.choose("KMode/ComboBox", "Bench")
user.choose("CutoffOffset/DoubleLineEdit0", "0")
user.apply()
settle()
user.check(PLANE, "range", RANGE)
drag((0, 0), tuple(np.rint(25 * along)))
offset = round(K * PIXEL * (np.rint(25 * along) @ along), 3)
expect("optics", Cutoff="Knife Edge", KMode="Bench", KScale=1.02 * K, CutoffOffset=offset)
full = (0.5 + offset) / K
way = np.rint(40 * along)
drag(np.rint(full / PIXEL * along), tuple(way))
rounded = float(f"{K * full / (full + PIXEL * way @ along):.4g}")
expect("source", SourceWidth=float(f"{1e3 * FOCAL_LENGTH / rounded:.4g}"))

user.play(f"""
from paraview.simple import *
from paraview import smtrace
import json
flow = Calculator(Input=Wavelet(WholeExtent=3 * [-8, 8]), ResultArrayName="rho", Function="RTData", registrationName="flow")
flow.UpdatePipeline()
bench = Schlieren(Input=flow, registrationName="bench", KMode="Value", KScale={K}, **{SETTINGS})
Show(bench, GetActiveViewOrCreate("RenderView"))
Render()
SetActiveSource(bench)
log = []
smtrace.start_trace()
def write(*_):
    log.append([bench.CutoffOffset, bench.KnifeEdgeAngle, bench.KScale])
    with open({LOG!r}, "w") as file:
        json.dump(log, file)
    with open({TRACE!r}, "w") as file:
        file.write(smtrace.get_current_trace_output())
bench.SMProxy.AddObserver("UpdateDataEvent", write)
""")


for name, properties in saved.items():
    with open(os.path.join(FOLDER, name + ".json"), encoding="utf-8") as file:
        for key, found in json.load(file).items():
            assert found == properties[key] or np.isclose(found, properties[key], rtol=1e-12), (name, key, found)
    shown = np.load(os.path.join(FOLDER, name + ".npy"))
    assert np.array_equal(shown, image_array(scripted(**properties), "Intensity").ravel()), name
    assert shown.std() > 0.01

# Images were made on the way and where the mouse was released.
with open(LOG, encoding="utf-8") as file:
    made = json.load(file)
assert [on_the_way, 0, K] in made
assert [edge, 60, K] in made and [edge, 60, scaled] in made

# The trace has each drag once.
with open(TRACE, encoding="utf-8") as file:
    lines = [line.split(".", 1)[1] for line in file if line.startswith("bench.")]
assert lines[:3] == [f"CutoffOffset = {edge}\n", "KnifeEdgeAngle = 60.0\n", f"KScale = {scaled}\n"]
