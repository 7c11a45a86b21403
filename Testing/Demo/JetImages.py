# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The demo as it comes: in all four images the jet's features are where physics puts them."""

import math
import os
from types import SimpleNamespace

import numpy as np
from paraview import simple
from demo_testing import check_not_blank, run_demo, tiles
from arguments import VIEWS
from frame import Frame

code, out, err = run_demo()
path = os.path.abspath("ladenburg_schlieren.png")
assert code == 0, f"Exit code {code}"
assert out.splitlines()[-1].endswith(f"The image: {path}"), "It does not say where the image is"

options = SimpleNamespace(view=VIEWS["z"], center=None, size=None, half_height=None,
                          largest=(880, 640))
# Of the corners of a wedge of 5 degrees for values at points, which the reader makes up to ParaView 5.
radius = 0.01 / (math.cos(math.radians(2.5)) if simple.GetParaViewVersion().major < 6 else 1)
frame = Frame((0, 0.03, -radius, radius, -radius, radius), options)
volume, vertical, horizontal, shadow = tiles(path, frame)
check_not_blank(volume, vertical, horizontal, shadow)


def antisymmetry(tile):
    """How much of it changes sign under reflection about the axis, and how much stays."""
    signal = tile - 0.5
    return np.abs(signal - signal[::-1]).mean() / 2, np.abs(signal + signal[::-1]).mean() / 2


# Reflection about the axis: the sideways deflection stays, the one towards or away from it turns.
odd, even = antisymmetry(horizontal)
assert even < 0.02 * odd, f"Horizontal knife: odd {odd:.4f}, even {even:.4f}"
odd, even = antisymmetry(vertical)
assert odd < 0.02 * even, f"Vertical knife: odd {odd:.4f}, even {even:.4f}"
odd, even = antisymmetry(shadow - shadow.mean() + 0.5)
assert odd < 0.05 * even, f"Shadowgraph: odd {odd:.4f}, even {even:.4f}"

# Light bends towards higher density: downwards at the jet's upper edge, so dark there.
x = frame.left + (np.arange(frame.width) + 0.5) * frame.pixel
y = frame.bottom + (np.arange(frame.height) + 0.5) * frame.pixel
edge = np.ix_((y > 0.0055) & (y < 0.0068), (x > 0.005) & (x < 0.015))
assert horizontal[edge].mean() < 0.45, f"Upper edge of the jet: {horizontal[edge].mean():.3f}"

# The cells of the computation, 3.7 pixels wide, cannot be seen: what three cells in a row do not have in common.
# One level of 255 in the shadowgraph, whose screen is as far away as its light needs to be seen.
for name, tile, most in (("knife", vertical, 0.002), ("shadow", shadow, 1 / 255)):
    smooth = tile[np.ix_(np.abs(y) < 0.001, (x > 0.0145) & (x < 0.018))]
    width = round(3 * 0.125e-3 / frame.pixel)
    cells = np.abs(smooth[:, :-width] / 2 + smooth[:, width:] / 2 - smooth[:, width // 2:width // 2 - width]).mean()
    print(f"{name}: cells of {cells:.4f}")
    assert cells < most, name

# The Mach disc, the steepest rise of the density on the axis, is at x = 13.75 mm in each image.
axis = np.abs(y) < 0.001
bright = x[vertical[axis].mean(axis=0).argmax()]
near = (x > 0.011) & (x < 0.0165)
blueness = (volume[axis][..., 2] - volume[axis][..., 0]).mean(axis=0)
color = x[:-1][near[:-1]][np.diff(blueness)[near[:-1]].argmin()]
ripple = np.abs(np.diff(shadow[axis].mean(axis=0)))
caustic = x[:-1][near[:-1]][ripple[near[:-1]].argmax()]
print(f"Mach disc at {bright * 1e3:.2f} mm (knife), {color * 1e3:.2f} mm (volume), "
      f"{caustic * 1e3:.2f} mm (shadow)")
for place in (bright, color, caustic):
    assert abs(place - 0.01375) < 0.0004
