# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Examples/numerical_schlieren.py draws its six images, and light has the signs that the page names."""

import os
import runpy

import numpy as np

EXAMPLE = os.path.join(os.environ["SCHLIEREN_SOURCE_DIR"], "Examples", "numerical_schlieren.py")
made = runpy.run_path(EXAMPLE)
assert os.path.getsize("numerical_schlieren.png") > 50000
edge, step = made["images"]["knife edge, upright"], 1e3 * made["step"] / 2
row = edge[edge.shape[0] // 2]
expansion, disc = row[int(1 / step):int(8 / step)], row[int(13 / step):int(14.5 / step)]
assert expansion.max() < 0.5 and disc.max() > 0.8, (expansion.max(), disc.max())

# The ring at 18.7 mm crosses the jet in the traced image, and not on the slice.
ring, beside = (made["images"]["bright field"][row, int(18.7 / step) - 3:int(18.7 / step) + 4].min()
                - made["images"]["bright field"][row, int(20.5 / step)] for row in (edge.shape[0] // 2, 10))
assert ring < -0.05 and abs(beside) < 0.02, (ring, beside)
middle = made["middle"]
assert middle[middle.shape[0] // 2, int(18.7 / (2 * step))] < 0.05 * middle.max()
assert np.isclose(made["exponential"].min(), np.exp(-15))
