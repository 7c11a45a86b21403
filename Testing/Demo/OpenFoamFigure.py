# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Examples/openfoam_jet.py: its files, and the fringe shifts of the flow (Testing/Data/README.md) within what Ciddor's
refractivity of air differs from K = 2.26e-4."""

import os
import runpy

EXAMPLE = os.path.join(os.environ["SCHLIEREN_SOURCE_DIR"], "Examples", "openfoam_jet.py")
shifts = runpy.run_path(EXAMPLE)["shifts"]
for ending in (".png", ".json", ".pvsm", "_intensity.png"):
    assert os.path.getsize("openfoam_jet" + ending) > 1000, ending
EXPECTED = {1.0625: 8.65, 5.0625: 2.45, 10.0625: -0.34, 15.0625: 3.13, 18.0625: 4.85}
for place, expected in EXPECTED.items():
    assert abs(shifts[place] - expected) < 0.01 * abs(expected) + 0.01, (place, shifts[place], expected)
