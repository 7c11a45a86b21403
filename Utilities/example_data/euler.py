# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The Euler equations of gases in a plane or around the x axis: finite volumes of second order on a curvilinear grid.

HLLC fluxes (E. F. Toro 2009, ch. 10), van Leer's slopes, two stages of Runge and Kutta. Arrays hold the density (kg/m^3), the
velocity along x and y (m/s), the pressure (Pa), and of two gases the mass fraction of the second and 1 / (gamma - 1): [4 or 6,
i, j]. The latter is carried along as E. Johnsen and T. Colonius 2006 (J. Comput. Phys. 219, 715) do, so that the pressure does
not oscillate where gases meet.
"""

import numpy as np

GHOSTS = 2


class Grid:
    """Cells between nodes (i, j), where i, j and the viewer's direction are right-handed."""

    def __init__(self, x, y, axisymmetric=False):
        self.x, self.y = x, y
        centres = [(values[1:, 1:] + values[:-1, 1:] + values[1:, :-1] + values[:-1, :-1]) / 4 for values in (x, y)]
        self.centres = np.stack(centres)
        # The faces' normals, as long as the faces, towards larger i and larger j.
        along_j, along_i = [np.stack([np.diff(values, axis=axis) for values in (x, y)]) for axis in (1, 0)]
        self.normals = [np.stack([along_j[1], -along_j[0]]), np.stack([-along_i[1], along_i[0]])]
        diagonals = [np.stack([values[1:, 1:] - values[:-1, :-1], values[:-1, 1:] - values[1:, :-1]]) for values in (x, y)]
        self.areas = (diagonals[0][0] * diagonals[1][1] - diagonals[0][1] * diagonals[1][0]) / 2
        self.volumes = self.areas
        self.axisymmetric = axisymmetric
        if axisymmetric:  # of one radian
            self.normals = [normal * (y.take(range(1, y.shape[1 - axis]), 1 - axis)
                                      + y.take(range(y.shape[1 - axis] - 1), 1 - axis)) / 2
                            for axis, normal in enumerate(self.normals)]
            self.volumes = self.areas * centres[1]


def inverse(state, gamma):
    """1 / (gamma - 1)."""
    return state[5] if len(state) > 4 else 1 / (gamma - 1)


def sound(state, gamma):
    return np.sqrt((1 + 1 / inverse(state, gamma)) * state[3] / state[0])


def conserved(state, gamma):
    energy = state[3] * inverse(state, gamma) + state[0] * (state[1]**2 + state[2]**2) / 2
    more = [state[0] * state[4], state[5]] if len(state) > 4 else []
    return np.stack([state[0], state[0] * state[1], state[0] * state[2], energy] + more)


def primitive(totals, gamma):
    u, v = totals[1:3] / totals[0]
    more = [totals[4] / totals[0], totals[5]] if len(totals) > 4 else []
    pressure = (totals[3] - totals[0] * (u**2 + v**2) / 2) / inverse(totals, gamma)
    return np.stack([totals[0], u, v, pressure] + more)


def flux(left, right, normal, gamma, contact=True):
    """Through faces, per second, and the volume that passes them. Without `contact` that of HLL, which keeps strong shocks along
    the grid's lines straight."""
    length = np.hypot(*normal)
    nx, ny = normal / np.maximum(length, 1e-300)
    states = left, right
    through = [state[1] * nx + state[2] * ny for state in states]
    sounds = [sound(state, gamma) for state in states]
    slowest = np.minimum(through[0] - sounds[0], through[1] - sounds[1])
    fastest = np.maximum(through[0] + sounds[0], through[1] + sounds[1])
    waves = slowest, fastest
    masses = [state[0] * (wave - speed) for state, wave, speed in zip(states, waves, through)]
    middle = ((right[3] - left[3] + through[0] * masses[0] - through[1] * masses[1]) / (masses[0] - masses[1]))
    totals, own = [], []
    for state, speed in zip(states, through):
        amount = conserved(state, gamma)
        passing = amount * speed
        passing[1] += state[3] * nx
        passing[2] += state[3] * ny
        passing[3] += state[3] * speed
        totals.append(amount)
        own.append(passing)
    if not contact:
        low, high = np.minimum(slowest, 0), np.maximum(fastest, 0)
        return (high * own[0] - low * own[1] + low * high * (totals[1] - totals[0])) / (high - low) * length, None
    result, volume = 0, 0
    for state, speed, wave, mass, amount, passing, is_here in zip(
            states, through, waves, masses, totals, own, (middle >= 0, middle < 0)):
        beside = amount * ((wave - speed) / (wave - middle))
        density = mass / (wave - middle)
        beside[1] += density * (middle - speed) * nx
        beside[2] += density * (middle - speed) * ny
        beside[3] += density * (middle - speed) * (middle + state[3] / mass)
        is_outside = wave >= 0 if state is left else wave <= 0
        passes = np.where(is_outside, speed, speed + wave * ((wave - speed) / (wave - middle) - 1))
        result = result + np.where(is_here, np.where(is_outside, passing, passing + wave * (beside - amount)), 0)
        volume = volume + np.where(is_here, passes, 0)
    return result * length, volume * length


def change(state, grid, surround, gamma, contact):
    """What the totals in each cell change by, per second. `surround`: adds ghost cells along an axis."""
    result = 0
    for axis in (0, 1):
        line = np.moveaxis(surround(state, axis), 1 + axis, -1)
        ahead, behind = line[..., 2:] - line[..., 1:-1], line[..., 1:-1] - line[..., :-2]
        product = ahead * behind
        slope = np.where(product > 0, 2 * product / np.where(product > 0, ahead + behind, 1), 0)
        middle = line[..., 1:-1]
        normal = np.moveaxis(grid.normals[axis], 1 + axis, -1)
        passing, volume = flux((middle + slope / 2)[..., :-1], (middle - slope / 2)[..., 1:], normal, gamma, contact)
        gain = -np.diff(passing, axis=-1)
        if len(state) > 4:
            gain[5] += np.diff(volume, axis=-1) * line[5, :, GHOSTS:-GHOSTS]
        result = result + np.moveaxis(gain, -1, 1 + axis)
    if grid.axisymmetric:
        result[2] += state[3] * grid.areas
    return result / grid.volumes


def steps_of(state, grid, gamma, courant):
    """Seconds that each cell may take."""
    speed = 0
    for axis in (0, 1):
        normal = np.moveaxis(grid.normals[axis], 1 + axis, -1)
        normal = np.moveaxis((normal[..., 1:] + normal[..., :-1]) / 2, -1, 1 + axis)
        speed = speed + np.abs(state[1] * normal[0] + state[2] * normal[1]) + sound(state, gamma) * np.hypot(*normal)
    return courant * grid.volumes / speed


def advance(state, grid, surround, seconds, gamma=1.4, contact=True):
    """A step of time; `seconds`: one, or one for each cell on the way to a steady flow."""
    before = conserved(state, gamma)
    first = primitive(before + seconds * change(state, grid, surround, gamma, contact), gamma)
    second = conserved(first, gamma) + seconds * change(first, grid, surround, gamma, contact)
    return primitive((before + second) / 2, gamma)


def mirrored(state, normal):
    """As seen in a wall."""
    seen = state.copy()
    n = normal / np.hypot(*normal)
    speed = state[1] * n[0] + state[2] * n[1]
    seen[1] -= 2 * speed * n[0]
    seen[2] -= 2 * speed * n[1]
    return seen
