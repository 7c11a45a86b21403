# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The toolbar where a server has the data and makes the pictures. Skipped without pvserver."""

import numpy as np
from server_testing import connect, start_server
from views_testing import (MESH, ViewsSession, check_camera, check_display, check_picture_view, filters,
                           load, picture, shown, simple, views)

server, port = start_server()
user = ViewsSession()
user.press("OnePicture")
user.save_state("one.pvsm")
user.undo()
user.save_state("undone.pvsm")
user.redo()
user.save_state("redone.pvsm")

# The picture is selected.
user.press("Comparison")
user.undo()
user.redo()
user.save_state("compared.pvsm")
try:
    user.play(connect(port) + MESH)
finally:
    server.kill()

for state, count in (("one", 1), ("redone", 1), ("compared", 3)):
    load(state + ".pvsm")
    benches = filters()
    (scene,) = [view for _, view in views() if view.InteractionMode == "3D"]
    assert len(benches) == count and len(views()) == count + 1
    for bench in benches.values():
        (view,) = [view for _, view in views() if shown(bench, view)]
        assert np.ptp(picture(bench, "Intensity")) > 0.2
        check_camera(bench, scene)
        check_display(shown(bench, view))
        check_picture_view(view, bench)
assert len({bench.KScale for bench in benches.values() if bench.AutoKScale == 0}) == 1
medium = list(benches.values())[-1].Input
assert medium.GetXMLName() == "RefractiveIndex"
assert simple.GetRepresentation(medium, scene).Representation == "Volume"

load("undone.pvsm")
assert not filters() and len(views()) == 1
