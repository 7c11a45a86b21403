# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""A mesh that leaves out a body, beside another one that is a second input: both are dark in the toolbar's view, the
second where a filter with it is selected, and where a script gives it; behind a graded filter; and before a scene,
which is seen through the flow."""

import os

import numpy as np
from views_testing import FOLDER, ViewsSession, png
from window_testing import PROPERTIES

SIZE = [120, 120]  # 0.2 data units for a pixel
HOLE, BALL = (4, 0), (-4, 0)  # centres in the image; radius 2
ABOVE = (-6, 6), (6, 6)  # places of the flow


def keep(name):
    """The script that keeps the image of the view that was made last, 24 data units wide and high."""
    return f"""
display = max(displays(), key=lambda one: one.SMProxy.GetGlobalID())
(view,) = [view for view in GetRenderViews() if display in view.Representations]
display.SchlierenBench.Quality = "Interactive"
frame_view(view, 12)
SaveScreenshot(os.path.join(FOLDER, {name + ".png"!r}), view, ImageResolution={SIZE})
"""


user = ViewsSession(PROPERTIES)
user.press("OneImage")
user.python(keep("hole"))
user.choose_filter("Schlieren")
user.choose("ImageSize/LineEdit0", "64")
user.choose("ImageSize/LineEdit1", "64")
user.choose("Quality/ComboBox", "Interactive")
user.python('FindSource("Schlieren1").Bodies = FindSource("ball")')
user.apply()
user.python('settle(FindSource("Schlieren1"))\nSetActiveView(FindView("RenderView1"))\nSetActiveSource(FindSource("Schlieren1"))')
user.press("OneImage")
user.python(keep("both") + """
assert display.SchlierenBench.Bodies == FindSource("ball")
display.SchlierenBench.Cutoff = "Graded Filter"
display.SchlierenBench.GradedFilter.Points = [0, 0.2, 0.5, 0, 1, 0.2, 0.5, 0]
""" + keep("graded"))
user.play("""
from paraview.simple import *
wave = Wavelet(WholeExtent=3 * [-10, 10])
rho = Calculator(Input=wave, Function="1 + 1e-4*RTData", ResultArrayName="rho")
clip = Clip(Input=rho, ClipType="Sphere", Invert=0)
clip.ClipType.Center, clip.ClipType.Radius = [4, 0, 0], 2
hole = AppendDatasets(Input=[clip], registrationName="hole")  # a clip's handles would be seen
hole.UpdatePipeline()
ball = Sphere(Center=[-4, 0, 0], Radius=2, ThetaResolution=32, PhiResolution=32, registrationName="ball")
ball.UpdatePipeline()
view = GetActiveViewOrCreate("RenderView")
Show(hole, view)
view.ResetCamera()
SetActiveSource(hole)
""")


def image(name):
    """RGB, lowest row first."""
    return png(os.path.join(FOLDER, name + ".png"))


def at(seen, place):
    column, row = (int(60 + 5 * axis) for axis in place)
    return seen[row, column]


seen = image("hole")
assert np.all(at(seen, HOLE) == 0) and np.all(at(seen, BALL) > 50)
for name in ("both", "graded"):
    seen = image(name)
    assert np.all(at(seen, HOLE) == 0) and np.all(at(seen, BALL) == 0), name

# A filter that lets a fifth of the light pass everywhere.
for place in ABOVE:
    assert np.all(np.abs(at(image("graded"), place) - 0.2 * 255) <= 1), at(image("graded"), place)
