# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The examples of the window's menu: the scripts of Documentation/gallery.md run as printed and write a figure, images are as
they were, and numbers are those of theory."""

import math
import os
import sys

import numpy as np
from flow_testing import SOURCE, check_baseline, image_array, output
from paraview import servermanager
from vtkmodules.util.numpy_support import vtk_to_numpy

sys.path.insert(0, os.path.join(SOURCE, "Examples"))
import gallery  # noqa: E402
from schlieren_figure import facts_of  # noqa: E402

with open(os.path.join(SOURCE, "Documentation", "gallery.md"), encoding="utf-8") as file:
    assert gallery.page() == file.read(), "Run pvpython Examples/gallery.py Documentation"

made = {}
for example in gallery.schlieren_examples.EXAMPLES:
    name = example.__name__
    *lines, save = gallery.script(example).splitlines()
    names = {"Schlieren": gallery.Schlieren}  # which LoadPlugin(..., ns=globals()) adds
    exec("\n".join(lines), names)
    made[name] = schlieren = names["schlieren"]
    columns, rows = schlieren.ImageSize
    schlieren.ImageSize = [200, 200 * rows // columns if rows else 107]
    schlieren.Quality = "Interactive"
    exec(save, names)
    assert os.path.getsize(name + ".png") > 5000
    check_baseline(schlieren, "Example" + name.title().replace("_", ""), facts_of(output(schlieren))["WhiteLevel"][0],
                   "Color" if name == "mirage" else "Intensity")


def values(flow, name):
    """An array of the data, as numbers."""
    return vtk_to_numpy(servermanager.Fetch(flow).GetPointData().GetArray(name)).astype(float)


# Mirage: light that comes down at less than sqrt(2 (n above - n at the road)) is bent up again by twice its angle.
cold, hot = (1e-6 * 276.8 * 288.15 / temperature for temperature in np.sort(values(made["mirage"].Input, "T"))[[0, -1]])
steepest = math.sqrt(2 * (cold - hot))
found = image_array(made["mirage"], "Deflection")[..., 1].max() / 2
pixel = math.radians(1.5) / 100
print(f"Mirage: light of {1e3 * found:.3f} mrad is bent up again, in theory of {1e3 * steepest:.3f}; a pixel is {1e3 * pixel:.3f}")
assert steepest - pixel < found < 1.002 * steepest

# Tank: light through the steepest gradient b of the depth L meets the stripes at the distance D displaced by b L (L / (2 n) + D).
index = values(made["tank"].Input, "n").reshape(3, 241, 3)[1, :, 1]
gradient = np.abs(np.gradient(index, 0.06 / 240)).max()
expected = gradient * 0.02 * (0.01 / index.mean() + 0.5)
found = np.abs(image_array(made["tank"], "BackgroundDisplacement")[..., 1]).max()
print(f"Tank: stripes displaced by {1e3 * found:.3f} mm, in theory by {1e3 * expected:.3f}")
assert abs(found / expected - 1) < 0.02
