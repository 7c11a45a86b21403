# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""TargetError on real flows: images keep it, say what they reach, and say it where they cannot."""

import os

import numpy as np
from paraview import simple
from plugin_testing import Schlieren, output
from vtkmodules.util.numpy_support import vtk_to_numpy

DATA = os.path.join(os.environ["SCHLIEREN_SOURCE_DIR"], "Testing", "Data")
PIXELS = 64
SETTINGS = {"ImageSize": [PIXELS, PIXELS], "Device": "CPU"}


def fact(image, name):
    return image.GetFieldData().GetAbstractArray(name).GetValue(0)


def intensity(image):
    return vtk_to_numpy(image.GetPointData().GetArray("Intensity")).astype(float)


def check(source, target, **settings):
    """Compares with half the steps and more rays than can be chosen for this target."""
    bench = Schlieren(source, TargetError=target, **SETTINGS, **settings)
    image = output(bench)
    seen, reached = intensity(image), fact(image, "ErrorReached")
    assert fact(image, "TargetError") == target and 0 < reached <= target, reached
    assert fact(image, "ErrorLargest") >= 0.5 * reached and fact(image, "ErrorLimit") != "nothing"
    bench.UpdatePropertyInformation()
    assert "error" in bench.Status and "limited by" in bench.Status, bench.Status
    finer = {"StepSize": 0.5 * fact(image, "StepSize"), "SamplesPerPixel": 4 * fact(image, "SamplesPerPixel")}
    k = fact(image, "KScale")
    bench.TargetError = 0
    bench.MediumTolerance = 5e-4
    for name, value in finer.items():
        setattr(bench, name, value)
    if k > 0:
        bench.KMode, bench.KScale = "Value", k
    image = output(bench)
    assert not image.GetFieldData().GetArray("ErrorReached")
    path = vtk_to_numpy(image.GetPointData().GetArray("OpticalPathDifference"))
    error = np.quantile(np.abs(seen - intensity(image))[path != 0], 0.99)
    print(f"target {target}, reached {reached:.2g}, by finer settings {error:.2g}", finer, flush=True)
    assert error <= target, error
    # A tenth of the target is as good as nothing.
    assert reached > 0.4 * error - 0.1 * target, (reached, error)
    simple.Delete(bench)


jet = simple.XMLImageDataReader(FileName=[os.path.join(DATA, "ladenburg_jet_3d.vti")])
check(jet, 0.02, LengthScale=0.001)
check(jet, 0.004, LengthScale=0.001)
check(jet, 0.004, LengthScale=0.001, ViewDirection=[0.3, -0.4, -1], Cutoff="Bright Field")

# Automatic: the error that cannot be seen. With a limit of time there is an image of one ray per pixel first.
for cutoff, unseen in (("Knife Edge", 0.004), ("Interferogram", 0.02)):
    bench = Schlieren(jet, Quality="Automatic", LengthScale=0.001, Cutoff=cutoff, **SETTINGS)
    whole = output(bench)
    assert fact(whole, "TargetError") == unseen and fact(whole, "ErrorReached") <= unseen
    pieces = Schlieren(jet, Quality="Automatic", LengthScale=0.001, Cutoff=cutoff, TimeLimit=0.002, **SETTINGS)
    seen = []
    for _ in range(5000):
        image = output(pieces)
        seen.append(image.GetFieldData().HasArray("ErrorReached"))
        pieces.UpdatePropertyInformation()
        assert seen[-1] or "error not known yet" in pieces.Status or "Preview" in pieces.Status, pieces.Status
        if pieces.GetProperty("Finished").GetData():
            break
        pieces.InvokeCommand("Refine")
    assert seen[-1] and not all(seen), seen
    assert np.array_equal(intensity(image), intensity(whole))
    simple.Delete(pieces)
    simple.Delete(bench)
fin = simple.PLOT3DReader(FileName=[os.path.join(DATA, "bluntfin_plot3d", "bluntfinxyz.bin")],
                          QFileName=[os.path.join(DATA, "bluntfin_plot3d", "bluntfinq.bin")],
                          FunctionFileName="", Functions=[100])
check(fin, 0.05, Density=["POINTS", "Density"])

# What cannot be kept is said.
bench = Schlieren(jet, TargetError=1e-9, ImageSize=[16, 16])
image = output(bench)
bench.UpdatePropertyInformation()
assert fact(image, "ErrorReached") > 1e-9 and "target error not kept" in bench.Status, bench.Status
