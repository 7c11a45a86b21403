# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Straight and bent light beside the flow, as in figure 13 of Brownlee et al.: one sensitivity, linked cameras;
of a mesh."""

import os

import numpy as np
from views_testing import (FOLDER, MESH, ViewsSession, check_baseline, check_linked, drawn, frame_view, load, image_array,
                           simple, views)
from plugin_testing import Schlieren

NOTES = os.path.join(FOLDER, "sizes.npz")

user = ViewsSession()
user.press("Comparison")
user.python(f"""
views = [FindView("RenderView2"), FindView("RenderView3")]
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
# Dense enough for bent light to make another image.
user.play(MESH.replace("1e-3*RTData", "0.3*RTData") + "view.CameraParallelProjection = 1\n")


def check_session(state):
    load(state)
    (_, scene), (_, upper), (_, lower) = views()
    mesh = simple.FindSource("mesh")
    benches = [drawn(mesh, view).SchlierenBench for view in (upper, lower)]
    assert [bench.PathModel for bench in benches] == ["Straight", "Refracted"]
    assert {bench.AutoKScale for bench in benches} == {0} and benches[0].KScale == benches[1].KScale
    check_linked(state, scene, upper, lower)
    assert simple.GetRepresentation(mesh, scene).Visibility == 1
    return benches, (upper, lower)


for state in ("compared.pvsm", "redone.pvsm"):
    (straight, bent), (upper, lower) = check_session(state)

# k is the one that bent light has by itself.
camera = lower.GetActiveCamera()
alone = Schlieren(
    Input=simple.FindSource("mesh"), Density=["POINTS", "rho"], PathModel="Refracted",
    ImageSize=np.load(NOTES)["arr_1"].tolist(), ViewDirection=list(camera.GetDirectionOfProjection()),
    ViewUp=list(camera.GetViewUp()), FocalPoint=list(camera.GetFocalPoint()), ParallelScale=camera.GetParallelScale())
alone.UpdatePipeline()
k = alone.FieldData["KScale"].GetRange()[0]
assert np.isclose(bent.KScale, k, rtol=1e-3), (bent.KScale, k)
assert np.ptp(image_array(alone, "Intensity")) > 0.2
simple.Delete(alone)

# Straight and bent light side by side, at a k that no window's size changes.
assert abs(bent.KScale - 9.7) < 1, bent.KScale
for bench, view in ((straight, upper), (bent, lower)):
    bench.KScale = 9.7
    frame_view(view, 15)
check_baseline([upper, lower], "WindowCompare.png", [270, 270])

load("undone.pvsm")
assert len(views()) == 1
with open(os.path.join(FOLDER, "undone.pvsm"), encoding="utf-8") as file:
    assert "<CameraLink name=" not in file.read(), "The link outlives its views"
