# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The example for plain Python, run by python3: its deflection is the sum of gradients, its image as symmetric as the ring."""

import os
import re
import subprocess

import numpy as np
from demo_testing import PVPYTHON, SOURCE, image_array

python = os.path.join(os.path.dirname(os.path.realpath(PVPYTHON)), "python3")
environment = dict(os.environ)
built = os.path.join(SOURCE, "build", "release", "plugin-file.txt")
if os.path.exists(built) and open(built).read().strip() == os.environ["SCHLIEREN_PLUGIN"]:
    del environment["PYTHONPATH"]  # the script finds the classes of a build itself
done = subprocess.run([python, os.path.join(SOURCE, "Examples", "plain_python.py")],
                      capture_output=True, text=True, timeout=170, env=environment)
print(done.stdout, done.stderr)
assert done.returncode == 0 and "ParaView" not in done.stdout
printed = float(re.search(r"largest deflection: (\S+) rad", done.stdout).group(1))

side = np.linspace(-0.05, 0.05, 401)
spacing = side[1] - side[0]
y, x = np.meshgrid(side, side, indexing="ij")
total = sum(0.3 * np.exp(-(np.hypot(np.hypot(y, z) - 0.025, x) / 0.006)**2) for z in side) * spacing
largest = 2.26e-4 * max(np.abs(slope).max() for slope in np.gradient(total, spacing))
assert abs(printed / largest - 1) < 0.03, (printed, largest)

image = image_array("plain_python.png")[..., 0]
assert image.shape == (400, 400) and np.ptp(image) > 200
assert np.abs(image - image[:, ::-1]).max() <= 2, "Left and right differ"
# The knife edge is horizontal: above and below, light and dark change places.
inner = (image > 5) & (image < 250) & (image > 5)[::-1] & (image < 250)[::-1]
assert np.abs(image + image[::-1] - 2 * image[0, 0])[inner].max() <= 3, "Above and below are no negatives"
