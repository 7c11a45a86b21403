# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Straight and refracted rays beside the flow, as in figure 13 of Brownlee et al.: one sensitivity, linked cameras;
of a mesh."""

import os

import numpy as np
from views_testing import (FOLDER, MESH, ViewsSession, check_baseline, check_linked, drawn, frame_view, load, image_array,
                           simple, views)
from plugin_testing import Schlieren
from representation_testing import pixels_of

NOTES = os.path.join(FOLDER, "sizes.npz")

user = ViewsSession()
user.press("Comparison")
user.python(f"""
views = [FindView(name) for name in ("Straight Rays", "Refracted Rays")]
np.savez({NOTES!r}, *[view.ViewSize for view in views])
settle_views()
assert sum(information(display.SchlierenBench, "MediumBuilds") for display in displays()) == 1, "A medium for each view"
""")
user.save_state("compared.pvsm")
user.undo()
user.save_state("undone.pvsm")
user.redo()
user.save_state("redone.pvsm")
user.undo()
user.redo()
# Dense enough for refracted rays to make another image.
user.play(MESH.replace("1e-3*RTData", "0.3*RTData") + "view.CameraParallelProjection = 1\n")


def check_session(state):
    load(state)
    cells = views()
    assert [cell for cell, _ in cells] == [1, 5, 6]
    scene, straight, refracted = [view for _, view in cells]
    in_views = (straight, refracted)
    mesh = simple.FindSource("mesh")
    benches = [drawn(mesh, view).SchlierenBench for view in in_views]
    assert [bench.PathModel for bench in benches] == ["Straight", "Refracted"]
    assert all(bench.KMode == "Value" for bench in benches) and len({bench.KScale for bench in benches}) == 1
    check_linked(state, scene, *in_views)
    assert simple.GetRepresentation(mesh, scene).Visibility == 1
    return benches, in_views


for state in ("compared.pvsm", "redone.pvsm"):
    benches, in_views = check_session(state)
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
size = [270, 270]
levels = [pixels_of(view, size).astype(float) for view in in_views]
change = levels[1] - levels[0]
assert np.ptp(change) > 40, np.ptp(change)
check_baseline(list(in_views), "WindowCompare.png", size)

load("undone.pvsm")
assert len(views()) == 1
with open(os.path.join(FOLDER, "undone.pvsm"), encoding="utf-8") as file:
    assert "<CameraLink name=" not in file.read(), "The link outlives its views"
