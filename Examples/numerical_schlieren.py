# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""What is often shown instead of a schlieren image, beside a traced one: the same jet, the same view.

    pvpython Examples/numerical_schlieren.py        (writes numerical_schlieren.png)
"""

import os
import sys
import time

import matplotlib
import numpy as np
from paraview.simple import *
from paraview import servermanager
from vtkmodules.util.numpy_support import vtk_to_numpy

matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402

root = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
sys.path.insert(0, os.path.join(root, "Examples"))
from load_schlieren import load_schlieren  # noqa: E402

load_schlieren(globals())

jet = OpenDataFile(os.path.join(root, "Testing", "Data", "ladenburg_jet_3d.vti"))
jet.UpdatePipeline()
data = servermanager.Fetch(jet)
nx, ny, nz = data.GetDimensions()
step = data.GetSpacing()[0]
density = vtk_to_numpy(data.GetPointData().GetArray("rho")).reshape(nz, ny, nx).astype(float)

times = {}


def timed(name, make):
    begin = time.perf_counter()
    made = make()
    times[name] = time.perf_counter() - begin
    return made


# The gradient of the density, kg/m^4.
slope = timed("gradient", lambda: np.sqrt(sum(axis ** 2 for axis in np.gradient(density, step))))
middle = slope[nz // 2]
# Quirk & Karni 1996 (Journal of Fluid Mechanics 318, 129-163) and many since: dark where the gradient is large.
exponential = np.exp(-15 * middle / middle.max())
along_light = timed("sum along the light", lambda: slope.sum(axis=0) * step)

schlieren = Schlieren(Input=jet, Density=["POINTS", "rho"], ViewDirection=[0, 0, -1], ImageSize=[2 * nx, 2 * ny],
                      ParallelScale=0.5 * (ny - 1) * step, Quality="Fine")
images = {}
for name, settings in (("knife edge, upright", {"Cutoff": "Knife Edge", "KnifeEdgeAngle": 0}),
                       ("shadowgraph", {"Cutoff": "Shadowgraph", "ScreenDistance": 0.02}),
                       ("bright field", {"Cutoff": "Bright Field"})):
    for key, value in settings.items():
        setattr(schlieren, key, value)
    timed(name, schlieren.UpdatePipeline)
    image = servermanager.Fetch(schlieren)
    width, height, _ = image.GetDimensions()
    images[name] = vtk_to_numpy(image.GetPointData().GetArray("Intensity")).reshape(height, width)

figure, axes = pyplot.subplots(3, 2, figsize=(9, 7.6), constrained_layout=True)
shown = (("|∇ρ| in the plane of symmetry", middle, "gray_r", (0, 0.3 * middle.max())),
         ("traced: knife edge, upright", images["knife edge, upright"], "gray", (0, 1)),
         ("exp(−15 |∇ρ| / max) in that plane", exponential, "gray", (0, 1)),
         ("traced: shadowgraph, screen at 20 mm", images["shadowgraph"], "gray", (0, 2)),
         ("∫ |∇ρ| ds along the light", along_light, "gray_r", (0, along_light.max())),
         ("traced: bright field", images["bright field"], "gray", (0, 1)))
millimetres = 1e3 * step
for place, (title, values, colors, limits) in zip(axes.flat, shown):
    place.imshow(values, origin="lower", cmap=colors, vmin=limits[0], vmax=limits[1],
                 extent=(0, (nx - 1) * millimetres, -0.5 * (ny - 1) * millimetres, 0.5 * (ny - 1) * millimetres))
    place.set_title(title, fontsize=9)
    place.tick_params(labelsize=7)
figure.savefig("numerical_schlieren.png", dpi=110)
print("Wrote", os.path.abspath("numerical_schlieren.png"))

for name, seconds in times.items():
    print(f"{name}: {seconds:.2f} s")
