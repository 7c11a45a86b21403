# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Time-sliced images, as a window requests them through proxies: the jet, and what is reported of it."""

import os

import numpy as np
from paraview import simple
from plugin_testing import Schlieren, image_array

jet = simple.OpenDataFile(
    os.path.join(os.environ["SCHLIEREN_SOURCE_DIR"], "Testing", "Data", "ladenburg_jet_3d.vti"))
jet.UpdatePipeline()
SETTINGS = {"Density": ["POINTS", "rho"], "ImageSize": [96, 64], "Quality": "Draft", "SamplesPerPixel": 3,
            "ViewDirection": [-0.4, -0.2, -1], "NumberOfThreads": 1}


def value(name):
    bench.UpdatePropertyInformation()
    return bench.GetProperty(name).GetData()


whole = Schlieren(Input=jet, **SETTINGS)
expected = image_array(whole, "Intensity")
assert np.ptp(expected) > 0.5, np.ptp(expected)

bench = Schlieren(Input=jet, **SETTINGS)
bench.TimeLimit = 1e-9
bench.UpdatePipeline()
assert value("Finished") == 0 and value("PictureCount") == 1, value("PictureCount")
rough = image_array(bench, "Intensity")  # something is there from the beginning, of the size that was promised
assert rough.shape == expected.shape and np.ptp(rough) > 0.2

slices, counts = 1, {1}
while not value("Finished"):
    bench.InvokeCommand("Refine")
    bench.UpdatePipeline()
    counts.add(value("PictureCount"))
    slices += 1
    assert slices < 10000
assert slices > 10 and counts == {1, 2, 3, 4}, (slices, counts)
assert np.array_equal(image_array(bench, "Intensity"), expected)
assert value("Status").startswith("3 samples per pixel, "), value("Status")
assert value("MediumBuilds") == 0  # it is that of whole

# Neither a limit nor Refine makes a finished image anew.
bench.TimeLimit = 0
bench.InvokeCommand("Refine")
bench.UpdatePipeline()
assert value("PictureCount") == 4

# A preview, and then the whole image again without tracing all of it in between.
bench.PreviewReduction = 4
assert image_array(bench, "Intensity").shape == (16, 24)
bench.PreviewReduction = 1
bench.TimeLimit = 1e-9
assert image_array(bench, "Intensity").shape == (64, 96)
assert value("Finished") == 0
bench.TimeLimit = 0
bench.InvokeCommand("Refine")
assert np.array_equal(image_array(bench, "Intensity"), expected)
assert value("Finished") == 1
