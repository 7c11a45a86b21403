# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The legends of Documentation/representation.md: six images of a jet.

    pvpython Documentation/scripts/legends.py [FOLDER]        (writes legend.jpg into it)
"""

import os
import sys

from paraview.simple import *
from PIL import Image

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path.insert(0, os.path.join(ROOT, "Examples"))
from load_schlieren import load_schlieren  # noqa: E402

load_schlieren(globals())
SIZE = (420, 300)
BENCHES = ({"Cutoff": "Knife Edge", "KnifeEdgeAngle": 90}, {"Cutoff": "Shadowgraph"}, {"Cutoff": "Interferogram"},
           {"Cutoff": "Bright Field"}, {"Cutoff": "Color Filter"}, {"Cutoff": "Interferogram", "FringeSpacing": 0.0008})

folder = sys.argv[1] if len(sys.argv) > 1 else "."
jet = OpenDataFile(os.path.join(ROOT, "Testing", "Data", "ladenburg_jet_3d.vti"))
jet.UpdatePipeline()
view = CreateView("RenderView", ViewSize=SIZE, OrientationAxesVisibility=0, CameraParallelProjection=1, CameraParallelScale=0.0115)
view.CameraFocalPoint, view.CameraPosition = [0.016, 0, 0], [0.016, 0, 0.1]
sheet = Image.new("RGB", (3 * SIZE[0], 2 * SIZE[1]))
for place, bench in enumerate(BENCHES):
    display = Show(jet, view)
    display.SetRepresentationType("Schlieren")
    for name, value in {"Quality": "Fine", "SmoothingRadius": 2, **bench}.items():
        setattr(display.SchlierenBench, name, value)
    SaveScreenshot("legend.png", view, ImageResolution=SIZE)
    with Image.open("legend.png") as image:
        sheet.paste(image, (place % 3 * SIZE[0], place // 3 * SIZE[1]))
    Delete(display)
os.remove("legend.png")
sheet.save(os.path.join(folder, "legend.jpg"), quality=85)
print("Wrote", os.path.abspath(os.path.join(folder, "legend.jpg")))
Delete(view)
del view
