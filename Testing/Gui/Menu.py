# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""A filter from the menu: made without a question for its optional input, it shows the grid and the k
that it uses."""

import os
import sys

import numpy as np

sys.path.insert(0, os.path.join(os.environ["SCHLIEREN_SOURCE_DIR"], "Testing", "Python"))

from plugin_testing import image_array, simple  # noqa: E402
from views_testing import INSIDE  # noqa: E402
from window_testing import FOLDER, PROPERTIES, Session  # noqa: E402

user = Session()
user.choose_filter("Schlieren")
user.check("Grid/Note", "text", "known after Apply")
user.apply()
user.check("Grid/Note", "text", "17 x 17 x 17 points: the data's own")
user.save_state("menu.pvsm")

# What notes show is of the image that Apply makes.
user.event(f"{PROPERTIES}/KFromOptics/CheckBox", "set_boolean", "true")
user.type("FocalLength/DoubleLineEdit0", "2")
user.apply()
user.python('settle(FindSource("Schlieren1"))')
user.check("Sensitivity/Note", "text", "k = 2000: full scale is a deflection of 0.25 mrad; optics: 2 m focal length, "
           "source 1 mm wide, the edge 0 mm in (offset 0)")
user.play(INSIDE + """
from paraview.simple import *
Sphere(Radius=3, registrationName="ball").UpdatePipeline()
flow = Calculator(Input=Wavelet(WholeExtent=3 * [-8, 8]), ResultArrayName="rho", Function="RTData", registrationName="flow")
flow.UpdatePipeline()
SetActiveSource(flow)
""", seconds=100)

simple.ResetSession()
simple.LoadState(os.path.join(FOLDER, "menu.pvsm"))
bench = simple.FindSource("Schlieren1")
assert bench.Bodies is None and bench.Density == ["POINTS", "rho"]
assert np.ptp(image_array(bench, "Intensity")) > 0
