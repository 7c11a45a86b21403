# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Straight and bent light beside the volume, as in figure 13 of Brownlee et al.: one sensitivity, linked
cameras; of a mesh, and with the settings of a filter that is selected."""

import os

import numpy as np
from views_testing import (FOLDER, MESH, ViewsSession, check_baseline, check_camera, check_display,
                           check_picture_view, filters, frame, load, picture, shown, simple, views)
from plugin_testing import Schlieren

user = ViewsSession()
user.press("Comparison")
user.save_state("compared.pvsm")
user.undo()
user.save_state("undone.pvsm")
user.redo()
user.save_state("redone.pvsm")
user.undo()
user.redo()
# Dense enough for bent light to make another picture.
user.play(MESH.replace("1e-3*RTData", "0.3*RTData"))


def check_session():
    benches = filters()
    straight, bent = benches["StraightRays1"], benches["RefractedRays1"]
    (_, scene), (_, upper), (_, lower) = views()
    assert (straight.PathModel, bent.PathModel) == ("Straight", "Refracted")
    assert straight.Input == bent.Input
    for bench, view in ((straight, upper), (bent, lower)):
        check_camera(bench, scene)
        check_display(shown(bench, view))
        check_picture_view(view, bench)
        assert bench.AutoKScale == 0 and bench.KScale == straight.KScale
    return straight, bent, scene


for state in ("compared", "redone"):
    load(state + ".pvsm")
    straight, bent, scene = check_session()
    with open(os.path.join(FOLDER, state + ".pvsm"), encoding="utf-8") as file:
        assert file.read().count("<CameraLink name=") == 1, "The cameras are not linked"
    medium = straight.Input
    assert medium.GetXMLName() == "RefractiveIndex" and medium.Input == simple.FindSource("mesh")
    volume = simple.GetRepresentation(medium, scene)
    assert volume.Visibility == 1 and volume.Representation == "Volume"
    assert list(volume.ColorArrayName)[:2] == ["POINTS", "Refractivity"]
    assert simple.GetRepresentation(simple.FindSource("mesh"), scene).Visibility == 1

# k is the one that bent light has by itself.
alone = Schlieren(
    Input=medium, IndexModel="Refractivity", IndexArray=["POINTS", "Refractivity"],
    PathModel="Refracted",
    **{name: bent.GetPropertyValue(name)
       for name in ("ImageSize", "ViewDirection", "ViewUp", "FocalPoint", "ParallelScale")})
alone.UpdatePipeline()
k = alone.FieldData["KScale"].GetRange()[0]
assert np.isclose(bent.KScale, k, rtol=1e-9), (bent.KScale, k)
assert np.ptp(picture(bent, "Intensity")) > 0.2
simple.Delete(alone)

# Straight and bent light side by side, at a k that no window's size changes.
assert abs(bent.KScale - 9.7) < 1, bent.KScale
(_, upper), (_, lower) = views()[1:]
for bench, view in ((straight, upper), (bent, lower)):
    bench.KScale = 9.7
    frame(bench, view, [270, 270], 15)
check_baseline([upper, lower], "WindowCompare.png", [270, 270])

load("undone.pvsm")
assert len(views()) == 1 and not filters()
with open(os.path.join(FOLDER, "undone.pvsm"), encoding="utf-8") as file:
    assert "<CameraLink name=" not in file.read(), "The link outlives its views"
