# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""A jet beside a photograph of it: the contrast and the edge of the bench, and where the Mach disc is instead.

    pvpython Examples/photograph.py        (writes photograph.png, without_flow.png and comparison.png)

The photograph is made here, of a jet that is 2 % longer than the computed one, by a camera that is turned by 3 degrees, with an
edge that stands otherwise than in the simulated image. Of your own experiment, take the second half of this script.
"""

import os
import sys

import numpy as np
from paraview.simple import *
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkIOImage import vtkPNGWriter

root = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
sys.path.insert(0, os.path.join(root, "Examples"))
from load_schlieren import load_schlieren  # noqa: E402

load_schlieren(globals())

jet = OpenDataFile(os.path.join(root, "Testing", "Data", "ladenburg_jet_3d.vti"))
jet.UpdatePipeline()
half, size, middle, longer = 0.01125, [800, 600], 0.015, 0.02  # m, pixels, m
schlieren = Schlieren(Input=jet, Density=["POINTS", "rho"], FocalPoint=[middle, 0, 0], ParallelScale=half, ImageSize=size,
                      KnifeEdgeAngle=90)
schlieren.UpdatePipeline()


def image(proxy):
    return proxy.GetClientSideObject().GetOutputDataObject(0)


def field(proxy, name):
    return proxy.FieldData[name].GetRange()[0]


# --- The experiment. ---------------------------------------------------------------------------------------------------
stretched = vtkImageData()
stretched.ShallowCopy(image(jet))
for values, put in ((stretched.GetOrigin(), stretched.SetOrigin), (stretched.GetSpacing(), stretched.SetSpacing)):
    put((1 + longer) * values[0], values[1], values[2])
experiment = TrivialProducer()
experiment.GetClientSideObject().SetOutput(stretched)
turn, edge, offset = np.radians(3), 92.5, -0.1
camera = dict(
    Density=["POINTS", "rho"], FocalPoint=[middle + 0.0004, -0.0003, 0], ViewUp=[-np.sin(turn), np.cos(turn), 0],
    ParallelScale=1.05 * half, ImageSize=size, KMode="Value", KScale=1.6 * field(schlieren, "KScale"), CutoffOffset=offset,
    KnifeEdgeAngle=edge - np.degrees(turn))
noise = np.random.default_rng(1)
experiment.UpdatePipeline()
for name, constant in (("photograph.png", 2.26e-4), ("without_flow.png", 1e-12)):  # of a gas that bends no light
    photographed = Schlieren(Input=experiment, GladstoneDaleConstant=constant, **camera)
    photographed.UpdatePipeline()
    data = image(photographed)
    # What a sensor makes of the light: 20000 electrons fill a pixel, 10 are the noise of reading.
    electrons = 0.8 * 20000 * vtk_to_numpy(data.GetPointData().GetArray("Intensity"))
    read = noise.normal(electrons, np.sqrt(np.maximum(electrons, 0) + 10 ** 2)) / 20000
    recorded = numpy_to_vtk((65535 * np.clip(read, 0, 1) + 0.5).astype(np.uint16), deep=True)
    recorded.SetName("Recorded")
    data.GetPointData().SetScalars(recorded)
    writer = vtkPNGWriter()
    writer.SetFileName(name)
    writer.SetInputData(data)
    writer.Write()

# --- The comparison. ---------------------------------------------------------------------------------------------------
photograph = PNGSeriesReader(FileNames=["photograph.png"])
without_flow = PNGSeriesReader(FileNames=["without_flow.png"])
comparison = CompareWithPhotograph(Input=schlieren, Photograph=photograph, WithoutFlow=without_flow)
comparison.Placement = "By Hand"
comparison.PhotographPosition = [middle + 0.0004, -0.0003]
comparison.PhotographRotation = 3
comparison.PhotographScale = 2 * 1.05 * half / size[1]
comparison.BlackLevel = 0  # of this camera
comparison.Comparison = "Red Cyan"
comparison.UpdatePipeline()
comparison.UpdatePropertyInformation()
print(str(comparison.GetProperty("Report").GetData()).replace(". ", ".\n"))

# Where the Mach disc is in the photograph. Only the shift across features is known, so that a shift s along the flow is
# found as s cos(a) at a feature whose normal is turned by a against it; the steepest points count most.
found = image(comparison)
shape = (size[1], size[0])
arrays = {name: vtk_to_numpy(found.GetPointData().GetArray(name)) for name in ("Simulated", "FeatureShift", "Comparison")}
across = arrays["FeatureShift"].astype(float)
with np.errstate(divide="ignore", invalid="ignore"):
    shift = ((across ** 2).sum(1) / across[:, 0]).reshape(shape)
steep = np.gradient(arrays["Simulated"].reshape(shape), axis=1) ** 2
x = found.GetOrigin()[0] + found.GetSpacing()[0] * np.arange(size[0])
disc = np.s_[250:350, 358:376]
weight = np.where(np.isfinite(shift[disc]), steep[disc], 0)
mach_disc = (weight * np.nan_to_num(shift[disc], posinf=0, neginf=0)).sum() / weight.sum()
expected = (weight * longer * np.broadcast_to(x, shape)[disc]).sum() / weight.sum()
print(f"Mach disc: {1e3 * mach_disc:.3f} mm further downstream than computed; the jet was made so that it is {1e3 * expected:.3f} mm")

found.GetPointData().SetActiveScalars("Comparison")
writer = vtkPNGWriter()
writer.SetFileName("comparison.png")
writer.SetInputData(found)
writer.Write()
print("Wrote", *map(os.path.abspath, ("photograph.png", "without_flow.png", "comparison.png")))
