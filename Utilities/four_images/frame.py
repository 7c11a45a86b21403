# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The view that all four images share."""

import math

import numpy as np

from arguments import VIEWS, DemoError


class Frame:
    """An orthographic view, and how many pixels show it."""

    def __init__(self, bounds, options):
        low, high = np.array(bounds[0::2]), np.array(bounds[1::2])
        extent = high - low
        if extent.min() <= 1e-9 * extent.max():
            raise DemoError(f"'{options.file}' has no thickness along "
                            f"{'xyz'[int(extent.argmin())]}: light needs a volume to pass through, or a plane "
                            "across an axis.")
        direction, up = options.view or VIEWS["z"]
        self.direction = np.array(direction, dtype=float)
        up = np.array(up, dtype=float)
        self.u = np.cross(self.direction, up)
        self.u /= np.linalg.norm(self.u)
        self.v = np.cross(self.u, self.direction)
        self.up = up
        self.center = np.array(options.center) if options.center else (low + high) / 2
        width, height = (np.abs(axis) @ extent for axis in (self.u, self.v))
        self.depth = np.abs(self.direction) @ extent
        if options.size:
            self.width, self.height = options.size
        else:
            pixel = max(width / options.largest[0], height / options.largest[1])
            self.width, self.height = (max(160, math.ceil(side / pixel))
                                       for side in (width, height))
        self.scale = options.half_height or max(height, width * self.height / self.width) / 2
        self.pixel = 2 * self.scale / self.height
        # How much of the image the data's box covers (all of it, where it reaches beyond).
        faces = extent[[1, 2, 0]] * extent[[2, 0, 1]]
        self.shadow = min(np.abs(self.direction) @ faces,
                          self.width * self.height * self.pixel ** 2)
        # Image coordinates of the left, right, bottom and top edges.
        middle = np.array([self.center @ self.u, self.center @ self.v])
        half = np.array([self.width, self.height]) * self.pixel / 2
        (self.left, self.bottom), (self.right, self.top) = middle - half, middle + half
