# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""A flow that changes with time, as files."""

import os

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkIOXML import vtkXMLImageDataWriter


def write_series(path, times, points, density):
    """Writes the point array rho, density(x, y, z, time), on a grid of the cube from -1 to 1: "path.pvd" and, for
    each time, "path0.vti", "path1.vti" and so on."""
    z, y, x = np.meshgrid(*3 * [np.linspace(-1, 1, points)], indexing="ij")
    stem = os.path.splitext(path)[0]
    entries = []
    for step, time in enumerate(times):
        values = numpy_to_vtk(density(x, y, z, time).ravel(), deep=True)
        values.SetName("rho")
        image = vtkImageData()
        image.SetDimensions(3 * [points])
        image.SetOrigin(-1, -1, -1)
        image.SetSpacing(3 * [2 / (points - 1)])
        image.GetPointData().AddArray(values)
        writer = vtkXMLImageDataWriter()
        writer.SetFileName(f"{stem}{step}.vti")
        writer.SetDataModeToBinary()
        writer.SetInputData(image)
        assert writer.Write() == 1
        entries.append(f'<DataSet timestep="{time}" file="{os.path.basename(writer.GetFileName())}"/>')
    with open(path, "w", encoding="utf-8") as file:
        file.write("\n".join(['<VTKFile type="Collection" version="0.1">', "<Collection>", *entries,
                              "</Collection>", "</VTKFile>", ""]))
