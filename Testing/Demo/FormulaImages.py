# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The demo on a file that holds no density: OpenFOAM's wedge, density from p and T in its cells."""

import os
from types import SimpleNamespace

import numpy as np
from demo_testing import DATA, check_not_blank, run_demo, tiles
from arguments import VIEWS
from frame import Frame

case = os.path.join(DATA, "ladenburg_openfoam", "ladenburg.foam")
path = os.path.abspath("wedge.png")
code, out, err = run_demo(case, "--formula", "p/(287.1*T)", "--size", "240x80",
                          "--set", "Outside=Passes", "--set", "ScreenDistance=0.2",
                          "--output", path)
assert code == 0, f"Exit code {code}"

options = SimpleNamespace(view=VIEWS["z"], center=None, size=(240, 80), half_height=None)
frame = Frame((0, 0.03, 0, 0.01, -4.366e-4, 4.366e-4), options)
volume, vertical, horizontal, shadow = tiles(path, frame)
check_not_blank(volume, vertical, horizontal, shadow)
# The solver has the Mach disc at 13.75 mm.
x = frame.left + (np.arange(frame.width) + 0.5) * frame.pixel
y = frame.bottom + (np.arange(frame.height) + 0.5) * frame.pixel
bright = x[vertical[(y > 5e-4) & (y < 1.2e-3)].mean(axis=0).argmax()]
print(f"Mach disc at {bright * 1e3:.2f} mm")
assert abs(bright - 0.01375) < 0.0004
