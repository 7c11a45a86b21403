# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Examples/wavefront.py: each time step against NumPy's straight lines through the layer, and ParaView's means over them. The
second script of Documentation/wavefront.md is a part of it."""

import os
import runpy

import numpy as np
from demo_testing import SOURCE, snippets
from paraview import servermanager, simple
from vtkmodules.util.numpy_support import vtk_to_numpy

trapezoid = np.trapezoid if hasattr(np, "trapezoid") else np.trapz  # its name before NumPy 2

EXAMPLE = os.path.join(SOURCE, "Examples", "wavefront.py")
with open(EXAMPLE, encoding="utf-8") as file:
    lines = file.read().splitlines()
assert set(snippets("wavefront")[1].splitlines()) <= set(lines)
made = runpy.run_path(EXAMPLE)
numbers, of_all, steps, step = (made[name] for name in ("numbers", "of_all", "steps", "step"))
assert np.allclose(numbers["Time"], np.arange(steps) * step)

# Light goes up the image, which is -z, as it looks along -y, and x is to the right.
places = (np.arange(104) + 0.5) / 104 * 0.052 - 0.026
u, v = (values[np.hypot(*np.meshgrid(places, places)) <= 0.025] for values in np.meshgrid(places, places))
y = np.linspace(0, made["thickness"], 81)[:, None]
residuals = []
for i in range(steps):
    path = 2.26e-4 * trapezoid(made["density"](u, y, -v, i * step), y, axis=0)
    terms = np.stack([np.ones(u.size), u, v], 1)
    fit = np.linalg.lstsq(terms, path, rcond=None)[0]
    residuals.append(path - terms @ fit)
    assert abs(numbers["OPDrms"][i] / residuals[-1].std() - 1) < 0.01, (i, numbers["OPDrms"][i], residuals[-1].std())
    for name, tilt in (("TiltRight", fit[1]), ("TiltUp", fit[2])):
        assert abs(numbers[name][i] - tilt) < 3e-9, (i, name, numbers[name][i], tilt)
print("OPDrms", numbers["OPDrms"][-1], residuals[-1].std())

for name in ("OPDrms", "StrehlRatio", "TiltRight", "TiltUp", "Z4 Defocus"):
    assert np.isclose(of_all(f"{name}_average"), numbers[name].mean(), rtol=1e-9), name
    assert np.isclose(of_all(f"{name}_stddev"), numbers[name].std(), rtol=1e-6), name
for name, right in (("OPDrms_average", 20.3e-9), ("StrehlRatio_average", 0.986), ("TiltRight_stddev", 0.107e-6),
                    ("TiltUp_stddev", 0.066e-6)):  # as the page says
    assert abs(of_all(name) / right - 1) < 0.01, (name, of_all(name))
assert len(open("wavefront.csv").readlines()) == steps + 1
assert os.path.getsize("wavefront.png") > 50000

# What stays and what moves, pixel by pixel.
moving = simple.TemporalStatistics(Input=simple.OutputPort(made["wavefront"], "Residual"))
moving.UpdatePipeline()
pixels = servermanager.Fetch(moving).GetPointData()
mean, deviation = (vtk_to_numpy(pixels.GetArray(f"ResidualWavefront_{name}")) for name in ("average", "stddev"))
inside = np.isfinite(mean)
assert inside.sum() == numbers["AperturePixels"][0]
rms = np.sqrt((mean[inside] ** 2 + deviation[inside] ** 2).mean())
assert abs(rms / np.sqrt((numbers["OPDrms"] ** 2).mean()) - 1) < 1e-6, rms
