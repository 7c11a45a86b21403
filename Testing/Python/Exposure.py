# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The exposure of Documentation/time.md, by ParaView's filters as the page prints them: a shock that moves while light falls on
the film."""

import os
import re

import numpy as np
from paraview import simple
from plugin_testing import CONSTANT, EVERY_VOXEL, Schlieren, image_array, output
from series_testing import write_series

WIDTH, SPEED, DEPTH = 0.1, 2.5e5, 2
STEP, FIRST, LAST = 1e-7, 10, 30  # between time steps, and the two steps between which the shutter is open
MIDDLE, BETWEEN = 20 * STEP, 2    # of that time; images from one time step to the next
K = 200


def density(x, time):
    """It is at x = 0 in the middle of the time."""
    return 1 + 0.5 * (1 - np.tanh((x - SPEED * (time - MIDDLE)) / WIDTH))


def truth(x, begin, end):
    """The knife edge's mean over the time: what moves steadily changes in time as it does in space."""
    return 0.5 - K * CONSTANT * DEPTH * (density(x, end) - density(x, begin)) / (SPEED * (end - begin))


def places(image):
    return image.GetOrigin()[0] + np.arange(image.GetDimensions()[0]) * image.GetSpacing()[0]


write_series("shock.pvd", [STEP * i for i in range(LAST + 1)], 64, lambda x, y, z, time: density(x, time))
flow = simple.PVDReader(FileName="shock.pvd")
flow.UpdatePipeline()

with open(os.path.join(os.environ["SCHLIEREN_SOURCE_DIR"], "Documentation", "time.md"), encoding="utf-8") as page:
    (snippet,) = re.findall(r"^```python\n(.*?)^```", page.read(), re.DOTALL | re.MULTILINE)
names = {**vars(simple), "Schlieren": Schlieren, "flow": flow}
exec(snippet, names)
instants, bench, exposed = names["instants"], names["schlieren"], names["exposed"]
simple.SetProperties(bench, ImageSize=[96, 8], ParallelScale=0.08, FocalPoint=[0, 0, 0], KMode="Value", KScale=K, **EVERY_VOXEL)
simple.SetProperties(exposed, ComputeMinimum=0, ComputeMaximum=0, ComputeStandardDeviation=0)

light = image_array(exposed, "Intensity_average")[4]
x = places(output(exposed))
half = STEP / BETWEEN / 2  # each image is for the time from half an interval before it to half of one after it
begin, end = FIRST * STEP - half, LAST * STEP + half
assert np.abs(light - truth(x, begin, end)).max() < 5e-3, np.abs(light - truth(x, begin, end)).max()

# The band is as wide as the shock has moved meanwhile.
blurred = np.ptp(x[light < (0.5 + light.min()) / 2])
pixel = x[1] - x[0]
assert abs(blurred - SPEED * (end - begin)) < 1.5 * pixel, blurred
# At an instant it is narrower, and darker.
bench.UpdatePipeline(MIDDLE)
instant = image_array(bench, "Intensity")[4]
assert np.ptp(x[instant < (0.5 + instant.min()) / 2]) < 0.4 * blurred and instant.min() < light.min() - 0.1

# Colours are bytes, of which Temporal Statistics makes no means; the calculator makes them numbers.
bench.Cutoff = "Color Filter"
numbers = simple.Calculator(Input=bench, ResultArrayName="Light", Function="Color / 255")
exposed.Input = numbers
times = list(instants.TimestepValues)
assert len(times) == (LAST - FIRST) * BETWEEN + 1
expected = 0
for time in times:
    bench.UpdatePipeline(time)
    expected = expected + image_array(bench, "Color") / 255 / len(times)
exposed.UpdatePipeline()
assert np.ptp(expected) > 0.1
assert np.abs(image_array(exposed, "Light_average") - expected).max() < 1e-6
