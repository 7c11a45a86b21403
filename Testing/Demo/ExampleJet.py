# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The script that users copy runs as it stands and writes a grey image of the jet."""

import os
import subprocess

import numpy as np
from demo_testing import PVPYTHON, SOURCE, image_array

done = subprocess.run([PVPYTHON, os.path.join(SOURCE, "Examples", "jet.py")], timeout=170)
assert done.returncode == 0, f"Exit code {done.returncode}"
pixels = image_array("jet.png")
assert pixels.shape == (480, 900, 3), pixels.shape
pixels = pixels[10:-10, 15:-15]  # around the image lies the view's background
assert np.ptp(pixels, axis=2).max() <= 1, "The image is not grey"
assert pixels.std() > 10, "The image is blank"
# Mirrored about the axis, light and dark change places; on the right the legend covers some of it.
signal = pixels[:, :600, 0] - np.median(pixels)
assert np.corrcoef(signal.ravel(), signal[::-1].ravel())[0, 1] < -0.9
