# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The scripts that make images of the pages: each property of a pair changes the image, and each figure of the lecture shows
what it says."""

import os
import sys

import numpy as np
from demo_testing import SOURCE

sys.path[:0] = [os.path.join(SOURCE, "Examples"), os.path.join(SOURCE, "Documentation", "scripts")]
import animation  # noqa: E402
import before_after  # noqa: E402
import lecture  # noqa: E402

pairs = before_after.main(".", (120, 64))
with open(os.path.join(SOURCE, "Documentation", "before_after.md"), encoding="utf-8") as file:
    page = file.read()
for name, (left, right) in pairs.items():
    change = np.abs(left.astype(float) - right).max()
    print(f"{name}: {change:.1f} levels")
    assert change > 20, f"{name} changes nothing"
    assert os.path.getsize(f"pair_{name.lower()}.jpg") > 500
    assert f"images/pair_{name.lower()}.jpg" in page, f"The page lacks {name}"
assert page.count("images/pair_") == len(pairs)

knife, sensitivity, shadow, fringes, stops = ([image.astype(float) for image in row] for row in lecture.main(".", (76, 40)))
# An edge from the other side is the negative, where neither is black or white.
level, other = knife[1], knife[2]
inner = (level > 2) & (level < 253) & (other > 2) & (other < 253)
assert np.abs(level + other - 255)[inner].max() < 4
spread = [image.std() for image in sensitivity]
assert spread[0] < spread[1] < spread[2], spread
spread = [image.std() for image in shadow]
assert spread[0] < spread[1] < spread[2], spread
assert np.ptp(fringes[2], axis=2).max() > 60 and np.ptp(fringes[0], axis=2).max() == 0
assert np.abs(stops[0] + stops[1] - 255).mean() < 4, "Dark field is the negative of the bright field"

# Light that is bent upwards passes an edge at 90 degrees: the knife covers the lower half.
frame = np.asarray(animation.with_knife(np.full((100, 120, 3), 128, np.uint8), 90))
below, above = frame[90 - 12, 120 - 36, 0], frame[90 - 40, 120 - 36, 0]
assert (above, below) == (255, 0), (above, below)
