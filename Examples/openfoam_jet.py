# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""From an OpenFOAM case to a figure, and to numbers that an interferometer measures: Documentation/tutorial.md.

    pvpython Examples/openfoam_jet.py        (writes openfoam_jet.png, .json, .pvsm, _intensity.png and .tif)
"""

import os
import sys

import numpy as np
from paraview import servermanager
from paraview.simple import *
from vtkmodules.util.numpy_support import vtk_to_numpy

root = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
sys.path.insert(0, os.path.join(root, "Examples"))
from load_schlieren import load_schlieren  # noqa: E402

load_schlieren(globals())
import schlieren_figure  # noqa: E402, which comes with the plugin

case = OpenFOAMReader(FileName=os.path.join(root, "Testing", "Data", "ladenburg_openfoam", "ladenburg.foam"))
case.MeshRegions = ["internalMesh"]
case.CellArrays = ["p", "T"]
last = case.TimestepValues[-1]
case.UpdatePipeline(last)

# The case is a wedge of 5 degrees around the x axis, which is revolved; p and T are found by their names, and the gas is air.
schlieren = Schlieren(Input=case, Cutoff="Interferogram", Wavelength=546.1,
                      ViewDirection=[0, 0, -1], FocalPoint=[0.015, 0, 0], ParallelScale=0.0095,
                      ImageSize=[480, 300], Quality="Fine")
schlieren.UpdatePipeline(last)
schlieren_figure.save("openfoam_jet.png", schlieren, title="Under-expanded air jet, 546 nm")
print("Wrote", os.path.abspath("openfoam_jet.png"), "and beside it numbers, settings and a state")

# How many fringes the axis is off the air around, along the jet.
image = servermanager.Fetch(schlieren)
columns, rows, _ = image.GetDimensions()
path = vtk_to_numpy(image.GetPointData().GetArray("OpticalPathDifference")).reshape(rows, columns)
x, y = (image.GetOrigin()[axis] + image.GetSpacing()[axis] * np.arange(count) for axis, count in ((0, columns), (1, rows)))
axis = path[np.argmin(np.abs(y))] / 546.1e-9
shifts = {place: np.interp(1e-3 * place, x, axis) for place in (1.0625, 5.0625, 10.0625, 15.0625, 18.0625)}
for place, shift in shifts.items():
    print(f"{place} mm: {shift:.2f} fringes")
