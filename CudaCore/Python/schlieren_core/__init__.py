# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Schlieren images of arrays of numpy, without ParaView and VTK.

    import schlieren_core
    image = schlieren_core.render(density=rho, spacing=0.001, gas="air", technique="Shadowgraph")
    image.save("x.png")

techniques and gases list the names; render() explains the rest. Images are traced on the CPU.
"""

import ctypes
import os
import struct
import zlib

import numpy as np

_library = ctypes.CDLL(os.environ.get("SCHLIEREN_CORE_LIBRARY")
                       or os.path.join(os.path.dirname(os.path.abspath(__file__)), "libschlieren_core.so"))
_library.schlieren_constant.restype = ctypes.c_double
for _function in (_library.schlieren_name, _library.schlieren_version, _library.schlieren_render):
    _function.restype = ctypes.c_char_p


def _names(kind):
    name = iter(range(1000))
    return tuple(text.decode() for text in iter(lambda: _library.schlieren_name(kind, next(name)), None))


__version__ = _library.schlieren_version().decode()
gases = _names(0)
techniques = _names(1)


class _Request(ctypes.Structure):
    """As Request in Interface.cxx."""

    _fields_ = ([("points", ctypes.c_int64 * 3), ("origin", ctypes.c_double * 3), ("spacing", ctypes.c_double * 3),
                 ("samples", ctypes.c_void_p), ("view_direction", ctypes.c_double * 3), ("view_up", ctypes.c_double * 3)]
                + [(name, ctypes.c_double) for name in ("parallel_scale", "knife_edge_angle", "k", "wavelength",
                                                        "screen_distance", "fringe_spacing", "fringe_angle", "ambient")]
                + [("technique", ctypes.c_int32), ("size", ctypes.c_int32 * 2), ("rays_per_pixel", ctypes.c_int32),
                   ("threads", ctypes.c_int32)])


class _Result(ctypes.Structure):
    """As Result in Interface.cxx."""

    _fields_ = ([(name, ctypes.c_void_p) for name in ("intensity", "color", "deflection", "path")]
                + [(name, ctypes.c_double) for name in ("k", "screen_distance", "undisturbed")]
                + [("has_color", ctypes.c_int32)])


class Image:
    """What render() returns. Arrays have a row of the image as a row, the bottom one first.

    intensity (rows, columns): light; undisturbed says what nothing bends. color (rows, columns, 3), linear, or None.
    deflection (rows, columns, 2): direction cosines along the image's right and up. path (rows, columns): optical path
    difference, metres. k: sensitivity, 1/rad, and screen_distance, metres; 0 where the technique has none.
    """

    def png(self):
        """The image as the bytes of a PNG file: grey, or colour; 0 is black, twice undisturbed light or 1 is white."""
        light = self.intensity / max(1, 2 * self.undisturbed) if self.technique == "Shadowgraph" else self.intensity
        if self.color is not None:
            linear = np.clip(self.color, 0, 1)  # to sRGB, IEC 61966-2-1
            light = np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear**(1 / 2.4) - 0.055)
        bytes_of = np.rint(255 * np.clip(light[::-1], 0, 1)).astype(np.uint8)
        rows = b"".join(b"\0" + row.tobytes() for row in bytes_of)
        header = struct.pack(">IIBBBBB", bytes_of.shape[1], bytes_of.shape[0], 8, 2 if light.ndim == 3 else 0, 0, 0, 0)
        chunks = ((b"IHDR", header), (b"IDAT", zlib.compress(rows)), (b"IEND", b""))
        return b"\x89PNG\r\n\x1a\n" + b"".join(struct.pack(">I", len(data)) + name + data
                                               + struct.pack(">I", zlib.crc32(name + data)) for name, data in chunks)

    _repr_png_ = png  # by which notebooks show it

    def save(self, name):
        """Writes a PNG file."""
        with open(name, "wb") as file:
            file.write(self.png())


def render(density=None, *, refractivity=None, spacing, origin=(0, 0, 0), gas="air", wavelength=632.8,
           technique="Knife Edge", knife_edge_angle=90, k=None, screen_distance=None, fringe_spacing=0, fringe_angle=0,
           view_direction=(0, 0, -1), view_up=(0, 1, 0), parallel_scale=0, ambient=None, size=(512, 512),
           rays_per_pixel=4, threads=0):
    """Makes an Image of a flow on a regular grid. Lengths are in metres, angles in degrees.

    density: array (nz, ny, nx), kg/m^3, of the gas, one of gases or its formula. Or refractivity: n - 1 itself. Where it is not
    finite, there is a body.
    spacing, origin: of the points, along x, y, z; spacing may be one number.
    wavelength: nanometres, in vacuum.
    technique: one of techniques. knife_edge_angle: 0 measures the deflection to the right, 90 upwards. k: 1/rad; None: the
    99th percentile of the deflections is full scale. screen_distance: None: so far away that the flow is seen.
    fringe_spacing: of finite fringes; 0: infinite ones.
    view_direction: of sight. parallel_scale: half the height of the image; 0: all of the data. size: columns and rows.
    ambient: n - 1 of the surroundings; None: that at the data's boundary.
    ValueError: what is wrong, and what to do.
    """
    if (density is None) == (refractivity is None):
        raise ValueError("Give either density, in kg/m^3, or refractivity, which is n - 1.")
    if technique not in techniques:
        raise ValueError(f"There is no technique '{technique}'. There are: {', '.join(techniques)}.")
    if refractivity is None:
        constant = _library.schlieren_constant(gas.encode(), ctypes.c_double(wavelength * 1e-9))
        if np.isnan(constant):
            raise ValueError(f"There is no gas '{gas}' at {wavelength} nm. There are: {', '.join(gases)}.")
        refractivity = constant * np.asarray(density, dtype=float)
    samples = np.ascontiguousarray(refractivity, dtype=float)
    if samples.ndim != 3:
        raise ValueError(f"The data have {samples.ndim} dimensions instead of 3: z, y, x.")
    if np.nanmax(samples, initial=0) > 10:
        raise ValueError(f"n - 1 reaches {np.nanmax(samples):.3g}, which no transparent medium has. Is it a density? Then "
                         "give it as density, in kg/m^3, and the gas.")
    columns, rows = size
    image = Image()
    image.technique = technique
    image.intensity = np.zeros((rows, columns), np.float32)
    image.color = np.zeros((rows, columns, 3), np.float32)
    image.deflection = np.zeros((rows, columns, 2), np.float32)
    image.path = np.zeros((rows, columns))
    request = _Request(points=samples.shape[::-1], origin=tuple(origin), spacing=tuple(np.broadcast_to(spacing, 3)),
                       samples=samples.ctypes.data, view_direction=tuple(view_direction), view_up=tuple(view_up),
                       parallel_scale=parallel_scale, knife_edge_angle=knife_edge_angle, k=np.nan if k is None else k,
                       wavelength=wavelength * 1e-9, fringe_spacing=fringe_spacing, fringe_angle=fringe_angle,
                       screen_distance=np.nan if screen_distance is None else screen_distance,
                       ambient=np.nan if ambient is None else ambient, technique=techniques.index(technique),
                       size=(columns, rows), rays_per_pixel=rays_per_pixel, threads=threads)
    result = _Result(*(array.ctypes.data for array in (image.intensity, image.color, image.deflection, image.path)))
    if mistake := _library.schlieren_render(ctypes.byref(request), ctypes.byref(result)):
        raise ValueError(mistake.decode())
    image.k, image.screen_distance, image.undisturbed = result.k, result.screen_distance, result.undisturbed
    if not result.has_color:
        image.color = None
    return image
