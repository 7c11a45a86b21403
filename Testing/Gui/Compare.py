# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Straight and refracted rays beside the flow, as in figure 13 of Brownlee et al.: one sensitivity, linked cameras;
of a mesh."""

import os

import numpy as np
from views_testing import (FOLDER, MESH, ViewsSession, check_baseline, check_linked, drawn, frame_view, load, image_array,
                           png, simple, views)
from plugin_testing import Schlieren

NOTES = os.path.join(FOLDER, "sizes.npz")

user = ViewsSession()
user.press("Comparison")
user.python(f"""
views = [FindView(name) for name in ("Straight Rays", "Refracted Rays")]
np.savez({NOTES!r}, *[view.ViewSize for view in views])
until(shown_at_all)
assert sum(builds(display.SchlierenBench) for display in displays()) == 1, "A medium for each view"
import inside_window
inside_window.made = [values(display.SchlierenBench) for display in displays()]
""")
user.undo()
user.python('assert len(views()) == 1 and not has_links(), "The link outlives its views"')
user.redo()
user.python("""
import inside_window
assert [values(display.SchlierenBench) for display in displays()] == inside_window.made
""")
user.save_state("redone.pvsm")
# Dense enough for refracted rays to make another image.
user.play(MESH.replace("1e-3*RTData", "0.3*RTData") + "view.CameraParallelProjection = 1\n")


load("redone.pvsm")
cells = views()
assert [cell for cell, _ in cells] == [1, 5, 6]
scene, *in_views = [view for _, view in cells]
mesh = simple.FindSource("mesh")
benches = [drawn(mesh, view).SchlierenBench for view in in_views]
assert [bench.PathModel for bench in benches] == ["Straight", "Refracted"]
assert all(bench.KMode == "Value" for bench in benches) and len({bench.KScale for bench in benches}) == 1
check_linked("redone.pvsm", scene, *in_views)
assert simple.GetRepresentation(mesh, scene).Visibility == 1
refracted, seen = benches[1], in_views[1]

# k is the one that refracted rays have by themselves.
camera = seen.GetActiveCamera()
alone = Schlieren(
    Input=simple.FindSource("mesh"), Density=["POINTS", "rho"], PathModel="Refracted",
    ImageSize=np.load(NOTES)["arr_1"].tolist(), ViewDirection=list(camera.GetDirectionOfProjection()),
    ViewUp=list(camera.GetViewUp()), FocalPoint=list(camera.GetFocalPoint()), ParallelScale=camera.GetParallelScale())
alone.UpdatePipeline()
k = alone.FieldData["KScale"].GetRange()[0]
assert np.isclose(refracted.KScale, k, rtol=1e-3), (refracted.KScale, k)
assert np.ptp(image_array(alone, "Intensity")) > 0.2
simple.Delete(alone)

# Side by side, at a k that no window's size changes.
assert abs(refracted.KScale - 9.7) < 1, refracted.KScale
for bench, view in zip(benches, in_views):
    bench.KScale = 9.7
    frame_view(view, 15)
check_baseline(in_views, "WindowCompare.png", [135, 135])
levels = png(os.path.join(FOLDER, "WindowCompare.png"))[..., 0]
change = levels[:, 135:] - levels[:, :135]
assert np.ptp(change) > 40, np.ptp(change)
