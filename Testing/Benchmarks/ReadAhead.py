# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""What ReadAheadMemory is worth: seconds per image of a series, of which each step is read and traced.

    SCHLIEREN_PLUGIN=…/Schlieren.so Utilities/with-display pvpython Testing/Benchmarks/ReadAhead.py FOLDER [rounds]

Writes series into FOLDER and prints a table: seconds for reading alone, for an image with and without reading ahead, and the
ratio of both, the median over rounds in which they take turns. The last row waits instead of reading more, as for a slow disk.
"""

import math
import os
import statistics
import sys
import time

import numpy as np
from paraview import simple
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLImageDataWriter

simple.LoadPlugin(os.environ["SCHLIEREN_PLUGIN"], remote=False, ns=globals())

DATA = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "Data")
STEPS = 10
WAIT = """import time
time.sleep(0.5)
self.GetOutputDataObject(0).ShallowCopy(self.GetInputDataObject(0, 0))"""


def write_series(folder, name, reader, refined=1):
    """The flow, whose density pulsates around its mean. `refined`: times as many points along each axis of an image."""
    path = os.path.join(folder, f"{name}.pvd")
    if refined > 1:
        reader = simple.ResampleToImage(Input=reader, SamplingDimensions=[refined * n for n in (120, 64, 64)])
    reader.UpdatePipeline()
    flow = reader.GetClientSideObject().GetOutputDataObject(0)
    values = vtk_to_numpy(flow.GetPointData().GetArray("rho"))
    entries = []
    for step in range(STEPS):
        data = flow.NewInstance()
        data.CopyStructure(flow)
        pulsating = values.mean() + (values - values.mean()) * (1 + 0.2 * math.sin(step))
        changed = numpy_to_vtk(pulsating.astype(np.float32), deep=True)
        changed.SetName("rho")
        data.GetPointData().AddArray(changed)
        writer = vtkXMLImageDataWriter()
        writer.SetFileName(os.path.join(folder, f"{name}{step}.{writer.GetDefaultFileExtension()}"))
        writer.SetInputData(data)
        writer.Write()
        entries.append(f'<DataSet timestep="{step}" file="{os.path.basename(writer.GetFileName())}"/>')
    with open(path, "w", encoding="utf-8") as file:
        file.write('<VTKFile type="Collection" version="0.1"><Collection>' + "".join(entries)
                   + "</Collection></VTKFile>")
    return path


def seconds_per_step(update):
    start = time.perf_counter()
    for step in range(STEPS):
        update(step)
    return (time.perf_counter() - start) / STEPS


def measure(name, path, waits, rounds, settings):
    plain, ahead = [], []
    for turn in range(rounds + 1):
        for memory, seconds in ((0, plain), (4096, ahead)):
            source = simple.PVDReader(FileName=path)
            if waits:
                source = simple.ProgrammableFilter(Input=source, Script=WAIT, CopyArrays=1)
            bench = Schlieren(Input=source, ReadAheadMemory=memory, **settings)
            taken = seconds_per_step(bench.UpdatePipeline)
            if turn > 0:  # the first warms up
                seconds.append(taken)
            simple.Delete(bench)
    source = simple.PVDReader(FileName=path)
    reading = seconds_per_step(source.UpdatePipeline) + (0.5 if waits else 0)
    ratios = [b / a for a, b in zip(plain, ahead)]
    print(f"{name:30} {reading:8.2f} {statistics.median(plain):8.2f} {statistics.median(ahead):8.2f}"
          f" {statistics.median(ratios):8.2f} ({min(ratios):.2f} to {max(ratios):.2f})", flush=True)


folder, rounds = sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 5
os.makedirs(folder, exist_ok=True)
jet = simple.XMLImageDataReader(FileName=[os.path.join(DATA, "ladenburg_jet_3d.vti")])
gas = {"Density": ["POINTS", "rho"], "SamplesPerPixel": 4, "ImageSize": [512, 512]}
small = write_series(folder, "jet", jet)
large = write_series(folder, "jet_refined", jet, 4)
print(f"{'seconds per step':30} {'reading':>8} {'plain':>8} {'ahead':>8} {'ratio':>8}")
for name, path, waits in (("jet, 4 million points", small, False), ("jet, 31 million points", large, False),
                          ("jet, 4 million points, waits", small, True)):
    measure(name, path, waits, rounds, gas)
