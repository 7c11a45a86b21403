# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""A pair of background-oriented images of a jet, as a camera records them, and what an evaluation finds in it: the loop
from a known displacement through the camera back to the displacement.

    pvpython Examples/bos_pair.py        (writes bos_with_flow.png and bos_without_flow.png)

Evaluated by least squares (Lucas & Kanade 1981), and by OpenPIV where it is installed. Debian has no package of it:

    python3 -m venv --system-site-packages piv && piv/bin/pip install openpiv
    PYTHONPATH=$(echo piv/lib/python3*/site-packages) pvpython Examples/bos_pair.py
"""

import os
import sys

import numpy as np
from paraview import servermanager
from paraview.simple import *
from vtkmodules.util.numpy_support import vtk_to_numpy

root = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
sys.path.insert(0, os.path.join(root, "Examples"))
from load_schlieren import load_schlieren  # noqa: E402

load_schlieren(globals())
noise = np.random.default_rng(1)


def take_pair(flow, **settings):
    """Both images and the displacement that rays have, in pixels: what is seen has moved by minus that. Arrays of rows,
    the lowest first."""
    bench = Schlieren(Input=flow, Cutoff="Background Oriented", **settings)
    bench.UpdatePipeline()
    image = servermanager.Fetch(bench)
    width, height, _ = image.GetDimensions()
    arrays = image.GetPointData()

    def array(name):
        values = vtk_to_numpy(arrays.GetArray(name)).astype(float)
        return values.reshape((height, width) + values.shape[1:])

    pair = [recorded(array(name)) for name in ("Background", "Intensity")]
    moved = array("BackgroundDisplacement")[..., :2] / image.GetFieldData().GetArray("PatternPixel").GetValue(0)
    Delete(bench)
    return pair[0], pair[1], moved


def recorded(light, full_well=30000, read_noise=10, bits=12, exposure=0.8):
    """What a scientific camera makes of light, with noise of the electrons and of reading them."""
    electrons = exposure * full_well * light
    read = noise.normal(electrons, np.sqrt(electrons + read_noise ** 2)) / full_well
    return np.floor((2 ** bits - 1) * np.clip(read, 0, 1) + 0.5)


def blurred(values, sigma):
    """A Gaussian along both axes, of an image that is reflected at its borders."""
    reach = int(4 * sigma + 0.5)
    kernel = np.exp(-0.5 * (np.arange(-reach, reach + 1) / sigma) ** 2)
    kernel /= kernel.sum()
    for axis in (0, 1):
        around = np.pad(values, [(reach, reach) if axis == a else (0, 0) for a in (0, 1)], mode="symmetric")
        values = np.apply_along_axis(np.convolve, axis, around, kernel, "valid")
    return values


def spline(values):
    """Coefficients of the cubic spline through an image (Unser et al. 1993)."""
    pole = np.sqrt(3) - 2
    for _ in (0, 1):
        c = 6 * values
        c[0] = sum(pole ** k * c[k] for k in range(min(30, len(c))))
        for k in range(1, len(c)):
            c[k] += pole * c[k - 1]
        c[-1] = pole / (pole * pole - 1) * (c[-1] + pole * c[-2])
        for k in range(len(c) - 2, -1, -1):
            c[k] = pole * (c[k + 1] - c[k])
        values = c.T
    return values


def seen(coefficients, moved):
    """An image where rays meet it: at each pixel's place plus `moved`."""
    rows, columns = coefficients.shape
    place = np.meshgrid(np.arange(rows, dtype=float), np.arange(columns, dtype=float), indexing="ij")
    whole, weights = [], []
    for axis, size in ((0, rows), (1, columns)):
        at = np.clip(place[axis] + moved[..., 1 - axis], 0, size - 1)
        first = np.floor(at).astype(int)
        t = at - first
        whole.append(first)
        weights.append(((1 - t) ** 3 / 6, 2 / 3 - t * t * (1 - t / 2), 2 / 3 - (1 - t) ** 2 * (1 + t) / 2, t ** 3 / 6))
    result = 0
    for j in range(4):
        row = np.clip(whole[0] + j - 1, 0, rows - 1)
        for i in range(4):
            column = np.clip(whole[1] + i - 1, 0, columns - 1)
            result = result + weights[0][j] * weights[1][i] * coefficients[row, column]
    return result


