# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The module schlieren_core: its deflections are those of a closed form, mistakes are said in words, and the notebook runs."""

import json
import os
import re
import sys

try:
    import numpy as np
except ImportError:
    print("Skipped: there is no numpy.")
    sys.exit(77)
import schlieren_core

notebook = sys.argv[1]

# Density that grows upwards by 2 kg/m^4 over a depth of 0.1 m: K from the refractivity of air, 1.2 to 1.4 kg/m^3.
z, y, x = np.meshgrid(*3 * [np.linspace(0, 0.1, 33)], indexing="ij")
image = schlieren_core.render(1.2 + 2 * y, spacing=0.1 / 32, parallel_scale=0.02, size=(16, 12))
assert image.intensity.shape == (12, 16) and image.color is None and image.k > 0
assert np.abs(image.deflection[..., 1] / (2.26e-4 * 2 * 0.1) - 1).max() < 5e-3, image.deflection[..., 1]
assert np.abs(image.deflection[..., 0]).max() < 1e-9
same = schlieren_core.render(refractivity=2.26e-4 * (1.2 + 2 * y), spacing=(0.1 / 32,) * 3, parallel_scale=0.02, size=(16, 12),
                             k=1e4)
assert same.k == 1e4 and np.allclose(same.deflection[..., 1], image.deflection[..., 1], rtol=5e-3)
helium = schlieren_core.render(1.2 + 2 * y, spacing=0.1 / 32, gas="He", parallel_scale=0.02, size=(4, 4))
assert 0.8 < helium.deflection[0, 0, 1] / (1.95e-4 * 2 * 0.1) < 1.2
fringes = schlieren_core.render(1.2 + 2 * y, spacing=0.1 / 32, technique="Interferogram", wavelength=546.1, size=(32, 32),
                                parallel_scale=0.01)
waves = fringes.path / 546.1e-9
assert np.ptp(waves) > 1 and np.abs(fringes.intensity - 0.5 * (1 + np.cos(2 * np.pi * waves))).max() < 0.05
assert {"Knife Edge", "Shadowgraph", "Bright Field", "Dark Field", "Interferogram"} < set(schlieren_core.techniques)
assert "air" in schlieren_core.gases and schlieren_core.__version__.count(".") == 2


def refused(*words, **arguments):
    try:
        schlieren_core.render(**{"spacing": 0.01, "size": (4, 4), **arguments})
    except ValueError as error:
        print(error)
        assert all(word in str(error) for word in words), error
    else:
        raise AssertionError(f"{arguments} are taken")


refused("density", "gas", refractivity=1000 + 200 * y)
refused("either density", density=y, refractivity=y)
refused("'xenonn'", "argon", density=1 + y, gas="xenonn")
refused("'Knife'", "Dark Field", density=1 + y, technique="Knife")
refused("2 dimensions", density=y[0])
refused("ixel", density=1 + y, size=(0, 4))

# As a notebook runs it.
with open(notebook, encoding="utf-8") as file:
    cells = json.load(file)["cells"]
names = {}
for cell in cells:
    if cell["cell_type"] == "code":
        exec(compile("".join(cell["source"]), notebook, "exec"), names)
images = names["images"]
assert len(images) == 6
for technique, image in images.items():
    with open(technique.lower().replace(" ", "_") + ".png", "rb") as file:
        assert file.read() == image.png()
    assert np.ptp(image.intensity) > 0.1, technique

# What the page of the examples prints, of a density rho.
with open(os.path.join(os.path.dirname(notebook), "..", "Documentation", "examples.md"), encoding="utf-8") as page:
    (snippet,) = re.findall(r"^```python\n(.*?)^```", page.read(), re.DOTALL | re.MULTILINE)
exec(snippet, {"rho": 1.2 + 20 * (y - 0.05) ** 2})
assert os.path.getsize("x.png") > 100
