# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""A mistake leaves an empty output, and nothing broken after it is put right."""

from plugin_testing import RefractiveIndex, Schlieren, gaussian_column, is_empty

source = gaussian_column(16)
bench = Schlieren(source)
bench.Density = ["POINTS", "rho"]
bench.ImageSize = [16, 16]
assert not is_empty(bench)

for name, wrong, right in (("Density", ["POINTS", "nowhere"], ["POINTS", "rho"]),
                           ("ImageSize", [0, 16], [16, 16]), ("ImageSize", [16, -1], [16, 16]),
                           ("ViewUp", [0, 0, 1], [0, 1, 0]),
                           ("ViewDirection", [0, 0, 0], [0, 0, -1]),
                           ("SamplesPerPixel", 0, 1), ("StepSize", -1, 1),
                           ("AdaptiveTolerance", 0, 1), ("HomogeneityTolerance", 2, 0),
                           ("PathTolerance", -1, 0),
                           ("LengthScale", 0, 1), ("GladstoneDaleConstant", float("nan"), 1e-4)):
    setattr(bench, name, wrong)
    assert is_empty(bench), name
    setattr(bench, name, right)
    assert not is_empty(bench), name

bench.AutoKScale = 0
bench.KScale = -1
assert is_empty(bench)
bench.KScale = 1
assert not is_empty(bench)

refractivity = RefractiveIndex(source)
refractivity.Density = ["POINTS", "nowhere"]
assert is_empty(refractivity)
chained = Schlieren(refractivity)
assert is_empty(chained)
refractivity.Density = ["POINTS", "rho"]
assert not is_empty(refractivity)
assert not is_empty(chained)
