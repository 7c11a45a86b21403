# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Adaptive meshes of ParaView's own sources, and parts of the data."""

import math

import numpy as np
from paraview.simple import AMRGaussianPulseSource, Clip, ExtractSubset, HierarchicalFractal, Tetrahedralize
from plugin_testing import RADIUS, RefractiveIndex, Schlieren, gaussian_column, image_array, output


def told_grid(bench):
    bench.UpdatePropertyInformation()  # what the panel shows
    return bench.GetProperty("Grid")[0]


pulse = AMRGaussianPulseSource(Dimension=3, XPulseOrigin=-0.75, YPulseOrigin=-0.75, ZPulseOrigin=1.25)
pulse.UpdatePipeline()
medium = RefractiveIndex(pulse, IndexModel="Refractivity", IndexArray=["CELLS", "Gaussian-Pulse"])
assert output(medium).GetClassName() == output(pulse).GetClassName()
assert medium.GetDataInformation().GetCellDataInformation().GetArrayInformation("Refractivity")
bench = Schlieren(pulse, IndexModel="Refractivity", IndexArray=["CELLS", "Gaussian-Pulse"])
assert np.abs(image_array(bench, "Deflection")).max() > 0 and image_array(bench, "BlockedFraction").max() == 0
assert "million voxels" in told_grid(bench), told_grid(bench)

# Levels of blocks, with layers of ghost cells or without, which give the same image.
images = []
for ghosts in (0, 1):
    fractal = HierarchicalFractal(GhostLevels=ghosts, TwoDimensional=0, MaximumLevel=3)
    fractal.UpdatePipeline()
    images.append(image_array(Schlieren(fractal, IndexModel="Refractivity", ImageSize=[32, 32],
                                        IndexArray=["CELLS", "Fractal Volume Fraction"]), "Deflection"))
assert np.array_equal(*images), np.abs(images[0] - images[1]).max()

column = gaussian_column(64)
# A box of an image, of a mesh, and what Schlieren sees of it.
tetrahedra = Tetrahedralize(column)
low, high = column.GetDataInformation().GetBounds()[4:]
ofBox = [0.6 * low + 0.4 * high, 0.4 * low + 0.6 * high]
part = ExtractSubset(column, VOI=[0, 63, 0, 63, 25, 38])
clipped = Clip(tetrahedra, ClipType="Box")
clipped.ClipType.Position = [-1, -1, ofBox[0]]
clipped.ClipType.Length = [2, 2, ofBox[1] - ofBox[0]]
for whole, box in ((column, part), (tetrahedra, clipped)):
    bent = []
    for source in (whole, box):
        source.UpdatePipeline()
        bent.append(np.abs(image_array(Schlieren(
            source, IndexModel="Refractivity", IndexArray=["POINTS", "N"], ViewDirection=[0, 0, -1], SamplesPerPixel=1, AmbientRefractivity=0), "Deflection")).max())
    # Light along z meets as much of the column as is in the box.
    made = box.GetDataInformation().GetBounds()[4:]
    expected = math.erf(0.5 * (made[1] - made[0]) / RADIUS) / math.erf(1 / RADIUS)
    assert abs(bent[1] / bent[0] / expected - 1) < 0.01, (bent, expected)
