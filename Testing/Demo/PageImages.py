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
import figures  # noqa: E402
import lecture  # noqa: E402



def tiles(sheet, columns, rows):
    """The four images of a sheet of figures.sheet_of()."""
    return [sheet[top + 22:top + 22 + rows, left:left + columns].astype(float)
            for top in (0, rows + 24) for left in (0, columns + 8)]


# Other flows than the jet are meshes, whose voxels take long.
of_jet = [name for name, *_, others in before_after.PAIRS if "Input" not in others]
pairs = before_after.main(".", (120, 64), of_jet, "Interactive")
with open(os.path.join(SOURCE, "Documentation", "before_after.md"), encoding="utf-8") as file:
    page = file.read()
for name, (left, right) in pairs.items():
    change = np.abs(left.astype(float) - right).max()
    print(f"{name}: {change:.1f} levels")
    assert change > 20, f"{name} changes nothing"
    assert os.path.getsize(f"pair_{name.lower()}.jpg") > 500
assert len(pairs) > 15
for name, *_ in before_after.PAIRS:
    assert f"images/pair_{name.lower()}.jpg" in page, f"The page lacks {name}"
assert page.count("images/pair_") == len(before_after.PAIRS)

knife, sensitivity, shadow, fringes, stops = ([image.astype(float) for image in row] for row in lecture.main(".", (76, 40)))
# An edge from the other side is the negative, where neither is black or white.
level, other = knife[1], knife[2]
inner = (level > 2) & (level < 253) & (other > 2) & (other < 253)
assert np.abs(level + other - 255)[inner].max() < 4
spread = [image.std() for image in sensitivity]
assert spread[0] < spread[1] < spread[2], spread
spread = [image.std() for image in shadow]
assert spread[0] < spread[1] < spread[2], spread
# Beside the jet, fringes are along the rows, or upright.
level, upright = fringes[1], fringes[2]
assert np.ptp(level[:, 0], axis=0).min() > 100 > np.ptp(level[0], axis=0).max(), "Not along the rows"
assert np.ptp(upright[0], axis=0).min() > 100 > np.ptp(upright[:, 0], axis=0).max(), "Not upright"
assert np.abs(stops[0] + stops[1] - 255).mean() < 4, "Dark field is the negative of the bright field"

# Shadows are stronger on a far screen, where waves differ from rays; and a lens blurs what is out of focus.
near, near_waves, far, far_waves = tiles(figures.waves((64, 36)), 64, 36)
assert far.std() > 3 * near.std() and far_waves.std() > 3 * near_waves.std()
assert np.abs(far - far_waves).max() > 2 * np.abs(near - near_waves).max() > 0
pinhole, lens = (np.abs(np.diff(tile, axis=1)).max() for tile in tiles(figures.camera((64, 36)), 64, 36)[2:])
assert pinhole > 1.5 * lens, (pinhole, lens)

# Light that is bent upwards passes an edge at 90 degrees: the knife covers the lower half.
frame = np.asarray(animation.with_knife(np.full((100, 120, 3), 128, np.uint8), 90))
below, above = frame[90 - 12, 120 - 36, 0], frame[90 - 40, 120 - 36, 0]
assert (above, below) == (255, 0), (above, below)
