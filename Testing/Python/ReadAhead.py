# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Series of files whose next step is read while the image of this one is traced: by a script, and by an animation that is
saved, in which the flow is seen beside its schlieren image."""

import os

import numpy as np
from paraview import simple
from plugin_testing import Schlieren, image_array
from series_testing import write_series

TIMES = np.linspace(0, 2, 9).tolist()
SERIES = os.path.abspath("ahead.pvd")


def blob(x, y, z, time):
    return 1 + np.exp(-((x - time + 1)**2 + y**2 + z**2) / 0.09)


write_series(SERIES, TIMES, 20, blob)
FILES = [SERIES.replace(".pvd", f"{step}.vti") for step in range(len(TIMES))]
SETTINGS = {"Density": ["POINTS", "rho"], "ImageSize": [32, 24], "ParallelScale": 0.6, "AutoKScale": 0, "KScale": 500}
reads = []


def count_reads(reader):
    reader.GetClientSideObject().AddObserver("StartEvent", lambda *_: reads.append(1))


def images(bench, times):
    found = []
    for time in times:
        bench.UpdatePipeline(time)
        found.append(image_array(bench, "Intensity").copy())
    return found


for make, times in ((lambda: simple.PVDReader(FileName=SERIES), TIMES),
                    (lambda: simple.XMLImageDataReader(FileName=FILES), list(range(len(TIMES))))):
    plain = images(Schlieren(Input=make(), **SETTINGS), times)
    source = make()
    count_reads(source)
    bench = Schlieren(Input=source, ReadAheadMemory=64, **SETTINGS)
    reads.clear()
    assert np.array_equal(images(bench, times), plain)
    assert len(reads) == len(times), len(reads)
    assert np.array_equal(images(bench, times[::-1]), plain[::-1])
    assert len(reads) == 2 * len(times) - 1, len(reads)  # the last step is there already

# Saved beside a view of the flow itself.
simple.ResetSession()
flow = simple.PVDReader(FileName=SERIES)
count_reads(flow)
bench = Schlieren(Input=flow, ReadAheadMemory=64, **SETTINGS)
view = simple.CreateRenderView(ViewSize=[160, 120])
simple.Show(flow, view).SetRepresentationType("Outline")
simple.Show(bench, view)
scene = simple.GetAnimationScene()
scene.UpdateAnimationUsingDataTimeSteps()
made = []
bench.GetClientSideObject().AddObserver(
    "EndEvent", lambda *_: made.append((view.ViewTime, image_array(bench, "Intensity").copy())))
reads.clear()
simple.SaveAnimation("ahead.png", view)
plain = dict(zip(TIMES, images(Schlieren(Input=simple.PVDReader(FileName=SERIES), **SETTINGS), TIMES)))
print("read", len(reads), "times for", [time for time, _ in made])
assert {time for time, _ in made} >= set(TIMES[1:])
assert all(np.array_equal(image, plain[time]) for time, image in made)
assert len(reads) < len(TIMES), len(reads)
