# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Ladenburg's jet behind every cutoff: images against baselines, mirrored about the axis."""

import os

import numpy as np
from flow_testing import (DATA, EVERY_VOXEL, Schlieren, check_baseline, image_array, write_image)
from paraview.simple import CreatePiecewiseFunction, SetProperties, XMLImageDataReader

jet = XMLImageDataReader(FileName=[os.path.join(DATA, "ladenburg_jet_3d.vti")])
jet.UpdatePipeline()
bench = Schlieren(jet, GladstoneDaleConstant=2.26e-4, Density=["POINTS", "rho"], Device="CPU", ImageSize=[256, 138], **EVERY_VOXEL)


def same(shown):
    return shown


def green_for_blue(shown):
    """Of the colour wheel, mirrored in the axis of the light that is deflected to the right."""
    return shown[..., [0, 2, 1]]


def shoot(name, mirror=same, white=1, array="Intensity", **properties):
    """An image from the filter's own settings but for `properties`; `mirror` makes of it what it is
    upside down."""
    before = {name: bench.GetProperty(name).GetData() for name in properties}
    SetProperties(bench, **properties)
    shown = image_array(bench, array).astype(float) / (255 if array == "Color" else white)
    if mirror:
        error = np.abs(mirror(shown) - shown[::-1]).mean()
        print(f"{name}: not symmetric by {error:.5f}")
        assert error < 0.005
    check_baseline(bench, name, white, array)
    SetProperties(bench, **before)
    return shown


shoot("JetKnifeEdgeFurtherIn", CutoffOffset=0.25)
shoot("JetGradedFilter", Cutoff="Graded Filter", GradedFilter=CreatePiecewiseFunction(
    Points=[number for x, y in ((0, 0.1), (0.35, 0.1), (0.4, 1), (0.6, 1), (0.65, 0.4), (1, 0.4))
            for number in (x, y, 0.5, 0)]))
circular = shoot("JetBrightField", Cutoff="Bright Field")
complement = shoot("JetDarkField", Cutoff="Dark Field")
assert np.abs(circular + complement - 1).mean() < 0.01

shoot("JetColorWheel", green_for_blue, array="Color", Cutoff="Color Filter")
# Red, green, blue and yellow for light that is deflected to the right, upwards, to the left, downwards.
v, u = (np.mgrid[:64, :64] - 31.5) / 32
colors = np.array([(230, 40, 30), (40, 200, 60), (40, 90, 255), (250, 210, 30)], np.uint8)[
    np.rint(np.arctan2(v, u) / (np.pi / 2)).astype(int) % 4]
colors[np.hypot(u, v) < 0.2] = 60
shoot("JetColorFilter", None, array="Color", Cutoff="Color Filter",
      ColorFilterImage=write_image("colors.png", colors))

shoot("JetInterferogram", Cutoff="Interferogram", Wavelength=546.1)
shoot("JetFiniteFringes", Cutoff="Interferogram", Wavelength=546.1, FringeSpacing=1e-3)

shoot("JetBehindStripes", Cutoff="Background Oriented", BackgroundPattern="Stripes",
      BackgroundDistance=0.3)
shoot("JetBehindDots", None, Cutoff="Background Oriented", BackgroundDistance=0.3)

shoot("JetCaustics", white=4, Cutoff="Shadowgraph", ScreenDistance=0.5)
shoot("JetRoundSource", None, white=2, Cutoff="Shadowgraph", ScreenDistance=0.2, SourceShape="Disc",
      SourceWidth=5, SamplesPerPixel=16)
shoot("JetDivergingLight", white=2, Cutoff="Shadowgraph", SourceDistance=0.1, ScreenDistance=0.02)
