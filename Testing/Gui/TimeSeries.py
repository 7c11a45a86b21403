# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""A flow that changes with time: the view of one click goes with it when the animation is played, stepped and saved,
and has each time the complete image of a script, at one k."""

import json
import os

import numpy as np
from views_testing import FOLDER, ViewsSession, png, simple
from plugin_testing import Schlieren
from series_testing import write_series
from filter_testing import saved
from window_testing import BENCH, PANEL
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
shown = FindView("Schlieren View")
(display,) = displays()
bench = display.SchlierenBench
"""
SETTLE = FIND + """
settle_views()
def save(name):
    image = bench.GetClientSideObject().GetOutputDataObject(0)
    camera = shown.GetActiveCamera()
    np.savez(os.path.join(FOLDER, name), intensity=vtk_to_numpy(image.GetPointData().GetArray("Intensity")),
             dimensions=image.GetDimensions(), direction=camera.GetDirectionOfProjection(), up=camera.GetViewUp(),
             focus=camera.GetFocalPoint(), scale=camera.GetParallelScale(), k=information(bench, "KScaleUsed"))
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


def begin(name, mode="a"):
    """The script that begins a part of the log."""
    return f"with open({LOG!r}, {mode!r}) as file: file.write('= {name}\\n')\n"


write_series(SERIES, TIMES, 25, blob)
user = ViewsSession(BENCH)


def vcr(name):
    user.event("pqClientMainWindow/VCRToolbar/actionVCR" + name, "activate")
    user.idle()


user.press("OneImage")
user.python(SETTLE + NOTE + begin("played", "w") + f"""
# The air around the blob is clear, though not a value is above its density.
volume = GetRepresentation(FindSource("flow"), FindView("RenderView1"))
assert volume.Representation == "Volume"
points = np.reshape(volume.ScalarOpacityFunction.Points, (-1, 4))
assert np.allclose(points[:, :2], [[{AIR} - 0.1, 0.5], [{AIR}, 0]], atol=2e-3), points
""")
vcr("Play")
user.python(SETTLE + "save('played')\n" + begin("stepped"))
user.check_at(PANEL + "/Accept", "enabled", "false")
user.check("KMode/ComboBox", "currentText", "Automatic Kept")
user.python(FIND + f"""
with open({NOTES!r}, "w") as file:
    for text in (widget("propertiesPanel", "Sensitivity", "Note").text(), information(bench, "Status")):
        file.write(text + "\\n")
""")
vcr("FirstFrame")
user.python(SETTLE + "save('first')\n")
vcr("NextFrame")
user.python(SETTLE + "save('next')\n")

# Played and saved from the middle of a refinement.
BEGIN = FIND + """
bench.SamplesPerPixel = 400
scene = FindView("RenderView1")
x, _, z = scene.CameraPosition
scene.CameraPosition = [-x if x else 1 + z / 3, 0.5, z]  # moves each time, as linked views are drawn for that alone
Render(scene)
until(lambda: " of 400 " in information(bench, "Status"))
bench.SamplesPerPixel = 16
"""
user.python(BEGIN + begin("again") + "GetAnimationScene().GoToFirst()")
vcr("Play")
user.python(SETTLE + "save('again')\n" + begin("begun"))
user.python(BEGIN + begin("saved") + f"""
shown.OrientationAxesVisibility = display.SchlierenLegend = 0
SaveAnimation(os.path.join(FOLDER, "saved.png"), shown, FrameWindow=[0, 3], ImageResolution={SIZE})
""" + begin("over") + SETTLE + "save('saved')\n")

user.play(f"""
from paraview.simple import *
flow = OpenDataFile({SERIES!r}, registrationName="flow")
flow.UpdatePipeline()
GetAnimationScene().UpdateAnimationUsingDataTimeSteps()
view = GetActiveViewOrCreate("RenderView")
Show(flow, view)
view.CameraParallelProjection = 1
view.ResetCamera()
SetActiveSource(flow)
""")
flow = simple.PVDReader(FileName=SERIES)
made = {}
SAMPLES = {name: {"SamplesPerPixel": 16} for name in ("again", "saved")}


def scripted(name, time, size=None):
    """The image of a script's filter, with the camera and the k of a kept one, at a time: intensity and optical path."""
    kept = saved(name)
    size = size or [int(pixels) for pixels in kept["dimensions"][:2]]
    key = (time, float(kept["k"]), *size, *kept["direction"], float(kept["scale"]))
    if key not in made:
        flow.UpdatePipeline(time)
        bench = Schlieren(
            Input=flow, Density=["POINTS", "rho"], ImageSize=size, ViewDirection=list(kept["direction"]),
            ViewUp=list(kept["up"]), FocalPoint=list(kept["focus"]), ParallelScale=float(kept["scale"]),
            KMode="Value", KScale=float(kept["k"]), Quality="Automatic", **SAMPLES.get(name, {}))
        bench.UpdatePipeline(time)
        arrays = bench.GetClientSideObject().GetOutputDataObject(0).GetPointData()
        made[key] = [vtk_to_numpy(arrays.GetArray(array)).copy() for array in ("Intensity", "OpticalPathDifference")]
        simple.Delete(bench)
    return made[key]


for name, time in (("played", TIMES[-1]), ("first", TIMES[0]), ("next", TIMES[1]), ("again", TIMES[-1]),
                   ("saved", TIMES[-1])):
    expected, _ = scripted(name, time)
    assert np.ptp(expected) > 0.5
    difference = np.abs(saved(name)["intensity"] - expected)
    # Automatic takes rays and steps of the time before where they keep its target; a script has none.
    assert difference.max() < 1e-5 or (name == "played" and np.percentile(difference, 99) < 1 / 256), (name, time)

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
                    ImageSize=[int(pixels) for pixels in kept["dimensions"][:2]], Quality="Automatic")
    own.UpdatePipeline(time)
    k = own.FieldData["KScale"].GetRange()[0]
    simple.Delete(own)
    # The first image of a view is coarse.
    assert np.isclose(k, kept["k"], rtol=2e-2) == (time == TIMES[0]), (time, k, kept["k"])
assert np.abs(scripted("played", 0)[0] - scripted("played", 0.7)[0]).max() > 0.5

# Each time has been shown, in this order, with all pixels and at one k: those that are saved as a script makes them, those
# that are played with one ray per pixel, at least.
for name in ("played", "again", "saved"):
    with open(LOG, encoding="utf-8") as file:
        part = file.read().split(f"= {name}\n")[1].split("=")[0]
    log = [json.loads(line) for line in part.splitlines()]
    size = SIZE if name == "saved" else [int(pixels) for pixels in saved(name)["dimensions"][:2]]
    assert [row["time"] for row in log] == sorted(row["time"] for row in log), log
    assert {row["rows"] for row in log} == {size[1]} and len({row["k"] for row in log}) == 1, log
    last = {row["time"]: row for row in log}
    assert sorted(last) == TIMES
    for time, row in last.items():
        least = scripted(name, time, size)[1].min()
        assert np.isclose(row["least"], least, rtol=1e-6 if name == "saved" else 5e-3), (name, row, least)
        assert row["finished"] == 1 or name != "saved", (name, row)

# The saved frames are these images, pixel by pixel.
for step, time in enumerate(TIMES):
    frame = png(os.path.join(FOLDER, f"saved.{step:04}.png"))[..., 0] / 255
    intensity = scripted("saved", time, SIZE)[0].reshape(SIZE[::-1])
    difference = np.abs(frame - np.clip(intensity, 0, 1))
    assert difference.max() < 1.5 / 255, (time, difference.max())
