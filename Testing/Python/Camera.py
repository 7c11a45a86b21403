# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The camera's lens as scripts and views have it."""

import math
import os
import sys

import numpy as np
from paraview import simple
from plugin_testing import Schlieren, gaussian_column, image_array, output
from representation_testing import GREY_LEVEL, filter_like, pixels_of, show

sys.path.insert(0, os.path.join(os.environ["SCHLIEREN_SOURCE_DIR"], "Examples"))
from bos_bench import bos  # noqa: E402

column = gaussian_column(24)
bench = Schlieren(Input=column, Density=["POINTS", "rho"], Cutoff="Background Oriented", BackgroundPattern="Stripes",
                  BackgroundDistance=4, BackgroundPeriod=0.6, ParallelScale=1, FocalPoint=[0, 0, 0], ImageSize=[90, 60],
                  SamplesPerPixel=16)
DEFAULTS = {"FNumber": 0, "LensFocalLength": 50, "FocusDistance": 0, "SensorWidth": 0}
for name, value in DEFAULTS.items():
    assert bench.GetPropertyValue(name) == value, name


def stripes_across():
    """Periods of the stripes across the image without the flow."""
    row = image_array(bench, "Background")[5] - 0.5
    crossings = np.flatnonzero(np.diff(np.sign(row)))
    places = crossings - row[crossings] / (row[crossings + 1] - row[crossings])
    return len(row) / (2 * np.diff(places).mean())


# A sensor sees as much of the pattern as the magnification of its lens says. Data units are metres.
bench.SensorWidth, bench.LensFocalLength = 36, 50
for pixels in ([90, 60], [120, 60]):
    bench.ImageSize = pixels
    for focus in (0, 8.0):
        bench.FocusDistance = focus
        spacing = output(bench).GetSpacing()[0]
        wide = 0.6 * stripes_across()  # of the pattern, 5 behind the focal point
        tangent = 0.5 * 36e-3 * (1 / 50e-3 - 1 / (focus or math.inf))  # at first for a far pattern
        for _ in range(50):
            pupil = 0.5 * pixels[0] * spacing / tangent
            distance = focus or pupil + 5
            tangent = 0.5 * 36e-3 * (1 / 50e-3 - 1 / distance)
        expected = 2 * tangent * (pupil + 5)
        assert abs(wide / expected - 1) < 3e-3, (pixels, focus, wide, expected)
bench.SensorWidth, bench.FocusDistance, bench.ImageSize = 0, 0, [90, 60]

# An aperture blurs the flow, not the pattern that it is focused on; with the focus on the flow, the other way round.
bench.ViewAngle = 20
pupil = 1 / math.tan(math.radians(10))
sharp, moved = image_array(bench, "Background"), image_array(bench, "BackgroundDisplacement")
bench.LensFocalLength, bench.FNumber = 1500, 1
assert np.abs(image_array(bench, "Background") - sharp).max() < 1e-6
blurred = image_array(bench, "BackgroundDisplacement")
assert np.abs(blurred).max() < 0.8 * np.abs(moved).max()
# What the bench's data sheet says of it.
sheet = bos((90, 60), 1.5 / (pupil + 5 - 1.5) / 30 * (1 + 5 / pupil), focal=1.5, f_number=1, to_flow=pupil, to_background=5)
bench.UpdatePropertyInformation()
assert bench.GetProperty("Sensitivity").GetData() == (
    f"camera {pupil:.3g} m before the focal point, sees {sheet.width_flow:.3g} m by {sheet.height_flow:.3g} m, a pixel is "
    f"{1e3 / sheet.pixels_per_radian:.3g} mrad, the flow is blurred over {1e3 * sheet.blur_flow:.3g} mm")
bench.FocusDistance = pupil
assert np.ptp(image_array(bench, "Background")[30]) < 0.9 * np.ptp(sharp[30])
assert np.abs(image_array(bench, "BackgroundDisplacement") - moved).max() < 0.1 * np.abs(moved).max()
bench.FNumber, bench.FocusDistance = 0, 0
assert np.array_equal(image_array(bench, "Background"), sharp)

simple.Delete(bench)

# In a view the camera's disc and distance are the lens, for the image that the filter makes of it, too.
SIZE = (120, 90)
simple._DisableFirstRenderCameraReset()  # pylint: disable=protected-access
view = simple.CreateRenderView(ViewSize=list(SIZE), OrientationAxesVisibility=0, CenterAxesVisibility=0,
                               CameraPosition=[0.3, 0, 8], CameraFocalPoint=[0.3, 0, 0], CameraViewUp=[0, 1, 0])
display = show(column, view, Density=["POINTS", "rho"], Cutoff="Background Oriented", BackgroundPattern="Stripes",
               BackgroundDistance=4, BackgroundPeriod=0.8, SamplesPerPixel=16, SensorWidth=5)
pinhole = pixels_of(view, SIZE)
assert np.abs(pinhole - filter_like(display, view, SIZE)).max() <= GREY_LEVEL
view.CameraFocalDisk = 0.9
assert np.array_equal(pixels_of(view, SIZE), pinhole), "Without a distance, the disc is the default's"
view.CameraFocalDistance = 8
focused = pixels_of(view, SIZE)
assert np.ptp(focused[45]) < 0.8 * np.ptp(pinhole[45]), "The pattern is out of focus"
assert np.abs(focused - filter_like(display, view, SIZE)).max() <= GREY_LEVEL
view.CameraFocalDistance = 0
assert np.array_equal(pixels_of(view, SIZE), pinhole)
# A camera that pans sees the stripes elsewhere: in their place in the world.
view.CameraPosition, view.CameraFocalPoint = [0.3 + 0.8, 0, 8], [0.3 + 0.8, 0, 0]
first, second = pinhole[5], pixels_of(view, SIZE)[5]
assert np.abs(first - second).max() < 6, "By a period of the pattern, whose camera moves as far"
view.CameraPosition, view.CameraFocalPoint = [0.3 + 0.4, 0, 8], [0.3 + 0.4, 0, 0]
assert np.abs(first + pixels_of(view, SIZE)[5] - 255).max() < 8, "By half of it, light is dark"
