# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""A flow that changes with time: the image of one click goes with it when the animation is played, stepped and saved,
and is each time the whole one of a script, at one k."""

import json
import os

import numpy as np
from views_testing import FOLDER, ViewsSession, filters, load, png, simple, views
from plugin_testing import Schlieren
from series_testing import write_series
from window_testing import PANEL
from follow_testing import saved
from vtkmodules.util.numpy_support import vtk_to_numpy

TIMES = [0, 0.1, 0.3, 0.7]
SIZE = [240, 180]  # of the saved animation
AIR = 1.0  # its refractivity in single precision is a little higher
NOTES = os.path.join(FOLDER, "notes.txt")
SERIES, LOG = os.path.join(FOLDER, "flow.pvd"), os.path.join(FOLDER, "shown.txt")


def blob(x, y, z, time):
    """Warm; moves to the right and grows."""
    square = (x + 0.35 - time)**2 + y**2 + z**2
    return AIR - (0.1 + 0.2 * time) * np.maximum(0, 1 - square / 0.6**2)**2


FIND = """
bench, shown = FindSource("Schlieren1"), FindView("RenderView2")
"""
SETTLE = FIND + """
settle(bench)
"""
# What is shown from here on goes into a log.
NOTE = f"""
import json
def note(*_):
    image = bench.GetClientSideObject().GetOutputDataObject(0)
    path = vtk_to_numpy(image.GetPointData().GetArray("OpticalPathDifference"))
    row = {{"time": shown.ViewTime, "least": float(path.min()), "rows": image.GetDimensions()[1],
           "finished": information(bench, "Finished"), "k": information(bench, "KScaleUsed")}}
    with open({LOG!r}, "a") as file:
        file.write(json.dumps(row) + "\\n")
shown.SMProxy.AddObserver("EndEvent", note)
"""


def begin(name):
    """The script that begins a part of the log."""
    return f"with open({LOG!r}, 'a') as file: file.write('= {name}\\n')\n"


write_series(SERIES, TIMES, 25, blob)
open(LOG, "w", encoding="utf-8").close()
user = ViewsSession()


def vcr(name):
    user.event("pqClientMainWindow/VCRToolbar/actionVCR" + name, "activate")
    user.idle()


user.press("OnePicture")
user.python(SETTLE + NOTE + begin("played"))
vcr("Play")
user.python(SETTLE + "save('played', bench)\n" + begin("stepped"))
user.check_at(PANEL + "/Accept", "enabled", "false")
user.check("LockK/ComboBox", "currentText", "Over Time")
user.python(FIND + f"""
with open({NOTES!r}, "w") as file:
    for text in (widget("propertiesPanel", "Sensitivity", "Note").text(), information(bench, "Status")):
        file.write(text + "\\n")
