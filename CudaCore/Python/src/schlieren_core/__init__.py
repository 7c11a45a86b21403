# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Schlieren images of a refractivity on a regular grid, by light rays; arrays of NumPy go in and come out.

    import schlieren_core
    image = schlieren_core.trace(refractivity, spacing=(1e-3, 1e-3, 1e-3))
    image["intensity"], image["deflection"]
"""

import numpy as np

from ._tracer import Error, trace as _trace, version

__version__ = version()
__all__ = ["Error", "trace"]


def _numbers(name, values, kind=float, meaning=("x", "y", "z")):
    try:
        numbers = [kind(value) for value in values]
    except (TypeError, ValueError):
        numbers = []
    if len(numbers) != len(meaning):
        raise Error(f"{name} is {values!r}. Give {len(meaning)} numbers: {', '.join(meaning)}.")
    return numbers


def trace(refractivity, spacing, *, origin=(0, 0, 0), ambient=None, length_scale=1.0, view_direction=(0, 0, -1),
          view_up=(0, 1, 0), focal_point=None, parallel_scale=0.0, size=(512, 512), cutoff="knife edge",
          knife_edge_angle=0.0, k=None, screen_distance=None, wavelength=632.8e-9, path="refracted", interpolation="cubic",
          precision="single", step_size=1.0, samples_per_pixel=4, threads=0):
    """Traces parallel light through n - 1 and returns the image of a bench.

    refractivity: n - 1, shape (z, y, x), at least 2 points along each axis; single precision is taken as it is, all else as
        double. NaN is a solid, which blocks light.
    spacing, origin: distance of points and place of the first one, (x, y, z), data units.
    ambient: n - 1 around the data; None: the median over the grid's faces.
    length_scale: metres in a data unit.
    view_direction, view_up: along the light, and up in the image, (x, y, z).
    focal_point: in the image's middle, data units; None: the grid's centre.
    parallel_scale: half height of the image, data units; 0: all of the grid is seen.
    size: columns, rows.
    cutoff: "knife edge" (light 1/2 + k deflection), "shadowgraph", "circular" (1 - k |deflection|), "dark field"
        (k |deflection|), "color filter" (a wheel of hues) or "interferogram".
    knife_edge_angle: degrees; 0 shows deflections along the image's right, 90 upwards.
    k: sensitivity, 1/rad; None: from the deflections.
    screen_distance: of a shadowgraph, behind the grid, data units; None: one depth of the grid.
    wavelength: of an interferogram, metres.
    path: "refracted" rays, or "straight" ones: lines of sight.
    interpolation: "quadratic" or "cubic" between the points. precision: "single" or "double".
    step_size: points of the grid. samples_per_pixel: rays. threads: 0: all cores that this process may use.

    Returns a dict. Arrays have the lowest row first:
        intensity (rows, columns): undisturbed light has 1/2 behind a knife edge, 1 in a shadowgraph
        color (rows, columns, 3): linear red, green and blue, else None
        deflection (rows, columns, 2): direction cosines along the image's right and up
        optical_path_difference (rows, columns): metres, against light through the surroundings
        displacement (rows, columns, 2): behind the grid, data units
        blocked_fraction (rows, columns): of the rays, by solids
    and numbers: origin (place of pixel 0, 0 in the image's plane) and pixel_size, data units; k and ambient as used;

    Raises Error, a ValueError, where a value cannot be used.
    """
    samples = np.asarray(refractivity)
    if samples.ndim != 3 or samples.dtype.kind not in "fiu":
        raise Error(f"refractivity has the shape {samples.shape} and holds {samples.dtype}. Give real numbers n - 1 with three "
                    "axes: z, y, x.")
    samples = np.ascontiguousarray(samples, np.float32 if samples.dtype == np.float32 else np.float64)
    focal_point = None if focal_point is None else _numbers("focal_point", focal_point)
    return _trace(samples, _numbers("spacing", spacing), _numbers("origin", origin), ambient, length_scale,
                  _numbers("view_direction", view_direction), _numbers("view_up", view_up), focal_point, parallel_scale,
                  _numbers("size", size, int, ("columns", "rows")), cutoff, knife_edge_angle, k, screen_distance, wavelength,
                  path, interpolation, precision, step_size, samples_per_pixel, threads)
