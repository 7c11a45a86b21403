# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The demo takes what the filter takes: a plane, a series, blocks, the folder of a decomposed OpenFOAM case, a formula."""

import os
import shutil

import numpy as np
from demo_testing import DATA, image_array, run_here
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonDataModel import vtkImageData, vtkMultiBlockDataSet
from vtkmodules.vtkIOXML import vtkXMLImageDataWriter, vtkXMLMultiBlockDataWriter


def image(dimensions, shift=0.):
    """A bump of the density in g/cm3 between cells of 0.1."""
    made = vtkImageData()
    made.SetDimensions(*dimensions)
    made.SetSpacing(0.1, 0.1, 0.1)
    made.SetOrigin(shift, 0, 0)
    z, y, x = np.meshgrid(*(np.linspace(-1, 1, n) if n > 1 else np.zeros(1) for n in dimensions[::-1]), indexing="ij")
    array = numpy_to_vtk((1.2e-3 + 2e-4 * np.exp(-4 * (x**2 + y**2 + z**2))).ravel(), deep=True)
    array.SetName("rho [g/cm3]")
    made.GetPointData().SetScalars(array)
    return made


def write(writer, data, name):
    writer.SetInputData(data)
    writer.SetFileName(name)
    assert writer.Write() == 1


def check(name, *arguments, saying=()):
    code, out, err = run_here(name, "--size", "64x64", "--output", "made.png", *arguments)
    assert code == 0 and "Traceback" not in err, (name, err)
    for words in saying:
        assert words in out, (name, words, out)
    assert image_array("made.png").std() > 10, name
    os.remove("made.png")


UNIT = "Density: 'rho [g/cm3]' times 1000"
write(vtkXMLImageDataWriter(), image((17, 17, 1)), "plane.vti")
check("plane.vti", saying=[UNIT])
write(vtkXMLImageDataWriter(), image((9, 9, 9)), "step.vti")
with open("series.pvd", "w", encoding="ascii") as file:
    file.write('<VTKFile type="Collection" version="0.1"><Collection>'
               '<DataSet timestep="1" file="step.vti"/><DataSet timestep="2" file="step.vti"/>'
               "</Collection></VTKFile>")
check("series.pvd", saying=[UNIT, "Time 2"])
blocks = vtkMultiBlockDataSet()
blocks.SetBlock(0, image((9, 9, 9)))
blocks.SetBlock(1, image((9, 9, 9), 0.8))
write(vtkXMLMultiBlockDataWriter(), blocks, "blocks.vtm")
check("blocks.vtm", saying=[UNIT])

# As a decomposition of one process leaves it.
case = os.path.join(DATA, "ladenburg_openfoam")
shutil.rmtree("case", ignore_errors=True)
shutil.copytree(case, os.path.join("case", "processor0"))
for name in os.listdir(case):
    if name in ("system", "constant"):
        shutil.move(os.path.join("case", "processor0", name), os.path.join("case", name))
shutil.copytree(os.path.join("case", "constant"), os.path.join("case", "processor0", "constant"))
shutil.rmtree(os.path.join("case", "constant", "polyMesh"))
if not os.path.isdir(os.path.join("case", "system")):
    open(os.path.join("case", "case.foam"), "w", encoding="ascii").close()
check("case", "--set", "Outside=Passes")

# A file that holds no density, and a grid whose values are in another file, in dimensionless units.
check(os.path.join(case, "ladenburg.foam"), "--formula", "p/(287.1*T)", "--set", "Outside=Passes")
check(os.path.join(DATA, "bluntfin_plot3d", "bluntfinxyz.bin"), "--density-scale", "0.72", "--length-scale", "0.0127",
      saying=["bluntfinq.bin", "'Density'"])
