# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Five figures of a lecture on flow visualization, of one jet: Documentation/teaching.md.

    pvpython Examples/lecture.py [FOLDER]        (writes lecture.png into it: a figure in each row)
"""

import os
import sys

from paraview import servermanager
from paraview.simple import *

root = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
sys.path.insert(0, os.path.join(root, "Examples"))
from load_schlieren import load_schlieren  # noqa: E402

load_schlieren(globals())
from schlieren_figure import Sheet, pixels_of  # noqa: E402, which comes with the plugin

KNIFE = {"Cutoff": "Knife Edge", "KMode": "Value", "KScale": 250}
FIGURES = (
    ("1. The knife edge shows one direction", (
        ("upright edge", {**KNIFE, "KnifeEdgeAngle": 0}),
        ("level edge", {**KNIFE, "KnifeEdgeAngle": 90}),
        ("level, the other side", {**KNIFE, "KnifeEdgeAngle": 270}))),
    ("2. Sensitivity: the focal length over the width of the source", (
        ("k = 50", {**KNIFE, "KnifeEdgeAngle": 90, "KScale": 50}),
        ("k = 250", {**KNIFE, "KnifeEdgeAngle": 90}),
        ("k = 1500", {**KNIFE, "KnifeEdgeAngle": 90, "KScale": 1500}))),
    ("3. A shadowgraph is made by distance", (
        ("screen at 20 mm", {"Cutoff": "Shadowgraph", "ScreenDistance": 0.02}),
        ("100 mm", {"Cutoff": "Shadowgraph", "ScreenDistance": 0.1}),
        ("500 mm", {"Cutoff": "Shadowgraph", "ScreenDistance": 0.5}))),
    ("4. Fringes count wavelengths", (
        ("infinite fringes", {"Cutoff": "Interferogram"}),
        ("finite fringes", {"Cutoff": "Interferogram", "FringeSpacing": 0.0008, "FringeAngle": 90}),
        ("finite fringes, upright", {"Cutoff": "Interferogram", "FringeSpacing": 0.0008}))),
    ("5. One flow, three stops", (
        ("bright field", {"Cutoff": "Bright Field"}),
        ("dark field", {"Cutoff": "Dark Field"}),
        ("colour filter", {"Cutoff": "Color Filter"}))))


def main(folder, size=(336, 180)):
    """Writes the sheet; returns the rows of images, rows x columns x 3 bytes each."""
    jet = OpenFOAMReader(FileName=os.path.join(root, "Testing", "Data", "ladenburg_openfoam", "ladenburg.foam"))
    last = jet.TimestepValues[-1]
    jet.UpdatePipeline(last)
    margin, above = 16, 54
    sheet = Sheet(3 * (size[0] + margin) + margin, len(FIGURES) * (size[1] + above) + margin)
    made = []
    for row, (title, images) in enumerate(FIGURES):
        top = above + row * (size[1] + above)
        sheet.text(margin, top - 46, title, 17)
        made.append([])
        for column, (name, settings) in enumerate(images):
            schlieren = Schlieren(Input=jet, FocalPoint=[0.0135, 0, 0], ParallelScale=0.0076,  # noqa: F821
                                  ImageSize=list(size), Quality="Fine", **settings)
            schlieren.UpdatePipeline(last)
            made[-1].append(pixels_of(servermanager.Fetch(schlieren)))
            left = margin + column * (size[0] + margin)
            sheet.text(left, top - 20, name, 13, sheet.DIM)
            sheet.image(left, top, made[-1][-1])
    path = os.path.abspath(os.path.join(folder, "lecture.png"))
    sheet.write(path)
    print("Wrote", path)
    return made


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1 else ".")
