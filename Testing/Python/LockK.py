# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The automatic k over a series: kept while the time changes, kept by state files of both kinds, and let go by
those who do not want it."""

import os

import numpy as np
from paraview import simple, smstate
from plugin_testing import Schlieren, output, image_array
from series_testing import write_series

TIMES = [0, 1, 2]
SERIES = os.path.abspath("series.pvd")


def column(x, _, z, time):
    """1, 2 and 3 times as strong."""
    return 1 + (1 + time) * np.exp(-(x**2 + z**2) / 0.09)


def k_at(bench, time):
    bench.UpdatePipeline(time)
    bench.UpdatePropertyInformation()
    return bench.GetProperty("KScaleUsed").GetData()


write_series(SERIES, TIMES, 16, column)
flow = simple.PVDReader(FileName=SERIES, registrationName="flow")
flow.UpdatePipeline()
settings = {"Input": flow, "Density": ["POINTS", "rho"], "ImageSize": [24, 24], "LockAmbient": 0}
own = [k_at(Schlieren(LockK="Off", **settings), time) for time in TIMES]
assert np.allclose(own, own[0] / np.array([1, 2, 3]), rtol=1e-2), own

# By default, and until someone says that each image is to have its own.
bench = Schlieren(registrationName="bench", **settings)
assert bench.LockK == "Over Time" and bench.LockedK == 0
for time, locked in ((1, 0), (2, own[1]), (0, own[1]), (2, own[1])):
    assert k_at(bench, time) == own[1], time
    assert bench.LockedK == locked, (time, bench.LockedK)
words = bench.GetProperty("Sensitivity").GetData(), bench.GetProperty("Status").GetData()
assert words[0].startswith(f"k locked at {own[1]:.4g}: full scale is ") and words[1].endswith(
    f", k locked at {own[1]:.4g}"), words
kept = image_array(bench, "Intensity")

# State files keep it: the same image, and the same k at other times.
simple.SaveState("locked.pvsm")
script = smstate.get_state()


def check_kept():
    found = simple.FindSource("bench")
    assert found.LockK == "Over Time" and found.LockedK == own[1], found.LockedK
    assert k_at(found, 2) == own[1]
    assert np.array_equal(image_array(found, "Intensity"), kept)
    assert k_at(found, 0) == own[1]
    # So does another camera, until each image is to have its own.
    found.ViewDirection = [1, 0, -1]
    assert k_at(found, 0) == own[1]
    found.LockK = "Off"
    assert k_at(found, 2) not in own
    found.ViewDirection = [0, 0, -1]
    assert k_at(found, 2) == own[2] and found.LockedK == 0


check_kept()
simple.ResetSession()
simple.LoadState(os.path.abspath("locked.pvsm"))
check_kept()
simple.ResetSession()
exec(script, {})  # pylint: disable=exec-used
check_kept()

# A flow without times: as ever, whatever is changed, and nothing for state files to keep.
simple.ResetSession()
flow = simple.XMLImageDataReader(FileName=[os.path.abspath("series0.vti")])
settings["Input"] = flow
bench, fresh = Schlieren(**settings), Schlieren(LockK="Off", **settings)
for change in ({}, {"ParallelScale": 0.5}, {"Quality": "Publication"}, {"DensityScale": 2.0},
               {"Cutoff": "Circular"}, {"KnifeEdgeAngle": 30.0}):
    for one in (bench, fresh):
        simple.SetProperties(one, **change)
    assert np.array_equal(image_array(bench, "Intensity"), image_array(fresh, "Intensity")), change
    assert bench.LockedK == 0
bench.LockK = "Always"
k = output(bench).GetFieldData().GetArray("KScale").GetValue(0)
bench.ParallelScale = 0.2
assert output(bench).GetFieldData().GetArray("KScale").GetValue(0) == k == bench.LockedK