""")
user.save_state("played.pvsm")
vcr("FirstFrame")
user.python(SETTLE + "save('first', bench)\n")
vcr("NextFrame")
user.python(SETTLE + "save('next', bench)\n")

# Played and saved from the middle of a refinement.
BEGIN = FIND + f"""
bench.ImageSize, bench.SamplesPerPixel = {SIZE}, 400
turned = FindView("RenderView1")
turned.CameraPosition = [1 + turned.CameraPosition[2] / 3, 0.5, turned.CameraPosition[2]]
Render(turned)
until(lambda: not finished(bench), 20)
bench.SamplesPerPixel = 16
"""
user.python(BEGIN + begin("again") + "GetAnimationScene().GoToFirst()")
vcr("Play")
user.python(SETTLE + "save('again', bench)\n" + begin("begun"))
user.python(BEGIN + begin("saved") + f"""
shown.CameraParallelScale = bench.ParallelScale
SaveAnimation(os.path.join(FOLDER, "saved.png"), shown, FrameWindow=[0, 3], ImageResolution={SIZE})
""" + SETTLE + "save('saved', bench)\n")
user.save_state("saved.pvsm")

user.play(f"""
import sys
sys.path.insert(0, {os.path.dirname(os.path.abspath(__file__))!r})
from paraview.simple import *
flow = OpenDataFile({SERIES!r}, registrationName="flow")
flow.UpdatePipeline()
GetAnimationScene().UpdateAnimationUsingDataTimeSteps()
view = GetActiveViewOrCreate("RenderView")
Show(flow, view)
view.ResetCamera()
SetActiveSource(flow)
""")
flow = simple.PVDReader(FileName=SERIES)
made = {}
SAMPLES = {name: {"SamplesPerPixel": 16} for name in ("again", "saved")}


def scripted(name, time):
    """The image of a script, as a kept one is set and at its k, at a time: intensity and optical path."""
    kept = saved(name)
    k = float(kept["k"])
    size = [int(pixels) for pixels in kept["dimensions"][:2]]
    key = (time, k, *size, *kept["direction"], float(kept["scale"]))
    if key not in made:
        flow.UpdatePipeline(time)
        bench = Schlieren(
            Input=flow, Density=["POINTS", "rho"], ImageSize=size, ViewDirection=list(kept["direction"]),
            ViewUp=list(kept["up"]), FocalPoint=list(kept["focus"]), ParallelScale=float(kept["scale"]),
            AutoKScale=0, KScale=k, **SAMPLES.get(name, {}))
        bench.UpdatePipeline(time)
        arrays = bench.GetClientSideObject().GetOutputDataObject(0).GetPointData()
        made[key] = [vtk_to_numpy(arrays.GetArray(name)).copy()
                     for name in ("Intensity", "OpticalPathDifference")]
        simple.Delete(bench)
    return made[key]


for name, time in (("played", TIMES[-1]), ("first", TIMES[0]), ("next", TIMES[1]), ("again", TIMES[-1]),
                   ("saved", TIMES[-1])):
    assert saved(name)["reduction"] == 1 and saved(name)["limit"] == 0
    expected, _ = scripted(name, time)
    assert np.ptp(expected) > 0.5
    assert np.abs(saved(name)["intensity"] - expected).max() < 1e-5, (name, time)

# The panel and the image's line say so.
with open(NOTES, encoding="utf-8") as file:
    sensitivity, status = file.read().splitlines()
locked = f"k locked at {float(saved('played')['k']):.4g}"
assert sensitivity.startswith(locked + ": full scale is ") and status.endswith(", " + locked), (sensitivity, status)

# k is that of the first image, and would be another one at another time.
assert saved("played")["k"] == saved("first")["k"] == saved("next")["k"]
for time in (TIMES[0], TIMES[-1]):
    kept = saved("first")
    flow.UpdatePipeline(time)
    own = Schlieren(Input=flow, Density=["POINTS", "rho"], ViewDirection=list(kept["direction"]),
                    ViewUp=list(kept["up"]), FocalPoint=list(kept["focus"]), ParallelScale=float(kept["scale"]),
                    ImageSize=[int(pixels) for pixels in kept["dimensions"][:2]])
    own.UpdatePipeline(time)
    k = own.FieldData["KScale"].GetRange()[0]
    simple.Delete(own)
    assert np.isclose(k, kept["k"], rtol=1e-9) == (time == TIMES[0]), (time, k, kept["k"])
assert np.abs(scripted("played", 0)[0] - scripted("played", 0.7)[0]).max() > 0.5

# Each time has been shown, in this order, and each time the whole picture of that time.
for name in ("played", "again", "saved"):
    with open(LOG, encoding="utf-8") as file:
        part = file.read().split(f"= {name}\n")[1].split("=")[0]
    log = [json.loads(line) for line in part.splitlines()]
    rows = saved(name)["dimensions"][1]
    assert sorted({row["time"] for row in log}) == TIMES
    assert [row["time"] for row in log] == sorted(row["time"] for row in log), log
    for row in log:
        path = scripted(name, row["time"])[1]
        assert row["finished"] == 1 and row["rows"] == rows, row
        assert np.isclose(row["least"], path.min(), rtol=1e-6), (row, path.min())
    assert len({row["least"] for row in log}) == len(TIMES)
    assert {row["k"] for row in log} == {float(saved(name)["k"])}, log

# The saved frames are these pictures, pixel by pixel; not at the rim, where the view sees half of each.
for step, time in enumerate(TIMES):
    frame = png(os.path.join(FOLDER, f"saved.{step:04}.png"))[..., 0] / 255
    intensity = scripted("saved", time)[0].reshape(SIZE[::-1])
    difference = np.abs(frame - np.clip(intensity, 0, 1))[2:-2, 2:-2]
    assert difference.max() < 1.5 / 255, (time, difference.max())

# A script that loads the state saves the same frames.
load("saved.pvsm")
(bench,) = filters().values()
assert bench.LockK == "Over Time"
(_, flat), = [pair for pair in views() if pair[1].InteractionMode == "2D"]
flat.UseFXAA = 0  # ParaView brings it back with a state
simple.SaveAnimation(os.path.join(FOLDER, "script.png"), flat, FrameWindow=[0, 3], ImageResolution=SIZE)
for step in range(len(TIMES)):
    difference = png(os.path.join(FOLDER, f"script.{step:04}.png")) - png(os.path.join(FOLDER, f"saved.{step:04}.png"))
    assert np.abs(difference)[2:-2, 2:-2].max() <= 1, (step, np.abs(difference).max())

load("played.pvsm")
(_, scene), _ = views()
(bench,) = filters().values()
bench.UpdatePipeline(TIMES[-1])
intensity = bench.GetClientSideObject().GetOutputDataObject(0).GetPointData().GetArray("Intensity")
assert np.abs(vtk_to_numpy(intensity) - saved("played")["intensity"]).max() < 1e-5
# The air around the blob is clear, though not a value is above its density.
volume = simple.GetRepresentation(bench.Input, scene)
assert volume.Representation == "Volume"
points = np.reshape(volume.ScalarOpacityFunction.Points, (-1, 4))
assert np.allclose(points[:, :2], [[AIR - 0.1, 0.5], [AIR, 0]], atol=2e-3), points
