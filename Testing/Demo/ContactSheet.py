# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The contact sheet: every tile is in its place, and shows what its optics say; what these do in detail, the tracer's tests
show."""

import os
import sys

import numpy as np
from demo_testing import DATA, SOURCE, image_array

sys.path.insert(0, os.path.join(SOURCE, "Examples"))

import contact_sheet  # noqa: E402
from sheet import grey  # noqa: E402

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


def shot(name):
    return tiles[name].shot


def light(name):
    return shot(name)["Intensity"].astype(float)


def rms(values):
    return float(np.sqrt(np.mean(np.square(values))))


def check_below(what, value, limit):
    print(f"{what}: {value:.3g}, below {limit:g}")
    assert value < limit, what


# Rays leave the film's edge or come from beyond it: not there.
inner = np.s_[6:-6, 6:-6]
eps = shot("knife 0")["Deflection"][..., :2].astype(float)
u, v = eps[..., 0], eps[..., 1]
size = np.hypot(u, v)
k, round_k = shot("knife 0").facts["KScale"], shot("circular").facts["KScale"]

# Each stop's formula, at the deflection in the middle of a pixel. What differs is how that varies in the
# pixel, and that rays land a little beside where they start.
for name, expected in (
        ("knife 0", 0.5 + k * u), ("knife 90", 0.5 + k * v),
        ("knife 45", 0.5 + k * (u + v) / np.sqrt(2)), ("offset", 0.25 + k * v),
        ("circular", 1 - round_k * size), ("complement", round_k * size),
        ("graded", np.interp(0.5 + k * v, (0.35, 0.4, 0.6, 0.65), (0.1, 1, 1, 0.4)))):
    check_below(name, rms((light(name) - np.clip(expected, 0, 1))[inner]), 0.05)
# Whatever the film does with the rays: what one stop takes the other passes.
both = light("knife 90") + light("inverted")
check_below("circular + complement", np.abs(light("circular") + light("complement") - both).max(), 1e-4)
check_below("all light, knife edge", abs(both[inner].mean() - 1), 1e-3)
# Light is moved, not made. It lands where deflections say.
for tile in tiles.values():
    facts = tile.shot.facts if tile.shot else {}
    if "LightEmitted" in facts:
        lost = facts["LightEmitted"] - facts["LightOnFilm"] - facts["LightOutside"]
        assert abs(lost) < 1e-6 * facts["LightEmitted"], (tile.name, lost)
for name in ("near", "far", "straight", "refracted", "one", "smoothed", "many"):
    check_below(f"light of '{name}' - 1", abs(light(name)[inner].mean() - 1), 0.02)
# Fringes, at the optical path differences.
paths = shot("knife 0")["OpticalPathDifference"]
phase = 2 * np.pi * paths / 632.8e-9
smooth = np.hypot(*np.gradient(phase)) < 1
check_below("infinite", rms((light("infinite") - (1 + np.cos(phase)) / 2)[smooth]), 0.05)
y = (np.arange(HEIGHT)[:, None] - (HEIGHT - 1) / 2) * 2 * np.pi * 16 / HEIGHT
x = (np.arange(WIDTH)[None, :] - (WIDTH - 1) / 2) * 2 * np.pi * 16 / HEIGHT
for name, carrier in (("finite", y), ("upright", x)):
    fits = [rms((light(name) - (1 + np.cos(phase + sign * (carrier + shift))) / 2)[smooth])
            for sign in (1, -1) for shift in np.linspace(0, 2 * np.pi, 64, endpoint=False)]
    check_below(f"{name}: 16 fringes on the height", min(fits), 0.08)
assert light("violet")[np.abs(phase) < 0.2].mean() > 0.9  # the zeroth fringe is that of any wavelength

# Behind the flow, another place is seen: as far away as its distance times the deflection.
away = 8 * frame.pixel / np.percentile(size, 99)
moved = shot("shift")["BackgroundDisplacement"][..., :2].astype(float)
check_below("displacement against distance x deflection",
            rms((moved - away * eps)[inner]) / rms(away * eps), 0.1)

# The line of sight is near the truth here, but is not it.
difference = light("refracted") - light("straight")
check_below("refracted - straight", rms(difference[inner]), 0.2)
assert rms(difference[inner]) > 1e-3

# One ray per pixel is near to many, and a smoothed image is not.
errors = {name: rms((light(name) - light("many"))[inner]) for name in ("one", "smoothed")}
print("Against 64 rays per pixel:", errors)
assert errors["one"] < 0.5 * errors["smoothed"]
assert light("smoothed").std() < light("one").std()
shown = grey(0.5 + paths / (2 * np.abs(paths).max()), 1)
assert np.array_equal(tiles["path"].pixels, shown)