def least_squares(without, with_flow, sigma=6, rounds=8):
    """The displacement with which `with_flow` is `without`, pixels: windows are Gaussians, the image is warped in rounds."""
    moved = np.zeros(without.shape + (2,))
    coefficients = spline(without)
    for _ in range(rounds):
        warped = seen(coefficients, moved)
        up, right = np.gradient(0.5 * (warped + with_flow))
        off = with_flow - warped
        a, b, c = (blurred(x, sigma) for x in (right * right, right * up, up * up))
        p, q = blurred(right * off, sigma), blurred(up * off, sigma)
        size = a * c - b * b
        size += 1e-12 * size.max()
        moved = moved + np.stack([c * p - b * q, a * q - b * p], -1) / size[..., None]
        moved = np.stack([blurred(moved[..., axis], 1) for axis in (0, 1)], -1)
    return moved


def by_open_piv(without, with_flow, windows):
    """The same by OpenPIV, in passes with windows of so many pixels, and the windows' middles; None without OpenPIV."""
    try:
        from openpiv import windef
    except ImportError:
        return None
    settings = windef.PIVSettings()
    settings.windowsizes = windows
    settings.overlap = tuple(size // 2 for size in windows)
    settings.num_iterations = len(windows)
    settings.sig2noise_validate = settings.show_all_plots = settings.validation_first_pass = False
    settings.replace_vectors = settings.smoothn = False
    settings.deformation_method = "symmetric"
    settings.interpolation_order = 3
    a, b = without[::-1], with_flow[::-1]  # its first row is the highest
    x, y, u, v, _ = windef.first_pass(a, b, settings)
    u, v = (np.ma.masked_array(values, np.zeros(u.shape, bool)) for values in (u, v))
    for number in range(1, len(windows)):
        x, y, u, v, *_ = windef.multipass_img_deform(a, b, number, x, y, u, v, settings)
    # What is seen has moved by minus the displacement of rays.
    return -np.stack([np.asarray(u), -np.asarray(v)], -1)[::-1], x[0].astype(int), y[:, 0].astype(int)


def compared(found, truth):
    """Slope of what is found over the truth, and the error's root mean square, pixels."""
    return (found * truth).sum() / (truth ** 2).sum(), np.sqrt(((found - truth) ** 2).mean())


jet = OpenDataFile(os.path.join(root, "Testing", "Data", "ladenburg_jet_3d.vti"))
jet.UpdatePipeline()
size, half, border = 512, 0.004, 24  # pixels, m, pixels that windows reach over
pixel = 2 * half / size
pair = dict(
    Density=["POINTS", "rho"], FocalPoint=[0.006, 0, 0], ParallelScale=half, ImageSize=[size, size],
    BackgroundDistance=0.005, BackgroundPeriod=6 * pixel, Quality="Publication", SamplesPerPixel=16)

without, with_flow, truth = take_pair(jet, **pair)
print(f"displacement: up to {np.abs(truth).max():.2f} pixels, root mean square {np.sqrt((truth ** 2).mean()):.2f}")
inner = np.s_[border:-border, border:-border]
slope, error = compared(least_squares(without, with_flow)[inner], truth[inner])
print(f"least squares, windows of 6 pixels: slope {slope:.4f}, error {error:.4f} pixels")

for windows in ((32,), (32, 16), (32, 16, 16)):
    result = by_open_piv(without, with_flow, windows)
    if result is None:
        print("Evaluated by least squares alone: OpenPIV is not installed.")
        break
    found, columns, rows = result
    reach = windows[-1] // 2
    means = np.array([[truth[row - reach:row + reach, column - reach:column + reach].mean((0, 1)) for column in columns]
                      for row in sorted(rows)])
    open_slope, open_error = compared(found[2:-2, 2:-2], means[2:-2, 2:-2])
    print(f"OpenPIV, windows of {', '.join(map(str, windows))} pixels: slope {open_slope:.4f}, error {open_error:.4f} pixels")

for name, values in (("bos_without_flow.png", without), ("bos_with_flow.png", with_flow)):
    from matplotlib import image
    image.imsave(name, values[::-1], cmap="gray", vmin=0, vmax=4095)
    print("Wrote", os.path.abspath(name))
