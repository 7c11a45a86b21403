# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Examples/gallery.py has an image of each flow, and in them what the flow is known for."""

import os
import sys

import numpy as np
from demo_testing import SOURCE, image_array

sys.path.insert(0, os.path.join(SOURCE, "Examples"))
import gallery  # noqa: E402

WIDTH, HEIGHT = 60, 45
images = {name: pixels.astype(float) for name, pixels in gallery.main(".", (WIDTH, HEIGHT)).items()}
assert len(images) == len(gallery.FLOWS) == 8
assert image_array("gallery.png").shape == (2 * (HEIGHT + 64) + 20, 4 * (WIDTH + 20) + 20, 3)
for name, pixels in images.items():
    assert pixels.shape == (HEIGHT, WIDTH, 3) and pixels.std() > 4, name
    assert (np.ptp(pixels, axis=2).max() > 60) == (name in ("oblique_shock", "delta_wing")), f"{name}: colours"

# Bodies stop light, the gas does not: the fin to the right, the coil's core in the middle; none in the jet.
assert images["blunt_fin"][10:, -15:].max() == 0 and images["blunt_fin"][10:, :30].min() > 60
assert images["heating_coil"][:, 25:35].max() == 0 and images["heating_coil"][:, :5].min() > 60
assert images["jet_of_openfoam"].min(axis=2)[:, 2:-2].min() > 0
# What is symmetric is so in its image.
for name, other in (("jet_of_openfoam", images["jet_of_openfoam"][::-1]), ("reactor", images["reactor"][:, ::-1])):
    difference = np.abs(images[name] - other).mean()
    print(f"{name}: not symmetric by {difference:.2f} of 255")
    assert difference < 5, name
brightness = images["delta_wing"].sum(axis=2)
assert np.abs(brightness - brightness[:, ::-1]).mean() < 15
# Undisturbed light meets the dark field's stop.
assert images["blob"][:, :5].max() < 30 and images["blob"].max() > 200
