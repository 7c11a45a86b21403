# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Examples/photograph.py finds the bench and the Mach disc of the photograph that it makes, and the lines of
Documentation/photograph.md find them, too."""

import os
import runpy

from demo_testing import snippets

made = runpy.run_path(os.path.join(os.environ["SCHLIEREN_SOURCE_DIR"], "Examples", "photograph.py"))
field, comparison = made["field"], made["comparison"]
assert abs(field(comparison, "PhotographK") / made["camera"]["KScale"] - 1) < 0.03, field(comparison, "PhotographK")
assert abs(field(comparison, "PhotographOffset") - made["offset"]) < 0.02, field(comparison, "PhotographOffset")
assert abs(field(comparison, "PhotographAngle") - made["edge"]) < 0.5, field(comparison, "PhotographAngle")
pixel = 2 * made["half"] / made["size"][1]
assert abs(made["mach_disc"] - made["expected"]) < pixel, (made["mach_disc"] / pixel, made["expected"] / pixel)
for name in ("photograph.png", "without_flow.png", "comparison.png"):
    assert os.path.getsize(name) > 30000, name

exec(snippets("photograph")[0], made)
assert abs(made["schlieren"].KScale / made["camera"]["KScale"] - 1) < 0.03, made["schlieren"].KScale
