# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Documentation/instruments.md: every snippet runs as it stands, and gives what the closed form does."""

import os
import re

import numpy as np
from flow_testing import SOURCE

trapezoid = np.trapezoid if hasattr(np, "trapezoid") else np.trapz  # its name before NumPy 2

os.makedirs("run/build/release", exist_ok=True)
os.chdir("run")
with open("build/release/plugin-file.txt", "w") as file:
    file.write(os.environ["SCHLIEREN_PLUGIN"] + "\n")
with open(os.path.join(SOURCE, "Documentation", "instruments.md"), encoding="utf-8") as file:
    page = file.read()
names = {}
for snippet in re.findall(r"^```python\n(.*?)^```", page, re.DOTALL | re.MULTILINE):
    exec(compile(snippet, "instruments.md", "exec"), names)
array = names["array"]


def check(name, got, right, tolerance):
    error = np.abs(got - right).max() / np.abs(right).max()
    print(f"{name}: largest {np.abs(right).max():.5g}, error {error:.1e} of it")
    assert error < tolerance, name


def axes(proxy):
    """The places of an image's columns and rows, in data units."""
    image = proxy.GetClientSideObject().GetOutputDataObject(0)
    return [image.GetOrigin()[i] + image.GetSpacing()[i] * np.arange(image.GetDimensions()[i]) for i in (0, 1)]


# The column: N = K (1.2 - 0.5 exp(-r^2 / 100)), 40 mm along the light.
K, depth, square = 2.26e-4, 0.04, 100


def path(x, y):
    return -K * 0.5 * depth * np.exp(-(x ** 2 + y ** 2) / square)


def deflection(x, y):
    """To the right; of light whose path is the above, in m by mm."""
    return -2 * x / square * path(x, y) * 1e3


moire = array(names["moire"], "Intensity")
x, y = np.meshgrid(*axes(names["moire"]))
right = 0.5 * (1 + np.cos(2 * np.pi * names["distance"] * deflection(x, y) / names["period"]))
check("moire", moire - 1, right - 1, 0.01)  # light is displaced by its deflection, which the closed form leaves out

focusing = array(names["focusing"], "Intensity")
x, y = np.meshgrid(*axes(names["focusing"]))
right = names["to_source"] / names["lines"] * deflection(x, y)
check("focusing schlieren", focusing - 0.5, right, 5e-3)

columns, rows = axes(names["sheet"])
shear = names["shear"]
x, y = np.meshgrid(0.5 * (columns[shear:] + columns[:-shear]), rows)
apart = shear * (columns[1] - columns[0]) / 2
check("shear", names["phase"], 2 * np.pi * (path(x + apart, y) - path(x - apart, y)) / 532e-9, 3e-3)

# The beam is a Gaussian at each place along it, and so is the column.
z = np.linspace(-20, 20, 2001)
wider = square + 2 * (0.1 * z) ** 2 / 4
signal = [trapezoid(path(0, 0) / 40 * square / wider * np.exp(-at ** 2 / wider), z) for at in (8.25, 7.75)]
check("focused laser differential interferometer", names["signal"], signal[0] - signal[1], 5e-3)

# To first order, from the deflection of half the column, of 20 mm.
x, y = np.meshgrid(columns, rows)
check("light sheet", names["shift"][..., 0], deflection(x, y) / 2 * 20 / 2, 5e-3)

x, y = np.meshgrid(*axes(names["integral"]))
right = 2.631e-13 * 532e-9 ** 2 * 1e25 * 10 * (1 + x / 40) * np.exp(-(x ** 2 + y ** 2) / 36) * np.sqrt(np.pi) * 6e-3
check("Faraday", names["angle"], right, 1e-3)
