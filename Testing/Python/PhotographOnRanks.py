# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""A photograph that two ranks compare with an image is read whole, as by one. Skipped without mpiexec and pvbatch.

With an argument, what the ranks do: the file of the photograph."""

import os
import re
import sys

import numpy as np
from ranks_testing import is_rank0, on, run, skip_without_mpi


# Only those who do the work import the plugin: MPI does not let a process that uses it start others that do.
# pylint: disable=import-outside-toplevel
def compare(file):
    from paraview import simple
    simple.LoadPlugin(os.environ["SCHLIEREN_PLUGIN"], remote=False, ns=vars(simple))
    bench = simple.Schlieren(Input=simple.Wavelet(WholeExtent=3 * [-8, 8]), Density=["POINTS", "RTData"],
                             GladstoneDaleConstant=1e-6, ImageSize=[64, 64], Quality="Interactive")
    comparison = simple.CompareWithPhotograph(Input=bench, Photograph=simple.PNGSeriesReader(FileNames=[file]))
    comparison.UpdatePipeline()
    if is_rank0():
        image = comparison.GetClientSideObject().GetOutputDataObject(0)
        photograph = image.GetPointData().GetArray("Photograph")
        seen = [photograph.GetTuple1(i) for i in range(image.GetNumberOfPoints())]
        print(f"found {np.nanmean(seen)} {np.isfinite(seen).sum()} "
              f"{image.GetFieldData().GetArray('PhotographResidual').GetTuple1(0)}", flush=True)


def write(file):
    from vtkmodules.util.numpy_support import numpy_to_vtk
    from vtkmodules.vtkCommonDataModel import vtkImageData
    from vtkmodules.vtkIOImage import vtkPNGWriter
    y, x = np.mgrid[0:90, 0:90]
    image = vtkImageData()
    image.SetDimensions(90, 90, 1)
    values = 128 + 60 * np.sin(x / 9) * np.cos(y / 14) + y / 3
    image.GetPointData().SetScalars(numpy_to_vtk(values.astype(np.uint8).ravel(), deep=True))
    writer = vtkPNGWriter()
    writer.SetFileName(file)
    writer.SetInputData(image)
    writer.Write()


if sys.argv[1:]:
    compare(sys.argv[1])
else:
    skip_without_mpi()
    name = os.path.abspath("photograph.png")
    write(name)
    one, two = ([float(value) for value in re.search(r"found (\S+) (\S+) (\S+)", run(on(ranks), name)).groups()]
                for ranks in (1, 2))
    assert one == two, (one, two)
    assert one[1] > 3500, one
