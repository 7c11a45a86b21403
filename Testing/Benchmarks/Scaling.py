# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""What several ranks take: processor seconds and memory of each, for a first image and for another view.

    SCHLIEREN_PLUGIN=…/Schlieren.so mpiexec -np 4 pvbatch --sym --force-offscreen-rendering \
        Testing/Benchmarks/Scaling.py MODE DATA CELLS [pixels [samples]] [property=value ...]

MODE: gathered or stay. DATA: far, around a sphere, from 1 to 50 radii, CELLS cells of a curvilinear grid, of which
each rank has a sector; half, those around one half of it, without seam and poles, because data with these never
stay; image, a cube of CELLS voxels. One thread on each rank. Prints a row: ranks, mode, data, cells, pixels, and for
the first image and for another view the seconds on the clock, processor seconds of rank 0 and of the others, least to most; the most memory of both beyond
what they have with the data, MB; then the tree's voxels, MB, and million rays of the other view.

Other properties may be given, MediumTolerance=0 for example; their values are Python's.
"""

import ast
import math
import os
import resource
import sys
import time

import numpy as np
from paraview import simple
from vtkmodules.vtkCommonCore import vtkDoubleArray
from vtkmodules.vtkParallelCore import vtkMultiProcessController

MODES = {"gathered": {"GatherLimit": 2**31 - 1}, "stay": {"GatherLimit": 1}}

EXTENT = """
executive = self.GetExecutive()
info = executive.GetOutputInformation(0)
info.Set(executive.WHOLE_EXTENT(), [0, AROUND, 0, POLAR, 0, LAYERS], 6)
info.Set(self.CAN_PRODUCE_SUB_EXTENT(), 1)
"""
SECTORS = """
import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkParallelCore import vtkMultiProcessController
ranks = vtkMultiProcessController.GetGlobalController()
rank, number = ranks.GetLocalProcessId(), ranks.GetNumberOfProcesses()
first, last = AROUND * rank // number, AROUND * (rank + 1) // number
growth = 1.03 ** np.arange(LAYERS + 1) - 1
r, polar, around = np.meshgrid(1 + 49 * growth / growth[-1], np.linspace(GAP, np.pi - GAP, POLAR + 1),
                               np.linspace(0, TURN * np.pi, AROUND + 1)[first:last + 1], indexing="ij")
x, y, z = r * np.cos(polar), r * np.sin(polar) * np.sin(around), r * np.sin(polar) * np.cos(around)
front = np.exp(-((r - 1.6) / 0.15) ** 2) * (1 - np.cos(polar)) / 2
wake = 0.4 * np.exp(-(y ** 2 + z ** 2) / 0.18) * (0.5 + 0.5 * np.tanh(2 * (x - 0.5))) * np.exp(-(x / 6) ** 2)
output = self.GetOutputDataObject(0)
output.SetExtent(first, last, 0, POLAR, 0, LAYERS)
points = vtkPoints()
points.SetData(numpy_to_vtk(np.stack([x.ravel(), y.ravel(), z.ravel()], 1).astype(np.float32), deep=1))
output.SetPoints(points)
density = numpy_to_vtk((1.2 * (1 + 0.6 * front - 0.4 * wake)).ravel().astype(np.float32), deep=1)
density.SetName("rho")
output.GetPointData().SetScalars(density)
"""


def megabytes():
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024


def of_all_ranks(value):
    """A number of each rank, on all of them."""
    mine, all_of_them = vtkDoubleArray(), vtkDoubleArray()
    mine.InsertNextValue(value)
    all_of_them.SetNumberOfTuples(RANKS.GetNumberOfProcesses())
    RANKS.AllGather(mine, all_of_them)
    return [all_of_them.GetValue(i) for i in range(RANKS.GetNumberOfProcesses())]


def in_words(values, digits):
    text = f"{values[0]:.{digits}f}"
    return text + (f" {min(values[1:]):.{digits}f}-{max(values[1:]):.{digits}f}" if values[1:] else "")


RANKS = vtkMultiProcessController.GetGlobalController()
simple.LoadPlugin(os.environ["SCHLIEREN_PLUGIN"], remote=False, ns=globals())


def around_sphere(cells, turn):
    """A source, how many cells it has, and what to look at."""
    size = {"POLAR": round((cells / 1.5 / turn)**(1 / 3)), "TURN": turn}
    size["AROUND"] = turn * size["POLAR"]
    size["LAYERS"] = round(cells / size["POLAR"] / size["AROUND"])
    script, extent = SECTORS, EXTENT
    for name, number in [*size.items(), ("GAP", 0.2 - 0.1 * turn)]:
        script, extent = script.replace(name, str(number)), extent.replace(name, str(number))
    source = simple.ProgrammableSource(OutputDataSetType="vtkStructuredGrid", ScriptRequestInformation=extent, Script=script)
    return source, math.prod(size.values()) // turn, {"Density": ["POINTS", "rho"], "ParallelScale": 3, "FocalPoint": [0, 0, 0]}


def cube(cells):
    edge = round(cells**(1 / 3))
    source = simple.Wavelet(WholeExtent=[0, edge] * 3, Center=[edge / 2] * 3, StandardDeviation=0.5)
    return source, edge**3, {"Density": ["POINTS", "RTData"], "DensityScale": 0.005, "LengthScale": 1 / edge}


DATA = {"far": lambda cells: around_sphere(cells, 2), "half": lambda cells: around_sphere(cells, 1), "image": cube}


def measure():
    mode, data = sys.argv[1:3]
    numbers = [argument for argument in sys.argv[3:] if "=" not in argument]
    others = dict(argument.split("=", 1) for argument in sys.argv[3:] if "=" in argument)
    pixels = int(numbers[1]) if len(numbers) > 1 else 512
    samples = int(numbers[2]) if len(numbers) > 2 else 1
    source, cells, looks = DATA[data](float(numbers[0]))
    source.UpdatePipeline()
    before = megabytes()
    bench = Schlieren(Input=source, ImageSize=[pixels, pixels], SamplesPerPixel=samples, NumberOfThreads=1,  # noqa: F821
                      Device="CPU", **looks, **MODES[mode],
                      **{name: ast.literal_eval(value) for name, value in others.items()})
    row = f"{RANKS.GetNumberOfProcesses()} | {mode} | {data} | {cells:.3g} | {pixels} |"
    for direction in ([0, 0, -1], [0.3, 0.2, -1]):
        bench.ViewDirection = direction
        RANKS.Barrier()
        start, processor = time.time(), time.process_time()
        bench.UpdatePipeline()
        took = of_all_ranks(time.process_time() - processor)
        row += f" {time.time() - start:.2f} | {in_words(took, 2)} |"
    row += f" {in_words(of_all_ranks(megabytes() - before), 0)}"
    if RANKS.GetLocalProcessId() == 0:
        facts = bench.GetClientSideObject().GetOutputDataObject(0).GetFieldData()
        of_medium = facts.GetAbstractArray("MediumBytes")  # none of a grid
        rays = facts.GetAbstractArray("RaysTraced").GetValue(0)
        print(f"{row} | {of_medium.GetValue(0) / 1e6 if of_medium else 0:.1f} | {rays / 1e6:.2f}", flush=True)


measure()
