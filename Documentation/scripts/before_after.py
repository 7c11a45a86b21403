# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The pairs of images of Documentation/before_after.md: one property, two values.

    pvpython Documentation/scripts/before_after.py [FOLDER [PROPERTY...]]        (writes pair_*.jpg into it)
"""

import os
import sys

from paraview import servermanager
from paraview.simple import *
from PIL import Image

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path.insert(0, os.path.join(ROOT, "Examples"))
from load_schlieren import load_schlieren  # noqa: E402

load_schlieren(globals())
from schlieren_figure import pixels_of  # noqa: E402, which comes with the plugin

KNIFE = {"Cutoff": "Knife Edge", "KMode": "Value", "KScale": 250, "KnifeEdgeAngle": 90}
SHADOW = {"Cutoff": "Shadowgraph", "ScreenDistance": 0.1}
FRINGES = {"Cutoff": "Interferogram"}
STRIPES = {"Cutoff": "Background Oriented", "BackgroundPattern": "Stripes", "BackgroundPeriod": 0.0008, "FringeAngle": 90}
# The property, its values to the left and to the right, and what else is set.
PAIRS = (
    ("KnifeEdgeAngle", 0, 90, KNIFE),
    ("KScale", 60, 600, KNIFE),
    ("CutoffOffset", 0, 0.3, KNIFE),
    ("SmoothingRadius", 0, 6, {**KNIFE, "KnifeEdgeAngle": 0, "KScale": 1000}),
    ("Cutoff", "Bright Field", "Dark Field", {}),
    ("ScreenDistance", 0.02, 0.3, SHADOW),
    ("LightModel", "Rays", "Waves", {**SHADOW, "ScreenDistance": 0.2, "Wavelength": 532}),
    ("SourceShape", "Point", "Disc", {**SHADOW, "MirrorFocalLength": 1, "SourceWidth": 5, "SamplesPerPixel": 64}),
    ("FringeSpacing", 0, 0.0008, {**FRINGES, "FringeAngle": 90}),
    ("FringeAngle", 0, 45, {**FRINGES, "FringeSpacing": 0.0008}),
    ("Symmetry", "None", "Axisymmetric", {**KNIFE, "KnifeEdgeAngle": 0}),
    ("BackgroundDistance", 0.02, 0.3, STRIPES),
    ("ViewDirection", [0, 0, -1], [0.9, 0, -0.4], KNIFE),
    ("FNumber", 0, 2, {**KNIFE, "KScale": 400, "KnifeEdgeAngle": 0, "ViewAngle": 10, "LensFocalLength": 50,
                       "SamplesPerPixel": 64}),
    ("FocusOffset", 0, 0.1, {**KNIFE, "KnifeEdgeAngle": 0}),
    ("Quality", "Interactive", "Publication", {"Input": "sphere", "Symmetry": "Axisymmetric", "FocalPoint": [0, 0, 0],
                                               "ParallelScale": 0.013}),
    ("Wavelength", 450, 650, FRINGES),
    ("LengthScale", 0.2, 1, FRINGES),
    ("BackgroundPattern", "Stripes", "Dots", {**STRIPES, "BackgroundDistance": 0.1}),
    ("Outside", "Passes", "Auto", {"Input": "fin", "ViewDirection": [0, 1, 0], "ViewUp": [0, 0, 1], "ParallelScale": 3.5,
                                     "FocalPoint": [1.5, 2, 2.8], "LengthScale": 0.0127, "DensityScale": 0.72}))


def flows():
    """The jet, the blunt fin, and a sphere with its bow shock."""
    data = os.path.join(ROOT, "Testing", "Data")
    jet = OpenFOAMReader(FileName=os.path.join(data, "ladenburg_openfoam", "ladenburg.foam"))
    fin = PLOT3DReader(FileName=[os.path.join(data, "bluntfin_plot3d", "bluntfinxyz.bin")],
                       QFileName=[os.path.join(data, "bluntfin_plot3d", "bluntfinq.bin")])
    sphere = OpenDataFile(os.path.join(data, "examples", "bow_shock.vts"))
    jet.UpdatePipeline(jet.TimestepValues[-1])
    fin.UpdatePipeline()
    sphere.UpdatePipeline()
    return {"jet": jet, "fin": fin, "sphere": sphere}


def main(folder, size=(300, 160), chosen=(), quality="Fine"):
    """
    Writes a JPEG of each pair, or of the chosen properties; returns the pairs of images, rows x columns x 3 bytes, by the
    properties' names.
    """
    data, made = flows(), {}
    for name, *values, others in PAIRS:
        if chosen and name not in chosen:
            continue
        sheet = Image.new("RGB", (2 * size[0] + 8, size[1]), "white")
        made[name] = []
        for column, value in enumerate(values):
            flow = data[others.get("Input", "jet")]
            schlieren = Schlieren(**{"Quality": quality, "FocalPoint": [0.0135, 0, 0], "ParallelScale": 0.0076,  # noqa: F821
                                     **others, "Input": flow, "ImageSize": list(size), name: value})
            schlieren.UpdatePipeline(*getattr(flow, 'TimestepValues', [])[-1:])
            made[name].append(pixels_of(servermanager.Fetch(schlieren)))
            sheet.paste(Image.fromarray(made[name][-1][::-1]), (column * (size[0] + 8), 0))
        path = os.path.abspath(os.path.join(folder, f"pair_{name.lower()}.jpg"))
        sheet.save(path, quality=80)
        print("Wrote", path, flush=True)
    return made


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1 else ".", chosen=sys.argv[2:])
