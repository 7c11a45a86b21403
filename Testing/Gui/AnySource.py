# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The toolbar with whatever is selected: nothing, what cannot be used, blocks of meshes without a 3-D view,
a picture."""

import numpy as np
from views_testing import (MESH, SOURCE, ViewsSession, check_camera, check_display, check_picture_view,
                           filters, load, picture, shown, simple, views)

user = ViewsSession()
for button in ("OnePicture", "ThreePictures", "Comparison", "Follow"):
    user.check_button(button, "enabled", "false")

user.python('SetActiveSource(Sphere(registrationName="ball"))')
user.press("OnePicture")
user.check_message("'ball': There is no array with one value at a point or cell, so nothing tells the "
                   "refractive index. Load or compute a density.")
user.python("""
warm = PassArrays(Input=Calculator(Input=Wavelet(), ResultArrayName="T", Function="250 + RTData"),
                  PointDataArrays=["T"], registrationName="warm")
warm.UpdatePipeline()
SetActiveSource(warm)
""")
user.press("OnePicture")
user.check_message("'warm': There is no density, nor a temperature together with a pressure, so nothing tells the "
                   "refractive index. Load or compute one (Documentation/density.md says how), or choose an "
                   "array yourself in the filter of the menu Filters > Schlieren.")
user.python(MESH + """
table = Histogram(Input=mesh, registrationName="table")
table.UpdatePipeline()
SetActiveSource(table)
""")
user.press("Comparison")
user.check_message("'table' has no cells to send light through. Select data that fill a volume.")
user.python("""
nothing = Threshold(Input=FindSource("mesh"), registrationName="nothing")
nothing.Scalars = ["POINTS", "rho"]
nothing.LowerThreshold = nothing.UpperThreshold = 100  # where a slider still reaches
nothing.UpdatePipeline()
SetActiveSource(nothing)
""")
user.press("ThreePictures")
user.check_message("'nothing' has no cells to send light through. Select data that fill a volume.")

# Made from the menu and not applied yet.
user.python('SetActiveSource(FindSource("mesh"))')
user.choose_filter("Schlieren")
user.press("OnePicture")
user.check_message("'Schlieren1' has not been applied yet. Press Apply first.")
user.delete()

# Nothing was made by all this.
user.save_state("nothing.pvsm")

# Two blocks, and no view at all.
user.python("""
mesh = FindSource("mesh")
other = Transform(Input=mesh, registrationName="other")
other.Transform.Translate = [20, 0, 0]
blocks = GroupDatasets(Input=[mesh, other], registrationName="blocks")
blocks.UpdatePipeline()
SetActiveSource(blocks)
Delete(GetActiveView())
""")
user.press("OnePicture")
user.save_state("blocks.pvsm")

# With the picture selected, another one with its settings, from the menu.
user.choose("Cutoff/ComboBox", "Shadowgraph")
user.apply()
user.python("""
FindSource("Schlieren1").GradedFilter.Points = [0, 0.25, 0.5, 0, 1, 0.75, 0.5, 0]
""")
user.menu("menuSchlieren", "actionOnePicture")
user.save_state("two.pvsm")
user.choose("Cutoff/ComboBox", "Circular")
user.apply()
user.save_state("different.pvsm")
user.play(f"""
import os, sys
sys.path.insert(0, {SOURCE!r} + "/Testing/Gui")
""")

load("nothing.pvsm")
assert not filters() and len(simple.GetRenderViews()) == 1

load("blocks.pvsm")
((_, scene), (_, flat)) = views()
(bench,) = filters().values()
assert bench.Input == simple.FindSource("blocks") and bench.Density == ["POINTS", "rho"]
assert simple.GetRepresentation(bench.Input, scene).Visibility == 1
check_camera(bench, scene)
check_display(shown(bench, flat))
check_picture_view(flat, bench)
assert np.ptp(picture(bench, "Intensity")) > 0.2

load("two.pvsm")
first, second = filters().values()
((_, scene),) = [(cell, view) for cell, view in views() if view.InteractionMode == "3D"]
assert [cell for cell, _ in views()] == [2, 3, 4] and first.FollowedView == second.FollowedView
assert first.Cutoff == second.Cutoff == "Shadowgraph" and first.Input == second.Input
assert list(first.GradedFilter.Points) == list(second.GradedFilter.Points)
assert first.GradedFilter.Points[1] == 0.25
assert first.GradedFilter.SMProxy != second.GradedFilter.SMProxy, "A curve of both"
for bench in (first, second):
    (view,) = [view for _, view in views() if shown(bench, view)]
    check_camera(bench, scene)
    check_display(shown(bench, view), 2)
    check_picture_view(view, bench)

load("different.pvsm")
first, second = filters().values()
assert (first.Cutoff, second.Cutoff) == ("Shadowgraph", "Circular")
for bench, white in ((first, 2), (second, 1)):
    (display,) = [shown(bench, view) for _, view in views() if shown(bench, view)]
    check_display(display, white)
