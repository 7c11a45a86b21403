# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Five fields of a reactor in one schlieren image, each by a transfer function of its own.

    pvpython Examples/fields.py        (writes fields.png, a figure with a legend)
"""

import os
import sys

from paraview.simple import *

root = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
sys.path.insert(0, os.path.join(root, "Examples"))
from load_schlieren import load_schlieren  # noqa: E402

load_schlieren(globals())
import schlieren_figure  # noqa: E402, which comes with the plugin

disk = OpenDataFile(os.path.join(root, "Testing", "Data", "disk_exodus", "disk_out_ref.ex2"))
disk.UpdatePipeline()


def curve(*nodes):
    """A function through (value, result) pairs, straight in between."""
    return CreatePiecewiseFunction(Points=[c for x, y in nodes for c in (x, y, 0.5, 0)])


# The hot disk and its shaft, which the mesh leaves out: a cylinder around z, up to z = 0.
shaft = Transform(Input=Cylinder(Radius=3.81, Height=10, Resolution=72))
shaft.Transform.Rotate = [90, 0, 0]
shaft.Transform.Translate = [0, 0, -5]

schlieren = Schlieren(Input=disk, Bodies=shaft)
schlieren.IndexModel = "Transfer Functions"
schlieren.Fields = ["Temp", "AsH3", "CH4", "GaMe3", "H2"]
schlieren.TransferFunctions = [
    curve((0, 0), (0.4, 0), (0.5, 1), (0.6, 0), (1, 0)),  # around one temperature: a shell
    curve((0, 0), (1, 0.2)),
    curve((0, 0), (1, 1)),
    curve((0, 0), (0.7, 0), (1, 1)),  # only where there is much
    curve((0, 0), (1, 0))]  # flat: left out
schlieren.FieldRanges = [293, 913, 0, 0, 0, 0.0012, 0, 0, 0, 0]  # 0, 0: the field's own range
schlieren.RefractivityScale = 3e-4
schlieren.LengthScale = 0.01  # the reactor is in cm
schlieren.ViewDirection = [0, -1, 0]
schlieren.ViewUp = [0, 0, 1]
schlieren.FocalPoint = [0, 0, 1]
schlieren.ParallelScale = 6
schlieren.ImageSize = [240, 200]
schlieren.Quality = "Publication"
schlieren.SamplesPerPixel = 4  # a small image: not as many as the preset has
schlieren.Outside = "Passes"  # the round reactor lies in a box
schlieren.UpdatePipeline()
schlieren_figure.save("fields.png", schlieren, title="Five fields of a reactor")
print("Wrote", os.path.abspath("fields.png"), "and beside it numbers, settings and a state")
