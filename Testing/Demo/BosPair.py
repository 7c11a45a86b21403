# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Examples/bos_pair.py closes the loop: what least squares find in a recorded pair is the displacement of rays."""

import os
import runpy

names = runpy.run_path(os.path.join(os.environ["SCHLIEREN_SOURCE_DIR"], "Examples", "bos_pair.py"))
assert abs(names["slope"] - 1) < 0.003, names["slope"]
assert names["error"] < 0.006, names["error"]
if names["result"] is not None:  # OpenPIV, after three passes
    assert abs(names["open_slope"] - 1) < 0.015, names["open_slope"]
for file in ("bos_without_flow.png", "bos_with_flow.png"):
    assert os.path.getsize(file) > 10000, file
