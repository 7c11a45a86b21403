# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""A mesh that leaves out a body, beside another one that is a second input: both are dark in the toolbar's view, the
second where a filter with it is selected, and where a script gives it; behind a graded filter; and before a scene,
which is seen through the flow."""

import numpy as np
from views_testing import INSIDE, ViewsSession, frame_view, load, shown, simple, views
from representation_testing import pixels_of
from window_testing import PROPERTIES

SIZE = [120, 120]  # 0.2 data units for a pixel
HOLE, BALL = (4, 0), (-4, 0)  # centres in the image; radius 2
ABOVE = (-6, 6), (6, 6)  # places of the flow

user = ViewsSession(PROPERTIES)
user.press("OneImage")
user.save_state("hole.pvsm")
user.choose_filter("Schlieren")
user.python('FindSource("Schlieren1").Bodies = FindSource("ball")')
user.apply()
user.python('settle(FindSource("Schlieren1"))\nSetActiveView(FindView("RenderView1"))\nSetActiveSource(FindSource("Schlieren1"))')
user.press("OneImage")
user.save_state("both.pvsm")
user.python("""
(bench,) = [display.SchlierenBench for display in displays() if display.SchlierenBench.Bodies]
bench.Cutoff = "Graded Filter"
bench.GradedFilter.Points = [0, 0.2, 0.5, 0, 1, 0.2, 0.5, 0]
""")
user.save_state("graded.pvsm")
user.python("""
board = Plane(Origin=[-12, -12, -20], Point1=[0, -12, -20], Point2=[-12, 12, -20], registrationName="board")
board.UpdatePipeline()
(display,) = [one for one in displays() if one.SchlierenBench.Bodies]
view = GetActiveView()
Show(board, view).DiffuseColor = [1, 0, 0]
display.SchlierenBench.Cutoff = "Background Oriented"
display.SchlierenBench.BackgroundPattern = "Scene"
Render(view)
settle_views()
""")
user.save_state("scene.pvsm")
user.play(INSIDE + """
from paraview.simple import *
wave = Wavelet(WholeExtent=3 * [-10, 10])
rho = Calculator(Input=wave, Function="1 + 1e-4*RTData", ResultArrayName="rho")
hole = Clip(Input=rho, ClipType="Sphere", Invert=0, registrationName="hole")
hole.ClipType.Center, hole.ClipType.Radius = [4, 0, 0], 2
hole.UpdatePipeline()
ball = Sphere(Center=[-4, 0, 0], Radius=2, ThetaResolution=32, PhiResolution=32, registrationName="ball")
ball.UpdatePipeline()
view = GetActiveViewOrCreate("RenderView")
Show(hole, view)
view.ResetCamera()
SetActiveSource(hole)
""")


def seen_in(state):
    """Of the view that was made last: its bench, and RGB, 24 data units wide and high, lowest row first."""
    load(state)
    flow = simple.FindSource("hole")
    drawn_in = [view for _, view in views() if shown(flow, view) and shown(flow, view).Representation == "Schlieren"]
    (view,) = [one for one in drawn_in if len(drawn_in) == 1 or shown(flow, one).SchlierenBench.Bodies]
    frame_view(view, 12)
    return shown(flow, view).SchlierenBench, pixels_of(view, SIZE, slice(None))


def at(image, place):
    column, row = (int(60 + 5 * axis) for axis in place)
    return image[row, column]


_, image = seen_in("hole.pvsm")
assert np.all(at(image, HOLE) == 0) and np.all(at(image, BALL) > 50)
bench, image = seen_in("both.pvsm")
assert bench.Bodies == simple.FindSource("ball")
assert np.all(at(image, HOLE) == 0) and np.all(at(image, BALL) == 0)

# A filter that lets a fifth of the light pass everywhere.
bench, image = seen_in("graded.pvsm")
assert bench.Cutoff == "Graded Filter"
for place in ABOVE:
    assert np.all(np.abs(at(image, place) - 0.2 * 255) <= 1), at(image, place)
assert np.all(at(image, HOLE) == 0) and np.all(at(image, BALL) == 0)

# A red board behind the left half of the flow, through which it is seen; behind the right half is the background.
bench, image = seen_in("scene.pvsm")
assert bench.BackgroundPattern == "Scene"
left, right = (at(image, place) for place in ABOVE)
assert left[0] > 150 and left[1] < 60 and right[0] < 130 < right[0] + right[2] and right[1] > 60, (left, right)
assert np.all(at(image, HOLE) == 0) and np.all(at(image, BALL) == 0)
