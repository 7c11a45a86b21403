# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The toolbar where a server has the data and makes the images. Skipped without pvserver."""

import numpy as np
from server_testing import connect, start_server
from views_testing import INSIDE, MESH, ViewsSession, check_linked, drawn, load, simple, views
from representation_testing import GREY_LEVEL, filter_like, pixels_of

SIZE = (120, 90)

server, port = start_server()
user = ViewsSession()
user.press("OneImage")
user.save_state("one.pvsm")
user.undo()
user.save_state("undone.pvsm")
user.redo()
user.save_state("redone.pvsm")

user.press("Comparison")
user.python("settle_views()")
user.undo()
user.redo()
user.save_state("compared.pvsm")
try:
    user.play(connect(port) + INSIDE + MESH + "view.CameraParallelProjection = 1\n")
finally:
    server.kill()

for state, count in (("one", 1), ("redone", 1), ("compared", 4)):
    load(state + ".pvsm")
    (_, scene), *others = views()
    assert len(others) == count
    check_linked(state + ".pvsm", scene, *[view for _, view in others])
    shown = [(drawn(simple.FindSource("mesh"), view), view) for _, view in others]
    for display, view in shown:
        view.OrientationAxesVisibility = 0
        seen = pixels_of(view, SIZE)
        if display.SchlierenBench.PathModel != "Difference":  # of such weak refraction nothing can be seen
            assert np.ptp(seen) > 50
        assert np.abs(seen - filter_like(display, view, SIZE)).max() <= 2 * GREY_LEVEL
assert len({display.SchlierenBench.KScale for display, _ in shown if display.SchlierenBench.AutoKScale == 0}) == 1

load("undone.pvsm")
assert len(views()) == 1
