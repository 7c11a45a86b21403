# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Adaptive meshes of ParaView's own sources, 2-D data, the grid that is announced, and the array that is chosen."""

import math

import numpy as np
from paraview.simple import AMRGaussianPulseSource, Calculator, HierarchicalFractal, PassArrays, Slice, Tetrahedralize
from plugin_testing import RADIUS, RefractiveIndex, Schlieren, gaussian_column, is_empty, output, image_array


def told_grid(bench):
    bench.UpdatePropertyInformation()  # what the panel shows
    return bench.GetProperty("Grid")[0]


pulse = AMRGaussianPulseSource(Dimension=3, XPulseOrigin=-0.75, YPulseOrigin=-0.75, ZPulseOrigin=1.25)
pulse.UpdatePipeline()
medium = RefractiveIndex(pulse, IndexModel="Refractivity", IndexArray=["CELLS", "Gaussian-Pulse"])
assert output(medium).GetDimensions() == (10, 10, 10)
assert told_grid(medium) == "10 x 10 x 10 points: the cells of level 1", told_grid(medium)
bench = Schlieren(pulse, IndexModel="Refractivity", IndexArray=["CELLS", "Gaussian-Pulse"])
assert np.abs(image_array(bench, "Deflection")).max() > 0 and image_array(bench, "BlockedFraction").max() == 0
assert "million voxels" in told_grid(bench), told_grid(bench)

# Six levels of blocks, with layers of ghost cells or without, which give the same medium.
ranges = []
for ghosts in (0, 1):
    fractal = HierarchicalFractal(GhostLevels=ghosts, TwoDimensional=0, MaximumLevel=3)
    fractal.UpdatePipeline()
    medium = RefractiveIndex(fractal, IndexModel="Refractivity",
                             IndexArray=["CELLS", "Fractal Volume Fraction"])
    image = output(medium)
    assert "the cells of level" in told_grid(medium), told_grid(medium)
    assert image.GetPointData().GetArray("vtkValidPointMask").GetRange() == (1, 1)
    ranges.append((image.GetDimensions(), image.GetPointData().GetArray("Refractivity").GetRange()))
assert ranges[0] == ranges[1], ranges

# A slice is extruded by its depth, on a grid as fine as its triangles.
column = gaussian_column(64)
middle = Slice(column, SliceType="Plane")
middle.SliceType.Normal = [0, 1, 0]
middle.Triangulatetheslice = 0
flat = RefractiveIndex(middle, IndexModel="Refractivity", IndexArray=["POINTS", "N"], Depth=1)
image = output(flat)
assert image.GetDimensions() == (64, 2, 64), image.GetDimensions()
assert image.GetBounds()[2:4] == (-0.5, 0.5), image.GetBounds()
assert "chosen from the sizes of the cells" in told_grid(flat), told_grid(flat)

# A temperature is not taken for a density, unless the user says so.
warm = Calculator(column, ResultArrayName="T", Function="300 + 1e4*N")
temperature = PassArrays(warm, PointDataArrays=["T"])
both = PassArrays(warm, PointDataArrays=["T", "rho"])
for source in (temperature, both):
    source.UpdatePipeline()
for kind in (Schlieren, RefractiveIndex):
    bench = kind(temperature)
    assert not bench.Density[1], bench.Density
    assert is_empty(bench)
    bench.Density = ["POINTS", "T"]
    assert not is_empty(bench)
    assert not is_empty(kind(temperature, Density=["POINTS", "T"]))
    assert list(kind(both).Density) == ["POINTS", "rho"]

# A box of a mesh, of an image, and what Schlieren sees of it: the screen is one depth of the box behind it.
tetrahedra = Tetrahedralize(column)
for source in (column, tetrahedra):
    source.UpdatePipeline()
    low, high = source.GetDataInformation().GetBounds()[4:]
    box = [0, 0, 0, 0, 0.6 * low + 0.4 * high, 0.4 * low + 0.6 * high]
    boxed = RefractiveIndex(source, IndexModel="Refractivity", IndexArray=["POINTS", "N"], SamplingBounds=box)
    made = output(boxed).GetBounds()
    spacing = output(boxed).GetSpacing()[2]
    assert abs(made[4] - box[4]) <= spacing and abs(made[5] - box[5]) <= spacing, made
    whole = Schlieren(source, IndexModel="Refractivity", IndexArray=["POINTS", "N"], ViewDirection=[0, 0, -1],
                      Cutoff="Shadowgraph", SamplesPerPixel=1, AmbientRefractivity=0)
    part = Schlieren(source, IndexModel="Refractivity", IndexArray=["POINTS", "N"], ViewDirection=[0, 0, -1],
                     Cutoff="Shadowgraph", SamplesPerPixel=1, AmbientRefractivity=0, SamplingBounds=box)
    bent, ofPart = (np.abs(image_array(bench, "Deflection")).max() for bench in (whole, part))
    # Light along z meets as much of the column as is in the box.
    expected = math.erf(0.5 * (made[5] - made[4]) / RADIUS) / math.erf(1 / RADIUS)
    assert abs(ofPart / bent / expected - 1) < 0.01, (ofPart / bent, expected)
