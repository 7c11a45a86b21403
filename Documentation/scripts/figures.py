# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Images of pages that no example makes: a function for each, named as its file.

    Utilities/with-display pvpython Documentation/scripts/figures.py [FOLDER [NAME...]]
"""

import functools
import inspect
import math
import os
import sys

import numpy as np
from matplotlib import colormaps
from paraview import servermanager
from paraview.simple import *
from PIL import Image

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path.insert(0, os.path.join(ROOT, "Examples"))
from load_schlieren import load_schlieren  # noqa: E402

load_schlieren(globals())
import schlieren_figure  # noqa: E402, which comes with the plugin
from schlieren_figure import Sheet, grey, pixels_of, rows_of  # noqa: E402

DATA = os.path.join(ROOT, "Testing", "Data")
JET = {"FocalPoint": [0.0148, 0, 0], "ParallelScale": 0.0076}  # without the end of the data, where light diffracts


@functools.cache
def jet():
    flow = OpenDataFile(os.path.join(DATA, "ladenburg_jet_3d.vti"))
    flow.UpdatePipeline()
    return flow


def image(**settings):
    """An image of the jet, with all of its arrays."""
    bench = Schlieren(**{"Input": jet(), "Quality": "Fine", **JET, **settings})  # noqa: F821
    bench.UpdatePipeline()
    return servermanager.Fetch(bench)


def sheet_of(tiles, columns=2):
    """A sheet of images of one size, with a title above each: pairs of title and rows x columns x 3 bytes."""
    rows, width = tiles[0][1].shape[:2]
    sheet = Sheet(columns * (width + 8) - 8, math.ceil(len(tiles) / columns) * (rows + 24))
    for place, (title, pixels) in enumerate(tiles):
        left, top = place % columns * (width + 8), place // columns * (rows + 24)
        sheet.text(left, top + 4, title, 13)
        sheet.image(left, top + 22, pixels)
    return sheet.drawn()


def waves(size=(520, 290)):
    screens = [(model, distance) for distance in (0.02, 0.2) for model in ("Rays", "Waves")]
    return sheet_of([(f"{model}, screen at {distance} m", pixels_of(image(
        Cutoff="Shadowgraph", ScreenDistance=distance, LightModel=model, Wavelength=532, ImageSize=size)))
        for model, distance in screens])


def waves_in_focus(size=(480, 268)):
    """White is four times and twice the light without flow."""
    plates = (("Phase contrast, a quarter of a wave", 4, {}),
              ("A stop of 0.5 mm", 2, {"PhasePlateDiameter": 0.5, "MirrorFocalLength": 1, "PhasePlateTransmission": 0}))
    return sheet_of([(title, grey(rows_of(image(Cutoff="Phase Contrast", Wavelength=532, ImageSize=size, **plate),
                                          "Intensity"), white)) for title, white, plate in plates])


def camera(size=(376, 210)):
    """The dots that a camera sees 0.3 m before the jet, and by how much they are displaced."""
    seen, shifts = [], []
    for title, number in (("A pinhole", 0), ("f/4", 4)):
        made = image(Cutoff="Background Oriented", BackgroundDistance=0.04, BackgroundPeriod=0.00045, ImageSize=size,
                     ViewAngle=2 * math.degrees(math.atan(JET["ParallelScale"] / 0.3)), FNumber=number, LensFocalLength=50,
                     SamplesPerPixel=144 if number else 4)
        seen.append((title, pixels_of(made)))
        shift = np.linalg.norm(rows_of(made, "BackgroundDisplacement"), axis=2)
        largest = np.percentile(shift, 99) if not shifts else largest
        shifts.append((f"{title}: displacement, yellow is {1e3 * largest:.2f} mm",
                       (255 * colormaps["viridis"](shift / largest)[..., :3]).astype(np.uint8)))
    return sheet_of(seen + shifts)


def legend(size=(420, 300)):
    """Six images with their legends."""
    benches = ({"Cutoff": "Knife Edge", "KnifeEdgeAngle": 90}, {"Cutoff": "Shadowgraph"}, {"Cutoff": "Interferogram"},
               {"Cutoff": "Bright Field"}, {"Cutoff": "Color Filter"}, {"Cutoff": "Interferogram", "FringeSpacing": 0.0008})
    view = CreateView("RenderView", ViewSize=size, OrientationAxesVisibility=0, CameraParallelProjection=1,
                      CameraParallelScale=0.0115, CameraFocalPoint=[0.016, 0, 0], CameraPosition=[0.016, 0, 0.1])
    flow, rows = jet(), []
    for bench in benches:
        display = Show(flow, view)
        display.SetRepresentationType("Schlieren")
        SetProperties(display.SchlierenBench, Quality="Fine", SmoothingRadius=2, **bench)
        rows.append(screenshot(view))
        Delete(display)
    Delete(view)
    return np.vstack([np.hstack(rows[:3]), np.hstack(rows[3:])])


def screenshot(view):
    """What a view shows, rows x columns x 3 bytes, the uppermost row first."""
    SaveScreenshot("seen.png", view, ImageResolution=list(view.ViewSize))
    with Image.open("seen.png") as seen:
        pixels = np.array(seen.convert("RGB"))
    os.remove("seen.png")
    return pixels


def representation(size=(640, 420)):
    """A blunt fin and the plate that it stands on, as surfaces before the image of the flow."""
    folder = os.path.join(DATA, "bluntfin_plot3d")
    flow = PLOT3DReader(FileName=[os.path.join(folder, "bluntfinxyz.bin")], QFileName=[os.path.join(folder, "bluntfinq.bin")])
    flow.UpdatePipeline()
    view = CreateView("RenderView", ViewSize=size, CameraPosition=[-2, -24, 5.5], CameraFocalPoint=[1.3, 0, 2.5],
                      CameraViewUp=[0, 0, 1], CameraParallelProjection=1, CameraParallelScale=4)
    display = Show(flow, view)
    display.SetRepresentationType("Schlieren")
    SetProperties(display.SchlierenBench, Quality="Fine", DensityScale=0.72, LengthScale=0.0127)
    display.SchlierenLegend = 0
    for extent, color, opacity in (((0, 39, 0, 0, 0, 31), [0.8, 0.5, 0.2], 1), ((0, 39, 0, 31, 0, 0), [0.3, 0.5, 0.7], 0.4)):
        wall = Show(ExtractSubset(Input=flow, VOI=extent), view)
        ColorBy(wall, None)
        SetProperties(wall, Representation="Surface", AmbientColor=color, DiffuseColor=color, Opacity=opacity)
    pixels = screenshot(view)
    Delete(view)
    return pixels


def figure(size=(720, 384)):
    """What schlieren_figure.save() writes."""
    bench = Schlieren(Input=jet(), KnifeEdgeAngle=90, Quality="Publication", ImageSize=size)  # noqa: F821
    schlieren_figure.save("figure.png", bench, title="Under-expanded air jet")
    with Image.open("figure.png") as page:
        return np.array(page.convert("RGB"))


def main(folder, *names):
    for name, make in list(globals().items()):
        if inspect.isfunction(make) and make.__module__ == __name__ and "size" in inspect.signature(make).parameters \
                and (not names or name in names):
            ending = "png" if name in ("figure", "representation") else "jpg"
            path = os.path.abspath(os.path.join(folder, f"{name}.{ending}"))
            Image.fromarray(make()).save(path, quality=85, optimize=True)
            print("Wrote", path, flush=True)


if __name__ == "__main__":
    main(*(sys.argv[1:] or ["."]))
