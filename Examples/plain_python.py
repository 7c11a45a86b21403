# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""A schlieren image in plain Python, without ParaView's pipeline: a vortex ring of numpy, seen from its side.

    python3 Examples/plain_python.py        (writes plain_python.png)

The package paraview-schlieren puts the classes where python3 finds them; after a build they lie beside the plugin. They take
any dataset of VTK, of ParaView's own VTK (Debian's python3-paraview).
"""

import os
import sys

import numpy as np

built = os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "build", "release", "plugin-file.txt")
if os.path.exists(built):
    with open(built) as file:
        sys.path.append(os.path.dirname(file.read().strip()))
from schlieren.vtkSchlierenFilters import vtkRefractiveIndex, vtkSchlierenFilter  # noqa: E402
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy  # noqa: E402
from vtkmodules.vtkCommonDataModel import vtkImageData  # noqa: E402
from vtkmodules.vtkImagingCore import vtkImageShiftScale  # noqa: E402
from vtkmodules.vtkIOImage import vtkPNGWriter  # noqa: E402

points = 96
z, y, x = np.meshgrid(*3 * [np.linspace(-0.05, 0.05, points)], indexing="ij")
core = np.hypot(np.hypot(y, z) - 0.025, x)  # distance from a circle in the plane x = 0
density = 1.2 - 0.3 * np.exp(-(core / 0.006)**2)  # kg/m^3

flow = vtkImageData()
flow.SetDimensions(points, points, points)
flow.SetOrigin(-0.05, -0.05, -0.05)
flow.SetSpacing(*3 * [0.1 / (points - 1)])  # metres
array = numpy_to_vtk(density.ravel())
array.SetName("rho")
flow.GetPointData().AddArray(array)

schlieren = vtkSchlierenFilter()
schlieren.SetInputData(flow)
schlieren.SetIndexModel(vtkRefractiveIndex.GLADSTONE_DALE)
schlieren.SetInputArrayToProcess(0, 0, 0, 0, "rho")
schlieren.SetKnifeEdgeAngle(90)
schlieren.SetImageSize(400, 400)
schlieren.Update()
deflection = vtk_to_numpy(schlieren.GetOutput().GetPointData().GetArray("Deflection"))
print("largest deflection:", np.abs(deflection).max(), "rad")

grey = vtkImageShiftScale()
grey.SetInputConnection(schlieren.GetOutputPort())
grey.SetScale(255)
grey.SetOutputScalarTypeToUnsignedChar()
grey.ClampOverflowOn()
png = vtkPNGWriter()
png.SetFileName("plain_python.png")
png.SetInputConnection(grey.GetOutputPort())
png.Write()
print("Wrote", os.path.abspath("plain_python.png"))
