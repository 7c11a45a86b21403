# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Examples/bos_bench.py: its formulas against rays, and what it prints against Documentation/bench.md."""

import os
import subprocess
import sys

import numpy as np
from demo_testing import PVPYTHON, SOURCE
from paraview.simple import LoadPlugin, TrivialProducer
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData

sys.path.insert(0, os.path.join(SOURCE, "Examples"))
import bos_bench  # noqa: E402

LoadPlugin(os.environ["SCHLIEREN_PLUGIN"], remote=False, ns=globals())

# A layer whose density grows upwards by the least gradient that the bench finds, seen by its camera.
bench = bos_bench.bos()
depth, cells = 0.1, 16
y = np.linspace(-0.05, 0.05, cells + 1)
flow = vtkImageData()
flow.SetDimensions(cells + 1, cells + 1, cells + 1)
flow.SetOrigin(-0.05, -0.05, -depth / 2)
flow.SetSpacing(*3 * [0.1 / cells])
density = numpy_to_vtk(np.broadcast_to((1.2 + bench.least_gradient * y)[None, :, None], 3 * (cells + 1,)).ravel(), deep=1)
density.SetName("rho")
flow.GetPointData().AddArray(density)
source = TrivialProducer()
source.GetClientSideObject().SetOutput(flow)
source.UpdatePipeline()
degrees = float(np.degrees(2 * np.arctan(0.5 * bench.height_flow / 0.5)))  # seen from 0.5 m
taken = Schlieren(Input=source, Density=["POINTS", "rho"], Cutoff="Background Oriented",  # noqa: F821
                  BackgroundDistance=0.5 - depth / 2,
                  AmbientRefractivity=2.26e-4 * 1.2, ViewAngle=degrees, ParallelScale=bench.height_flow / 2,
                  ImageSize=[33, 33], Precision="Double", Quality="Publication")
taken.UpdatePipeline()
image = taken.GetClientSideObject().GetOutputDataObject(0)
rows = vtk_to_numpy(image.GetPointData().GetArray("Deflection")).reshape(33, 33, -1)
moved = vtk_to_numpy(image.GetPointData().GetArray("BackgroundDisplacement")).reshape(33, 33, -1)
print("deflection", rows[16, 16], "of", bench.least_deflection, "displacement", moved[16, 16] / bench.pixel_background, "pixels")
assert abs(rows[16, 16, 1] / bench.least_deflection - 1) < 0.01
assert abs(moved[16, 16, 1] / bench.pixel_background / 0.05 - 1) < 0.01

# A thin lens: what is in focus is as large on the sensor as its pixels say.
assert abs(bench.pixel_background * bench.magnification / 3.45e-6 - 1) < 1e-12
assert abs(1 / 0.05 - 1 / 1.0 - 1 / (bench.magnification * 1.0)) < 1e-9
assert abs(1e-3 * 8.4456 / (0.05 * (1 + bench.magnification)) / (bench.width_flow / 0.5) - 1) < 1e-9
assert abs(bench.sensor_width / 0.05 / (bench.width_flow / 0.5) - 1) < 1e-9
edge = bos_bench.schlieren()
assert edge.k == 1000 and edge.full_deflection == 0.0005

python = os.path.join(os.path.dirname(os.path.realpath(PVPYTHON)), "python3")
script = [python, os.path.join(SOURCE, "Examples", "bos_bench.py")]
printed = subprocess.run(script, capture_output=True, text=True, timeout=100, check=True).stdout
with open(os.path.join(SOURCE, "Documentation", "bench.md"), encoding="utf-8") as page:
    assert printed.strip() in page.read(), "The page has other numbers"
refused = subprocess.run([*script, "--focal", "2000"], capture_output=True, text=True, timeout=100)
assert refused.returncode == 2 and "further away" in refused.stderr and "Traceback" not in refused.stderr
