# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""What TargetError costs and whether it is kept, beside the presets, on real flows.

    SCHLIEREN_PLUGIN=…/Schlieren.so Utilities/with-display pvpython Testing/Benchmarks/TargetErrors.py [OUTPUT.csv] [flow…]

For each flow, technique and setting: processor seconds of the first image and of another view of the same medium, the
error that 99 % of the pixels whose light crosses the data do not exceed, the largest one, and what ErrorReached says.
The truth is a cubic spline in steps of half a voxel, with 64 rays per pixel (one, of Background Oriented), voxels for a
tolerance of 0.0003 and bent rays. Takes some minutes.
"""

import csv
import os
import resource
import sys

import ErrorTolerance as cases
import numpy as np
from paraview import simple
from vtkmodules.util.numpy_support import vtk_to_numpy

PIXELS = 192
TRUTH = {"Interpolation": "Cubic", "StepSize": 0.5, "SamplesPerPixel": 64, "HomogeneityTolerance": 0,
         "MediumTolerance": 3e-4, "PathModel": "Refracted"}


def jet(direction):
    reader = simple.XMLImageDataReader(FileName=[os.path.join(cases.DATA, "ladenburg_jet_3d.vti")])
    return reader, {"ViewDirection": direction, "LengthScale": 0.001}


TECHNIQUES = {"Knife Edge": (0.004, 0.001), "Shadowgraph": (0.004,), "Interferogram": (0.02,),
              "Background Oriented": (0.02,)}
FLOWS = {"jet": lambda: jet([0, 0, -1]), "jet aslant": lambda: jet([0.3, -0.4, -1])}
FLOWS.update({name: (lambda case=case: case()[:2]) for name, case in cases.CASES.items()
              if name in ("blunt fin", "shell, hexahedra", "ball, AMR of ratio 2", "shock and wake, far field",
                          "heating coil")})


def processor_seconds(update):
    before = resource.getrusage(resource.RUSAGE_SELF)
    update()
    after = resource.getrusage(resource.RUSAGE_SELF)
    return after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime


def arrays_of(bench):
    image = bench.GetClientSideObject().GetOutputDataObject(0)

    def array(name):
        values = vtk_to_numpy(image.GetPointData().GetArray(name)).astype(float)
        return values.reshape(PIXELS, PIXELS, -1)

    found = {name: array(name) for name in ("Intensity", "OpticalPathDifference", "BlockedFraction")}
    if image.GetPointData().GetArray("BackgroundDisplacement"):
        found["BackgroundDisplacement"] = array("BackgroundDisplacement")
    found["pixel"] = image.GetSpacing()[0]
    fields = image.GetFieldData()
    found["k"] = fields.GetArray("KScale").GetValue(0)
    for name in ("ErrorReached", "StepSize", "SamplesPerPixel"):
        found[name] = fields.GetArray(name).GetValue(0) if fields.GetArray(name) else float("nan")
    return found


def errors(technique, seen, truth, wavelength):
    light = np.abs(seen["Intensity"] - truth["Intensity"])[..., 0]
    if technique == "Background Oriented":
        error = np.linalg.norm(seen["BackgroundDisplacement"] - truth["BackgroundDisplacement"], axis=-1) / seen["pixel"]
    elif technique == "Interferogram":
        path = np.abs(seen["OpticalPathDifference"] - truth["OpticalPathDifference"])[..., 0] / wavelength
        error = np.maximum(light / np.pi, path)
    elif technique == "Shadowgraph":
        image = truth["Intensity"][..., 0]
        slope = np.zeros_like(image)
        for axis in (0, 1):
            step = np.abs(np.diff(image, axis=axis))
            for side in ((0, 1), (1, 0)):
                slope = np.maximum(slope, np.pad(step, [side if n == axis else (0, 0) for n in (0, 1)]))
        error = np.maximum(0, light - 0.05 * slope)
    else:
        error = light
    crossed = (truth["OpticalPathDifference"][..., 0] != 0) & (truth["BlockedFraction"][..., 0] < 1)
    error = error[crossed]
    return np.quantile(error, 0.99), error.max()


def settings_for(technique, source, settings):
    """Ten fringes over the range; a screen and a pattern behind the data."""
    bench = cases.Schlieren(source, ImageSize=[PIXELS, PIXELS], **settings)
    bench.UpdatePipeline()
    path = arrays_of(bench)["OpticalPathDifference"]
    simple.Delete(bench)
    return {"Wavelength": 1e9 * np.ptp(path) / 10} if technique == "Interferogram" else {}


def measure(technique, source, settings, setting, turned):
    bench = cases.Schlieren(source, Cutoff=technique, ImageSize=[PIXELS, PIXELS], **{**settings, **setting})
    first = processor_seconds(bench.UpdatePipeline)
    seen = arrays_of(bench)
    again = float("nan")
    if turned is not None:
        bench.ViewDirection = turned
        again = processor_seconds(bench.UpdatePipeline)
    simple.Delete(bench)
    return first, again, seen


def main():
    out = csv.writer(open(sys.argv[1], "w", newline="", encoding="utf-8") if len(sys.argv) > 1 else sys.stdout)
    out.writerow(["flow", "technique", "setting", "first s", "view s", "p99", "largest", "reached", "step", "rays"])
    for flow in sys.argv[2:] or FLOWS:
        source, settings = FLOWS[flow]()
        source.UpdatePipeline()
        view = np.array(settings.get("ViewDirection", [0, 0, -1]), float)
        turned = list(view + [0.05, 0.03, 0.02])
        for technique, targets in TECHNIQUES.items():
            common = {**settings, **settings_for(technique, source, settings)}
            truth_settings = dict(TRUTH, SamplesPerPixel=1 if technique == "Background Oriented" else 64)
            first, _, truth = measure(technique, source, common, truth_settings, None)
            out.writerow([flow, technique, "truth", f"{first:.2f}", "", "", "", "", "", ""])
            if truth["k"] > 0:
                common.update(AutoKScale=0, KScale=truth["k"])
            trials = {name: {"Quality": name} for name in ("Interactive", "Draft", "Publication")}
            trials.update({f"target {target}": {"TargetError": target} for target in targets})
            for name, setting in trials.items():
                first, again, seen = measure(technique, source, common, setting, turned)
                p99, largest = errors(technique, seen, truth, 1e-9 * common.get("Wavelength", 1))
                out.writerow([flow, technique, name, f"{first:.2f}", f"{again:.2f}", f"{p99:.2g}", f"{largest:.2g}",
                              f"{seen['ErrorReached']:.2g}", seen["StepSize"], seen["SamplesPerPixel"]])
                sys.stdout.flush()
        simple.Delete(source)


main()
