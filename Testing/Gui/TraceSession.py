# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The Python trace of a session: a view of one click, turned by mouse, its knife dragged in the panel, and the
comparison of that. Played elsewhere, it makes the same views and the same images."""

import numpy as np
from views_testing import INSIDE, OPEN_JET, TRACE, ViewsSession, load, play_trace, simple, values, views
from representation_testing import pixels_of
from window_testing import BENCH

SIDE = 240  # pixels of the cutoff plane
MIDDLE = 20 + SIDE // 2, 2 + SIDE // 2  # of the widget; give or take a few
SIZE = (160, 120)

user = ViewsSession(BENCH)
user.press("OneImage")
user.python("settle_views()")
user.save_state("clicked.pvsm")
user.drag_view(2, (0.3, 0.5), (0.35, 0.55), (0.4, 0.6), (0.45, 0.6), (0.5, 0.6))
user.python("settle_views()")
user.save_state("turned.pvsm")
user.check("SchlierenCutoff/Plane", "enabled", "true")
user.size_plane(SIDE)
x, y = MIDDLE
user.drag("SchlierenCutoff/Plane", (x, y - 30), (x + 40, y - 30), (x + 21, y - 30))
user.python("settle_views()")
user.save_state("dragged.pvsm")
user.press("Comparison")
user.python(f"""
settle_views()
from paraview import smtrace
text = smtrace.stop_trace()
with open({TRACE!r}, "w") as file:
    file.write(text)
""")
user.save_state("compared.pvsm")
user.play(INSIDE + OPEN_JET + """
from paraview import smtrace
smtrace.start_trace()
""")


def session(state):
    """Of the views that draw as Schlieren: their cells, cameras, settings and images."""
    load(state + ".pvsm")
    jet, found = simple.FindSource("jet"), []
    for cell, view in views():
        display = simple.GetRepresentation(jet, view)
        if display.Representation == "Schlieren":
            camera = [*view.CameraPosition, *view.CameraFocalPoint, *view.CameraViewUp]
            found.append((cell, camera, values(display.SchlierenBench), pixels_of(view, SIZE)))
    return found


steps = [session(state) for state in ("clicked", "turned", "dragged", "compared")]
assert [len(step) for step in steps] == [1, 1, 1, 4]
assert not np.allclose(steps[0][0][1], steps[1][0][1]), "It was not turned"
assert float(steps[2][0][2]["CutoffOffset"]) > 0
for earlier, later in zip(steps, steps[1:3]):
    assert np.abs(earlier[0][3] - later[0][3]).max() > 10

play_trace("traced.pvsm", OPEN_JET)
for (cell, camera, settings, image), (*expected,) in zip(session("traced"), steps[-1]):
    assert cell == expected[0]
    assert np.allclose(camera, expected[1]), (camera, expected[1])
    assert settings == expected[2], [(key, expected[2][key], settings[key]) for key in settings
                                     if expected[2][key] != settings[key]]
    assert np.abs(image - expected[3]).max() <= 1, cell
