# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The blunt fin: a curvilinear PLOT3D grid in dimensionless units, seen along the fin."""

import os
from types import SimpleNamespace

import numpy as np
from demo_testing import DATA, check_not_blank, run_demo, tiles
from arguments import VIEWS
from frame import Frame

grid = os.path.join(DATA, "bluntfin_plot3d", "bluntfinxyz.bin")
path = os.path.abspath("fin.png")
code, out, err = run_demo(grid, "--density-scale", "0.72", "--length-scale", "0.0127",
                          "--center", "1.5,2.5,2.8", "--half-height", "2.5", "--size", "200x125",
                          "--output", path)
assert code == 0, f"Exit code {code}"
assert out.splitlines()[-1].endswith(f"The image: {path}"), "It does not say where the image is"
assert "bluntfinq.bin" in out and "'Density'" in out, "It does not say what it reads"

options = SimpleNamespace(view=VIEWS["z"], center=[1.5, 2.5, 2.8], size=(200, 125),
                          half_height=2.5)
frame = Frame((-7.8157473, 14.3622036, 0, 8.3275585, 0, 5.7242513), options)
assert np.isclose(frame.left, -2.5) and np.isclose(frame.pixel, 0.04)
volume, vertical, horizontal, shadow = tiles(path, frame)
check_not_blank(volume, vertical, horizontal, shadow)

x = frame.left + (np.arange(frame.width) + 0.5) * frame.pixel
y = frame.bottom + (np.arange(frame.height) + 0.5) * frame.pixel
# The fin, one unit thick and half of it in the data, blocks the light; ahead of it nothing does.
fin = np.ix_((y > 0.05) & (y < 0.35), x > 1)
free = np.ix_(y > 0.05, x < -1.5)
for tile in (vertical, horizontal, shadow):
    assert tile[fin].max() == 0, "The fin is transparent"
    assert tile[free].min() > 0.25, "Something blocks the free stream"
# The bow shock on the symmetry plane: light bends towards the dense side, downstream, so bright. A
# round nose of radius R has it 0.386 R exp(4.67 / M^2) ahead (Billig 1967, J. Spacecraft Rockets 4,
# 822): 0.33 at Mach 2.95.
ahead = (x > -1) & (x < 0)
bright = np.clip(vertical[np.ix_((y > 0) & (y < 0.2), ahead)].mean(axis=0) - 0.5, 0, None)
shock = (bright * x[ahead]).sum() / bright.sum()
print(f"Bow shock at x = {shock:.3f}")
assert abs(shock + 0.33) < 0.1
