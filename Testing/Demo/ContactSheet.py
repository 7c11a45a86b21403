# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The contact sheet: every tile is in its place and shows what its optics say."""

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
# Of a disc, an edge at the fraction t of its radius passes this, in place of (1 + t) / 2.
t = np.clip(2 * k * v, -1, 1)
disc = 0.5 + (t * np.sqrt(1 - t**2) + np.arcsin(t)) / np.pi
check_below("disc knife", rms((light("disc knife") - disc)[inner]), 0.03)
check_below("disc knife, against that of a point", rms((light("disc knife") - disc)[inner])
            / rms((light("knife 90") - disc)[inner]), 0.5)

# Colours: the hue is the direction.
color = shot("wheel")["Color"].astype(float)
strong = (round_k * size > 0.3) & (round_k * size < 0.9)
red, green, blue = np.moveaxis(color, -1, 0)
hue = np.arctan2(np.sqrt(3) * (green - blue), 2 * red - green - blue)
turn = np.angle(np.exp(1j * (hue - np.arctan2(v, u))))
check_below("hue against direction, rad", float(np.median(np.abs(turn[strong]))), 0.06)
for sign, of in ((1, "up"), (-1, "down")):
    assert (strong & (sign * v > np.abs(u))).sum() > 50, f"Nothing is deflected {of}"
color = shot("color filter")["Color"].astype(float)
for name, where, expected in (("right", u > 2 * abs(v), (230, 40, 30)),
                              ("up", v > 2 * abs(u), (40, 200, 60)),
                              ("left", u < -2 * abs(v), (40, 90, 255)),
                              ("down", v < -2 * abs(u), (250, 210, 30))):
    found = np.median(color[where & strong], axis=0)
    check_below(f"colour of light deflected {name}", np.abs(found - expected).max(), 40)
found = np.median(color[round_k * size < 0.05], axis=0)
check_below("colour of undisturbed light", np.abs(found - 60).max(), 10)

# The histogram counts all rays, where they are deflected to.
rays = shot("histogram")["Rays"].astype(float)
facts = shot("knife 0").facts
check_below("rays missing in the histogram", abs(rays.sum() / (WIDTH * HEIGHT * 4) - 1), 0.02)
check_below("its asymmetry, up against down", abs(rays - rays[::-1]).sum() / rays.sum(), 0.1)

# Light is moved, not made. It lands where deflections say.
for tile in tiles.values():
    facts = tile.shot.facts if tile.shot else {}
    if "LightEmitted" in facts:
        lost = facts["LightEmitted"] - facts["LightOnFilm"] - facts["LightOutside"]
        assert abs(lost) < 1e-6 * facts["LightEmitted"], (tile.name, lost)
for name in ("near", "far", "straight", "refracted", "one", "smoothed", "many"):
    check_below(f"light of '{name}' - 1", abs(light(name)[inner].mean() - 1), 0.02)
expected = np.zeros((HEIGHT, WIDTH))
distance = contact_sheet.caustic_distance(eps, frame.pixel) / 8
shift = (shot("knife 0")["Displacement"][..., :2] + distance * eps) / frame.pixel
FINE = 5  # rays along each side of a pixel
for i, j in np.ndindex(FINE, FINE):  # all rays at this place of their pixels
    row, column = i / FINE, j / FINE
    moved = ((1 - row) * (1 - column) * shift[:-1, :-1] + (1 - row) * column * shift[:-1, 1:]
             + row * (1 - column) * shift[1:, :-1] + row * column * shift[1:, 1:])
    y, x = np.mgrid[:HEIGHT - 1, :WIDTH - 1] + np.array([row, column])[:, None, None]
    y, x = np.clip(y + moved[..., 1], 0, HEIGHT - 1.001), np.clip(x + moved[..., 0], 0, WIDTH - 1.001)
    for low, left in np.ndindex(2, 2):
        fraction = (np.abs(1 - low - y % 1) * np.abs(1 - left - x % 1)).ravel() / FINE**2
        np.add.at(expected, ((y.astype(int) + low).ravel(), (x.astype(int) + left).ravel()), fraction)
correlation = np.corrcoef(expected[inner].ravel(), light("near")[inner].ravel())[0, 1]
print(f"near: correlation with rays drawn by their deflections {correlation:.3f}")
assert correlation > 0.9
assert light("far").std() > 2 * light("near").std()
check_below("contrast with a round source", light("disc").std() / light("far").std(), 0.6)

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
pattern = shot("pattern")["Background"].astype(float)
y, x = np.mgrid[:HEIGHT, :WIDTH] + np.moveaxis(moved[..., ::-1] / frame.pixel, -1, 0)
y, x = np.clip(y, 0, HEIGHT - 1.001), np.clip(x, 0, WIDTH - 1.001)
row, column = y.astype(int), x.astype(int)
expected = sum(np.abs(1 - i - y % 1) * np.abs(1 - j - x % 1) * pattern[row + i, column + j]
               for i, j in np.ndindex(2, 2))
change = sum(np.hypot(*np.gradient(moved[..., axis])) for axis in (0, 1)) / frame.pixel
slow = change < 0.5
slow &= (np.abs(y - HEIGHT / 2) < HEIGHT / 2 - 2) & (np.abs(x - WIDTH / 2) < WIDTH / 2 - 2)
print(f"In {slow.mean():.0%} of the image the shift varies little")
assert slow.mean() > 0.4
check_below("the pattern, where the flow shows it", rms((light("seen") - expected)[slow])
            / rms((pattern - light("seen"))[slow]), 0.25)

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
