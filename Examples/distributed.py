# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Flows whose parts are on several ranks: around a sphere in a body-fitted mesh with a far field, and a jet.

    mpiexec -np 4 pvbatch --force-offscreen-rendering Examples/distributed.py

It writes sphere.vti, jet.vti (all arrays) and sphere.png, jet.png: the same ones for any number of ranks. A number behind
it is the size of the images in pixels instead of 512.
"""

import os
import sys

from paraview.simple import *
from vtkmodules.vtkImagingCore import vtkImageShiftScale
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkIOXML import vtkXMLImageDataWriter
from vtkmodules.vtkParallelCore import vtkMultiProcessController

root = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
sys.path.insert(0, os.path.join(root, "Examples"))
from load_schlieren import load_schlieren  # noqa: E402

load_schlieren(globals())
pixels = int(sys.argv[1]) if len(sys.argv) > 1 else 512

# Each rank makes its layers of the mesh, as a parallel solver would.
EXTENT = """
executive = self.GetExecutive()
info = executive.GetOutputInformation(0)
info.Set(executive.WHOLE_EXTENT(), [0, 80, 0, 40, 0, 40], 6)
info.Set(self.CAN_PRODUCE_SUB_EXTENT(), 1)
"""
LAYERS = """
import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkParallelCore import vtkMultiProcessController
ranks = vtkMultiProcessController.GetGlobalController()
rank, number = ranks.GetLocalProcessId(), ranks.GetNumberOfProcesses()
first, last = 40 * rank // number, 40 * (rank + 1) // number
r = 1 + 49 * (1.12 ** np.arange(first, last + 1) - 1) / (1.12 ** 40 - 1)  # radii of the sphere
r, polar, around = np.meshgrid(r, np.linspace(0, np.pi, 41), np.linspace(0, 2 * np.pi, 81), indexing="ij")
x, y, z = r * np.cos(polar), r * np.sin(polar) * np.sin(around), r * np.sin(polar) * np.cos(around)
layer = np.exp(-((r - 1.6) / 0.3) ** 2) * (1 - x / r) / 2
wake = np.exp(-(y ** 2 + z ** 2) / 0.5) * (0.5 + 0.5 * np.tanh(2 * (x - 0.5))) * np.exp(-(x / 6) ** 2)
output = self.GetOutputDataObject(0)
output.SetExtent(0, 80, 0, 40, first, last)
points = vtkPoints()
points.SetData(numpy_to_vtk(np.stack([x.ravel(), y.ravel(), z.ravel()], 1), deep=1))
output.SetPoints(points)
density = numpy_to_vtk((1.2 * (1 + 0.6 * layer - 0.4 * wake)).ravel(), deep=1)
density.SetName("rho")
output.GetPointData().SetScalars(density)
"""


def show(name, flow, scale, direction):
    schlieren = Schlieren(Input=flow, Density=["POINTS", "rho"], ParallelScale=scale, ViewDirection=direction,
                          ImageSize=[pixels, pixels], KnifeEdgeAngle=90, Quality="Fine")
    schlieren.UpdatePipeline()
    schlieren.UpdatePropertyInformation()
    if vtkMultiProcessController.GetGlobalController().GetLocalProcessId() == 0:  # the others have no image
        print(name + ":", schlieren.GetProperty("Status").GetData())
        image = schlieren.GetClientSideObject().GetOutputDataObject(0)
        writer = vtkXMLImageDataWriter()
        writer.SetFileName(name + ".vti")
        writer.SetInputData(image)
        writer.Write()
        grey = vtkImageShiftScale()
        grey.SetInputData(image)
        grey.SetScale(255)
        grey.SetOutputScalarTypeToUnsignedChar()
        grey.ClampOverflowOn()
        writer = vtkPNGWriter()
        writer.SetFileName(name + ".png")
        writer.SetInputConnection(grey.GetOutputPort())
        writer.Write()
        print("Wrote", *(os.path.abspath(name + ending) for ending in (".vti", ".png")))


show("sphere", ProgrammableSource(OutputDataSetType="vtkStructuredGrid", ScriptRequestInformation=EXTENT,
                                  Script=LAYERS), 3, [0, 0, -1])
show("jet", OpenDataFile(os.path.join(root, "Testing", "Data", "ladenburg_jet_3d.vti")), 0.0081, [0, 0, -1])
