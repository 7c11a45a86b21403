# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""A flow that pulsates: its images have the same k and the same surroundings in whatever order they are made, by a
script, by an animation that is saved and after a state file is loaded; or each its own."""

import math
import os

import numpy as np
from paraview import simple, smstate
from plugin_testing import Schlieren, comes_back, image_array
from series_testing import write_series

TIMES = np.linspace(0, 2, 9).tolist()
SERIES = os.path.abspath("pulse.pvd")


def pulse(x, y, z, time):
    """The gas around it is pressed together and expands, too."""
    wave = math.sin(math.pi * time)
    return 1 + 0.05 * wave + (0.5 + 0.4 * wave) * np.exp(-(x**2 + y**2 + z**2) / 0.09)


def used(bench):
    field = bench.GetClientSideObject().GetOutputDataObject(0).GetFieldData()
    return tuple(field.GetArray(name).GetValue(0) for name in ("KScale", "AmbientRefractivity"))


def at(bench, time):
    bench.UpdatePipeline(time)
    return used(bench)


write_series(SERIES, TIMES, 20, pulse)
flow = simple.PVDReader(FileName=SERIES, registrationName="flow")
flow.UpdatePipeline()
settings = {"Input": flow, "Density": ["POINTS", "rho"], "ImageSize": [32, 24], "ParallelScale": 0.6}
own = {time: at(Schlieren(**settings), time) for time in TIMES}
assert len({round(k, 3) for k, _ in own.values()}) > 4 and len({round(n, 9) for _, n in own.values()}) > 4, own

# Of each time, in whatever order.
bench = Schlieren(**settings)
for time in [0.5, 1.5, 0.5, 0] + TIMES:
    bench.InvokeCommand("FitKAgain")
    assert np.isclose(at(bench, time)[0], own[time][0], rtol=1e-3), time  # the surroundings are those of 0.5

# Fixed by default: that of the first image, forwards, backwards and anyhow.
bench = Schlieren(registrationName="bench", **settings)
fixed = at(bench, 0.5)
assert fixed == own[0.5]
images = {}
for time in TIMES + TIMES[::-1] + [1.5, 0.25, 1.75, 0.5]:
    assert at(bench, time) == fixed, time
    image = image_array(bench, "Intensity").copy()
    assert np.array_equal(images.setdefault(time, image), image), time

at(bench, 1.5)
assert (bench.LockedK, bench.LockedAmbient) == fixed

# Fringes count what the gas around has become, in units of light at the first time.
bench.Cutoff = "Interferogram"
assert at(bench, 1.5)[1] == fixed[1]
path = image_array(bench, "OpticalPathDifference")[0, 0]
assert abs(path / (2 * (own[1.5][1] - own[0.5][1])) - 1) < 0.01, path
bench.Cutoff = "Knife Edge"
bench.LockedAmbient = fixed[1]
bench.LockedK = fixed[0]

# Fitted to all of it: that of the strongest image, wherever it is, and none has another one.
made = []
note = bench.GetClientSideObject().AddObserver("EndEvent", lambda *_: made.append(used(bench)[0]))
progress = []
seen = bench.GetClientSideObject().AddObserver(
    "ProgressEvent", lambda filter, _: progress.append(filter.GetProgress()))
bench.InvokeCommand("FitKOverSeries")
bench.GetClientSideObject().RemoveObserver(note)
bench.GetClientSideObject().RemoveObserver(seen)
assert len(made) == len(TIMES) and min(np.diff(progress)) > -1e-9 and progress[0] < 0.1 and progress[-1] > 0.99, progress
strongest = at(bench, 1.5)[0]
assert strongest == min(made) and np.isclose(strongest, min(k for k, _ in own.values()), rtol=1e-3), (strongest, own)
assert {at(bench, time)[0] for time in TIMES} == {strongest} and bench.LockedK == strongest
assert (bench.KMode, bench.SamplesPerPixel) == ("Automatic", Schlieren(**settings).SamplesPerPixel)

# Stopped in the middle, it changes nothing.
bench.LockedK = fixed[0]
at(bench, 0.5)
stop = bench.GetClientSideObject().AddObserver(
    "ProgressEvent", lambda filter, _: filter.GetProgress() > 0.5 and filter.SetAbortExecute(1))
bench.InvokeCommand("FitKOverSeries")
bench.GetClientSideObject().RemoveObserver(stop)
assert at(bench, 0.5)[0] == fixed[0]
assert at(bench, 1.5) == fixed

# An animation makes its frames in the order of time; the one that was shown before does not matter.
view = simple.CreateRenderView(ViewSize=[160, 120])
simple.Show(bench, view)
scene = simple.GetAnimationScene()
scene.UpdateAnimationUsingDataTimeSteps()
scene.AnimationTime = 1.5
simple.Render(view)
made = []
note = bench.GetClientSideObject().AddObserver("EndEvent", lambda *_: made.append((view.ViewTime, used(bench))))
simple.SaveAnimation("pulse.png", view)
bench.GetClientSideObject().RemoveObserver(note)
assert [time for time, _ in made] == TIMES, made
assert {values for _, values in made} == {fixed}, made

# State files of both kinds hold them.
scene.AnimationTime = 1.5
at(bench, 1.5)
kept = image_array(bench, "Intensity").copy()
assert (bench.LockedK, bench.LockedAmbient) == fixed
simple.SaveState("pulse.pvsm")
script = smstate.get_state()
simple.Delete(view)
del view, scene


def check_kept():
    found = simple.FindSource("bench")
    assert (found.LockedK, found.LockedAmbient) == fixed
    assert at(found, 1.5) == fixed
    assert np.array_equal(image_array(found, "Intensity"), kept)
    assert at(found, 0) == fixed
    for loaded in simple.GetViews():
        simple.Delete(loaded)


comes_back("pulse.pvsm", script, check_kept)

# The depth of a plane is that of its first image, though the flow in it grows; others have their own.
write_series(os.path.abspath("bump.pvd"), TIMES, 41, lambda x, y, z, time: 1 + np.exp(-(x**2 + y**2) / (0.01 * 4**time)))
bump = simple.PVDReader(FileName=os.path.abspath("bump.pvd"))
plane = simple.Slice(Input=bump, SliceType="Plane")
plane.SliceType.Normal = [0, 0, 1]
plane.UpdatePipeline(0)


def path_at(bench, time):
    bench.UpdatePipeline(time)
    return image_array(bench, "OpticalPathDifference").max()


settings = {"Input": plane, "Density": ["POINTS", "rho"], "ImageSize": [33, 33], "AmbientRefractivity": 2.26e-4}
own = {time: path_at(Schlieren(**settings), time) for time in (0, 2)}
assert own[2] > 1.9 * own[0], own
bench = Schlieren(**settings)
for time in (0, 2, 1, 0, 2):
    assert 0.95 < path_at(bench, time) / own[0] < 1.05, (time, own)
depth = bench.LockedDepth
assert depth > 0
again = Schlieren(LockedDepth=depth, **settings)  # as a state has it
assert path_at(again, 2) == path_at(bench, 2)
again.LockedDepth = 0
assert path_at(again, 2) == own[2]
