# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""A script for ParaView Catalyst: a schlieren image of each time that a simulation hands over, as schlieren_0000.png.

The simulation's channel is "gas", its density the cells' array "rho", in kg/m^3, its lengths are metres."""

import os

from paraview import catalyst
from paraview.simple import *
from vtkmodules.vtkCommonCore import vtkUnsignedCharArray
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkImagingCore import vtkImageShiftScale

plugin = os.environ.get("SCHLIEREN_PLUGIN")
if plugin:  # else ParaView has it from PV_PLUGIN_PATH
    LoadPlugin(plugin, remote=False, ns=globals())

options = catalyst.Options()

gas = TrivialProducer(registrationName="gas")
schlieren = Schlieren(Input=gas, Density=["CELLS", "rho"])
schlieren.Cutoff = "Knife Edge"
schlieren.ImageSize = [480, 240]
schlieren.Quality = "Fine"
# What does not depend on the flow that happens to be there first.
schlieren.KMode = "Value"
schlieren.KScale = 400
schlieren.AmbientRefractivity = 1.2 * 2.26e-4  # of air of 1.2 kg/m^3
schlieren.FocalPoint = [0.06, 0, 0]
schlieren.ParallelScale = 0.03


def catalyst_execute(info):
    schlieren.UpdatePipeline(info.time)
    image = schlieren.GetClientSideObject().GetOutputDataObject(0)
    if image.GetNumberOfPoints() == 0:  # the image is on rank 0
        return
    grey = vtkImageShiftScale()
    grey.SetInputData(image)
    grey.SetScale(255)
    grey.SetOutputScalarTypeToUnsignedChar()
    grey.ClampOverflowOn()
    writer = vtkPNGWriter()
    writer.SetInputConnection(grey.GetOutputPort())
    writer.SetFileName(f"schlieren_{info.timestep:04d}.png")
    writer.Write()
    print(f"step {info.timestep}, {1e6 * info.time:.1f} microseconds: {writer.GetFileName()}", flush=True)
