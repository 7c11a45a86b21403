# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Speed against accuracy: presets, single settings and target errors on real flows.

    Testing/Benchmarks/tradeoff OUTPUT [flow…]

For each flow, technique and setting: processor seconds of the first image and of other views of the same medium (the
least of three), the error that 99 % of the pixels whose light crosses the data do not exceed, the largest one, and what
ErrorReached says. OUTPUT.csv has the figures. OUTPUT.png has a chart of each flow and technique: that error over the
seconds of another view, with a line through the settings that no other one beats in both.
The truth is a cubic spline in steps of half a voxel, with 64 rays per pixel (one, of Background Oriented), voxels for a
tolerance of 0.0003 and bent rays.
"""

import csv
import resource
import sys

import FlowCases as cases
import numpy as np
from paraview import simple
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkChartsCore import vtkAxis, vtkChartXY, vtkPlotPoints
from vtkmodules.vtkCommonColor import vtkNamedColors
from vtkmodules.vtkCommonDataModel import vtkRectf, vtkTable
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkRenderingCore import vtkWindowToImageFilter
from vtkmodules.vtkViewsContext2D import vtkContextView

PIXELS = 192
TRUTH = {"StepSize": 0.5, "SamplesPerPixel": 64, "MediumTolerance": 3e-4}


# Target errors, from coarse to fine; the middle one cannot be seen.
TECHNIQUES = {"Knife Edge": (0.02, 0.004, 0.001), "Shadowgraph": (0.02, 0.004, 0.001),
              "Interferogram": (0.1, 0.02, 0.005), "Background Oriented": (0.1, 0.02, 0.005)}
UNITS = {"Knife Edge": "full scale", "Shadowgraph": "undisturbed light", "Interferogram": "fringes",
         "Background Oriented": "pixels"}
FLOWS = ("jet", "jet aslant", "blunt fin", "ball, AMR of ratio 2")
COMMON = {"MediumTolerance": 0.003}
SETTINGS = {"Interactive": {"Quality": "Interactive"}, "Fine": {"Quality": "Fine"},
            "Publication": {"Quality": "Publication"},
            **{f"{kind}, step {step}, {rays} rays": dict(COMMON, StepSize=step, SamplesPerPixel=rays)
               for kind, step in (("quadratic", 2), ("cubic", 1)) for rays in (1, 4, 16)}}


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
    """Ten fringes over the range; a screen and a pattern one depth behind the data."""
    bench = cases.Schlieren(source, ImageSize=[PIXELS, PIXELS], **settings)
    bench.UpdatePipeline()
    path = arrays_of(bench)["OpticalPathDifference"]
    direction, bounds = np.abs(bench.ViewDirection), source.GetDataInformation().GetBounds()
    depth = float(direction @ np.subtract(bounds[1::2], bounds[::2]) / np.linalg.norm(direction))
    simple.Delete(bench)
    return {"Interferogram": {"Wavelength": 1e9 * np.ptp(path) / 10},
            "Shadowgraph": {"ScreenDistance": depth}}.get(technique, {})


def measure(technique, source, settings, setting, views=()):
    bench = cases.Schlieren(source, Cutoff=technique, ImageSize=[PIXELS, PIXELS], **{**settings, **setting})
    first = processor_seconds(bench.UpdatePipeline)
    seen = arrays_of(bench)
    again = []
    for view in views:
        bench.ViewDirection = view
        again.append(processor_seconds(bench.UpdatePipeline))
    simple.Delete(bench)
    return first, min(again, default=float("nan")), seen


def truth_of(flow, technique, rays=64):
    """The flow, its settings with the k of the truth, and the truth."""
    source, settings = cases.CASES[flow]()
    source.UpdatePipeline()
    common = {**settings, **settings_for(technique, source, settings)}
    rays = 1 if technique == "Background Oriented" else rays
    _, _, truth = measure(technique, source, common, dict(TRUTH, SamplesPerPixel=rays))
    if truth["k"] > 0:
        common.update(KMode="Value", KScale=truth["k"])
    return source, common, truth


def measure_flow(flow, technique):
    """Rows of the table."""
    source, common, truth = truth_of(flow, technique)
    view = np.array(common.get("ViewDirection", [0, 0, -1]), float)
    views = [list(view + n * np.array([0.05, 0.03, 0.02])) for n in (1, 2, 3)]
    trials = {**SETTINGS, **{f"target {target}": {"TargetError": target} for target in TECHNIQUES[technique]}}
    for setting, values in trials.items():
        first, again, seen = measure(technique, source, common, values, views)
        p99, largest = errors(technique, seen, truth, 1e-9 * common.get("Wavelength", 1))
        yield {"flow": flow, "technique": technique, "setting": setting, "first s": first, "view s": again,
               "p99": p99, "largest": largest, "reached": seen["ErrorReached"], "step": seen["StepSize"],
               "rays": seen["SamplesPerPixel"]}
    simple.Delete(source)


def is_on_front(row, rows):
    return not any(other["view s"] <= row["view s"] and other["p99"] <= row["p99"] and other is not row for other in rows)


def add_points(chart, rows, color, marker, is_line, label):
    table = vtkTable()
    for name in ("view s", "p99"):
        column = numpy_to_vtk(np.array([max(row[name], 1e-9) for row in rows]), deep=True)
        column.SetName(name if name != "p99" else label)
        table.AddColumn(column)
    plot = chart.AddPlot(vtkChartXY.LINE if is_line else vtkChartXY.POINTS)
    plot.SetInputData(table, 0, 1)
    plot.SetColor(*vtkNamedColors().GetColor3ub(color), 255)
    plot.SetWidth(1.5)
    plot.SetMarkerStyle(marker)
    plot.SetMarkerSize(9)


def draw(rows, path):
    """A chart of each flow (columns) and technique (rows)."""
    flows = list(dict.fromkeys(row["flow"] for row in rows))
    width, height, top = 360, 300, 24
    view = vtkContextView()
    view.GetRenderWindow().SetOffScreenRendering(1)
    view.GetRenderWindow().SetSize(width * len(flows), height * len(TECHNIQUES) + top)
    for column, flow in enumerate(flows):
        for line, technique in enumerate(TECHNIQUES):
            here = [row for row in rows if (row["flow"], row["technique"]) == (flow, technique)]
            chart = vtkChartXY()
            chart.SetAutoSize(False)
            chart.SetSize(vtkRectf(width * column, height * (len(TECHNIQUES) - 1 - line), width, height))
            chart.SetTitle(f"{technique}: {flow}")
            for axis, title in ((vtkAxis.BOTTOM, "processor s"), (vtkAxis.LEFT, f"error, {UNITS[technique]}")):
                chart.GetAxis(axis).SetTitle(title)
                chart.GetAxis(axis).SetLogScale(True)
            front = sorted((row for row in here if is_on_front(row, here)), key=lambda row: row["view s"])
            add_points(chart, front, "silver", vtkPlotPoints.NONE, True, "front")
            groups = {"presets": ("firebrick", vtkPlotPoints.DIAMOND, lambda name: name in list(SETTINGS)[:3]),
                      "settings": ("gray", vtkPlotPoints.SQUARE, lambda name: name in list(SETTINGS)[3:]),
                      "target errors": ("royal_blue", vtkPlotPoints.CIRCLE, lambda name: name.startswith("target"))}
            for label, (color, marker, belongs) in groups.items():
                add_points(chart, [row for row in here if belongs(row["setting"])], color, marker, False, label)
            chart.SetShowLegend(column == line == 0)
            view.GetScene().AddItem(chart)
    view.GetRenderWindow().Render()
    grab, writer = vtkWindowToImageFilter(), vtkPNGWriter()
    grab.SetInput(view.GetRenderWindow())
    writer.SetFileName(path)
    writer.SetInputConnection(grab.GetOutputPort())
    writer.Write()


def main():
    rows = []
    with open(sys.argv[1] + ".csv", "w", newline="", encoding="utf-8") as file:
        out = None
        for flow in sys.argv[2:] or FLOWS:
            for row in (row for technique in TECHNIQUES for row in measure_flow(flow, technique)):
                out = out or csv.DictWriter(file, row)
                if not rows:
                    out.writeheader()
                rows.append(row)
                out.writerow({name: f"{value:.2g}" if isinstance(value, float) else value for name, value in row.items()})
                file.flush()
    draw(rows, sys.argv[1] + ".png")


if __name__ == "__main__":
    main()
