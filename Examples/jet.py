# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Schlieren of a jet with a horizontal knife edge, as a grey image and as numbers.

    Utilities/with-display pvpython Examples/jet.py        (writes jet.png)
"""

import os
import sys

from paraview.simple import *

root = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
sys.path.insert(0, os.path.join(root, "Examples"))
from load_schlieren import load_schlieren  # noqa: E402

load_schlieren(globals())

jet = OpenDataFile(os.path.join(root, "Testing", "Data", "ladenburg_jet_3d.vti"))
jet.UpdatePipeline()  # so that the filter can offer its arrays

schlieren = Schlieren(Input=jet)
schlieren.IndexModel = "Gladstone-Dale"
schlieren.Density = ["POINTS", "rho"]  # kg/m^3
schlieren.ViewDirection = [0, 0, -1]
schlieren.Cutoff = "Knife Edge"
schlieren.KnifeEdgeAngle = 90  # bright: light is deflected upwards
schlieren.ImageSize = [900, 480]
schlieren.Quality = "Publication"  # edges without steps
schlieren.SamplesPerPixel = 4  # fewer than the preset has, to be quicker
schlieren.UpdatePipeline()

arrays = schlieren.PointData
print("k:", schlieren.FieldData["KScale"].GetRange()[0])
print("largest deflection:", arrays["Deflection"].GetRange(-1)[1], "rad")
print("optical path difference:", arrays["OpticalPathDifference"].GetRange(), "m")

view = CreateView("RenderView", ViewSize=[900, 480], OrientationAxesVisibility=0)
display = Show(schlieren, view)
ColorBy(display, ("POINTS", "Intensity"))
display.SetScalarBarVisibility(view, False)
grey = GetColorTransferFunction("Intensity")
grey.ApplyPreset("Grayscale", True)
grey.RescaleTransferFunction(0, 1)
view.InteractionMode = "2D"
ResetCamera(view)
view.CameraParallelScale = 0.0081
SaveScreenshot("jet.png", view)
print("Wrote", os.path.abspath("jet.png"))
Delete(view)
del view
