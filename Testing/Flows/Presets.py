# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The presets of Quality keep the errors that they state, on real flows, each by the technique that is hardest."""

import os
import sys

sys.path.insert(0, os.path.join(os.environ["SCHLIEREN_SOURCE_DIR"], "Testing", "Benchmarks"))

import Tradeoff
from schlieren.vtkSchlierenFilters import vtkSchlierenFilter

CUTOFFS = {"Knife Edge": vtkSchlierenFilter.KNIFE_EDGE, "Shadowgraph": vtkSchlierenFilter.SHADOWGRAPH,
           "Interferogram": vtkSchlierenFilter.INTERFEROGRAM,
           "Background Oriented": vtkSchlierenFilter.BACKGROUND_ORIENTED}
PRESETS = ("Interactive", "Fine", "Publication")

for flow, technique in (("blunt fin", "Knife Edge"), ("blunt fin", "Shadowgraph"), ("jet aslant", "Interferogram"),
                        ("jet aslant", "Background Oriented")):
    source, common, truth = Tradeoff.truth_of(flow, technique, rays=36)
    found = []
    for number, preset in enumerate(PRESETS):
        _, _, seen = Tradeoff.measure(technique, source, common, {"Quality": preset})
        p99, _ = Tradeoff.errors(technique, seen, truth, 1e-9 * common.get("Wavelength", 1))
        stated = vtkSchlierenFilter.GetQualityError(number, CUTOFFS[technique])
        print(f"{flow}, {technique}, {preset}: {p99:.2g} of {stated:.2g}")
        assert 0 < p99 <= stated, (flow, technique, preset, p99, stated)
        found.append(p99)
    assert found[0] > found[2], "Publication is no better than Interactive"
# In a smaller image, edges of bodies are more than one pixel of a hundred.
Tradeoff.PIXELS = 128
source, common, truth = Tradeoff.truth_of("blunt fin", "Knife Edge", rays=100)
_, _, seen = Tradeoff.measure("Knife Edge", source, common, {"Quality": "Publication"})
p99, _ = Tradeoff.errors("Knife Edge", seen, truth, 1)
stated = vtkSchlierenFilter.GetQualityError(vtkSchlierenFilter.PUBLICATION, vtkSchlierenFilter.KNIFE_EDGE)
print(f"blunt fin, 128 pixels wide, Publication: {p99:.2g} of {stated:.2g}")
assert 0 < p99 <= stated, (p99, stated)
for number, preset in enumerate(PRESETS):
    assert vtkSchlierenFilter.GetQualityTime(number) > (0 if number == 0 else vtkSchlierenFilter.GetQualityTime(number - 1))
assert vtkSchlierenFilter.GetQualityError(vtkSchlierenFilter.REFERENCE, 0) == 0
