#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""How well the points in a pixel at which rays start cover edges, and a search for them.

    python3 Testing/Benchmarks/PixelPoints.py [steps]

Prints what is wrong with the light of a half-plane on a pixel, splatted bilinearly by rays from the first 2, 4 ... 64 points
of pixelOffset (CudaCore/Rays/Light.cxx), of R2 and of Sobol's sequence: the root of the mean square over all angles
and distances, the largest one of an angle, and that along the axes.
With `steps`, searches for rows: 4 points of a rotated grid; each doubling puts points at the odd places of a grid that is
twice as fine, of which pairs of rows are exchanged so many times, by simulated annealing. Needs NumPy.
"""

import os
import re
import sys

import numpy as np

GRID = 64
ANGLES = 48
COUNTS = (2, 4, 8, 16, 32, 64)
LIGHT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "CudaCore", "Rays", "Light.cxx")


def half_planes(distances=53, farthest=1.45):
    """Normals and distances from the pixel's centre."""
    angles, places = np.meshgrid(np.arange(ANGLES) * np.pi / ANGLES,
                                 farthest * (2 * (np.arange(distances) + 0.5) / distances - 1), indexing="ij")
    return np.cos(angles).ravel(), np.sin(angles).ravel(), places.ravel()


def light(points, planes):
    """Of each point and half-plane: what the rays give to the pixel that start there in all pixels."""
    sums = np.zeros((len(points), len(planes[0])))
    for near in range(9):
        x, y = points[:, 0] + near % 3 - 1, points[:, 1] + near // 3 - 1
        weights = np.maximum(0, 1 - abs(x)) * np.maximum(0, 1 - abs(y))
        sums += weights[:, None] * (x[:, None] * planes[0] + y[:, None] * planes[1] > planes[2])
    return sums


def by_angle(differences):
    return np.sqrt((differences.reshape(ANGLES, -1)**2).mean(1))


def reversed_digits(number, digits):
    return int(f"{number:0{digits}b}"[::-1], 2)


def with_columns(rows):
    """Points of a pixel, in 1 / len(rows) of it."""
    digits = len(rows).bit_length() - 1
    return [(reversed_digits(n, digits), row) for n, row in enumerate(rows)]


def sequences():
    with open(LIGHT, encoding="utf-8") as file:
        rows = re.search(r"firstRows\{([^}]*)\}", file.read()).group(1)
    yield "pixelOffset", np.array(with_columns([int(row) for row in rows.split(",")])) / GRID
    plastic = 1.32471795724474602596
    yield "R2", np.arange(GRID)[:, None] / np.array([plastic, plastic**2])
    sobol = []
    for n in range(GRID):
        row, column = 0, GRID // 2
        for digit in range(6):
            row ^= column * (n >> digit & 1)
            column ^= column >> 1
        sobol.append(row)
    yield "Sobol", np.array(with_columns(sobol)) / GRID


def centred(points):
    return (points + 0.5) % 1 - 0.5


def doubled(points, table, steps, random):
    """Points on a grid n, twice as many on the grid 2 n: the new ones are at odd places."""
    old = [(2 * column, 2 * row) for column, row in points]
    count = len(points)
    size = GRID // (2 * count)

    def light_at(places):
        columns, rows = np.array(places).T
        return table[columns * size, rows * size].sum(0)

    def cost(total):
        squares = by_angle(total / (2 * count))**2
        return 1.5 * np.log(squares.mean()) + 0.7 * np.log(squares.max())

    rows = 2 * random.permutation(count) + 1
    total = light_at(old) + light_at([(2 * n + 1, row) for n, row in enumerate(rows)])
    now = cost(total)
    best = now, rows.copy()
    for step in range(steps):
        a, b = random.choice(count, 2, replace=False)
        columns = 2 * a + 1, 2 * b + 1
        other = total - light_at(list(zip(columns, (rows[a], rows[b])))) + light_at(list(zip(columns, (rows[b], rows[a]))))
        then = cost(other)
        if then < now or random.random() < np.exp((now - then) / (0.1 * (1 - step / steps)**3 + 1e-5)):
            now, total = then, other
            rows[[a, b]] = rows[[b, a]]
            if now < best[0]:
                best = now, rows.copy()
    return old + [(2 * n + 1, int(row)) for n, row in enumerate(best[1])]


def main():
    planes = half_planes()
    fine = (np.arange(256) + 0.5) / 256 - 0.5
    truth = np.mean([light(np.stack([np.full(256, x), fine], 1), planes).mean(0) for x in fine], 0)
    print("| points | " + " | ".join(f"{count} rays" for count in COUNTS) + " |\n" + "|---" * (len(COUNTS) + 1) + "|")
    for name, points in sequences():
        values = light(centred(points), planes)
        cells = []
        for count in COUNTS:
            errors = by_angle(values[:count].mean(0) - truth)
            axes = max(errors[0], errors[ANGLES // 2])
            cells.append(f"{np.sqrt((errors**2).mean()):.4f}, {errors.max():.4f}, {axes:.4f}")
        print(f"| {name} | " + " | ".join(cells) + " |", flush=True)
    if len(sys.argv) > 1:
        places = centred(np.stack(np.meshgrid(*2 * [np.arange(GRID) / GRID], indexing="ij"), -1).reshape(-1, 2))
        table = (light(places, planes) - truth).reshape(GRID, GRID, -1)
        points = [(0, 0), (1, 2), (2, 1), (3, 3)]
        random = np.random.default_rng(1)
        while len(points) < GRID:
            points = doubled(points, table, int(sys.argv[1]), random)
        rows = dict(points)
        print(*(rows[reversed_digits(n, 6)] for n in range(GRID)), sep=", ")


if __name__ == "__main__":
    main()
