# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The contact sheet: every tile is in its place; what its optics do, the tracer's tests show."""

import os
import sys

import numpy as np
from demo_testing import DATA, SOURCE, image_array

sys.path.insert(0, os.path.join(SOURCE, "Examples"))

import contact_sheet  # noqa: E402

WIDTH, HEIGHT = 240, 129
path = os.path.abspath("sheet.png")
groups, frame = contact_sheet.main(contact_sheet.options_of([
    os.path.join(DATA, "ladenburg_jet_3d.vti"), "--size", f"{WIDTH}x{HEIGHT}", "--output", path]))
tiles = {tile.name: tile for _, row in groups for tile in row}
assert len(tiles) == sum(len(row) for _, row in groups) == 32
assert all(len(row) == contact_sheet.COLUMNS for _, row in groups)

# The file holds the tiles, pixel by pixel, and text above each.
sheet = image_array(path)
width, height, corner = contact_sheet.layout(frame, len(groups))
assert sheet.shape == (height, width, 3), sheet.shape
for j, (_, row) in enumerate(groups):
    for i, tile in enumerate(row):
        left, top = corner(j, i)
        assert np.array_equal(sheet[top:top + HEIGHT, left:left + WIDTH], tile.pixels[::-1]), tile.name
        assert sheet[top - 41:top - 25, left:left + WIDTH].min() < 110, f"{tile.name}: no title"
        assert tile.pixels.std() > 4, f"{tile.name}: blank"
