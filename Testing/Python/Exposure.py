# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The exposure of Documentation/time.md, by ParaView's filters: a shock that moves while light falls on the film."""

import numpy as np
from paraview import simple
from plugin_testing import CONSTANT, EVERY_VOXEL, Schlieren, image_array, output
from series_testing import write_series

WIDTH, SPEED, DEPTH = 0.1, 1, 2
STEP, FIRST, LAST = 1 / 16, 4, 12  # between time steps, and the two steps between which the shutter is open
K = 200


def density(x, time):
    """It is at x = 0 at the time 0.5."""
    return 1 + 0.5 * (1 - np.tanh((x - SPEED * (time - 0.5)) / WIDTH))


def truth(x, begin, end):
    """The knife edge's mean over the time: what moves steadily changes in time as it does in space."""
    return 0.5 - K * CONSTANT * DEPTH * (density(x, end) - density(x, begin)) / (SPEED * (end - begin))


def places(image):
    return image.GetOrigin()[0] + np.arange(image.GetDimensions()[0]) * image.GetSpacing()[0]


write_series("shock.pvd", [STEP * i for i in range(17)], 64, lambda x, y, z, time: density(x, time))
flow = simple.PVDReader(FileName="shock.pvd")
flow.UpdatePipeline()

BETWEEN = 4  # images from one time step to the next
steps = simple.ExtractTimeSteps(Input=flow, SelectionMode="Select Time Range", TimeStepRange=[FIRST, LAST])
instants = simple.TemporalInterpolator(Input=steps, DiscreteTimeStepInterval=STEP / BETWEEN)
instants.UpdatePipelineInformation()
bench = Schlieren(Input=instants, Density=["POINTS", "rho"], ImageSize=[96, 8], ParallelScale=0.08, FocalPoint=[0, 0, 0],
                  KMode="Value", KScale=K, **EVERY_VOXEL)
exposed = simple.TemporalStatistics(Input=bench, ComputeMinimum=0, ComputeMaximum=0, ComputeStandardDeviation=0)

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
bench.UpdatePipeline(0.5)
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
