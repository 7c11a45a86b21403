# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The Python trace of a session: a picture of one click, its volume turned by mouse, its knife dragged in the
panel, and the comparison of that. Played elsewhere, it makes the same filters and the same pictures."""

import os

import numpy as np
from views_testing import (FOLDER, OPEN_JET, TRACE, ViewsSession, check_camera, filters, load, picture,
                           play_trace, values, views)

SIDE = 240  # pixels of the cutoff plane
MIDDLE = 20 + SIDE // 2, 2 + SIDE // 2  # of the widget; give or take a few
SETTLE = """
settle(*[source for source in GetSources().values() if source.GetXMLName() == "Schlieren"])
"""

user = ViewsSession()
user.press("OnePicture")
user.python(SETTLE)
user.save_state("clicked.pvsm")
user.drag_view(1, (0.3, 0.5), (0.35, 0.55), (0.4, 0.6), (0.45, 0.6), (0.5, 0.6))
user.python(SETTLE)
user.save_state("turned.pvsm")
user.check("SchlierenCutoff/Plane", "enabled", "true")
user.size_plane(SIDE)
x, y = MIDDLE
user.drag("SchlierenCutoff/Plane", (x, y - 30), (x + 40, y - 30), (x + 21, y - 30))
user.python(SETTLE)
user.save_state("dragged.pvsm")
user.press("Comparison")
user.python(SETTLE + f"""
from paraview import smtrace
text = smtrace.stop_trace()
with open({TRACE!r}, "w") as file:
    file.write(text)
""")
user.save_state("compared.pvsm")
user.play(f"""
import sys
sys.path.insert(0, {os.path.dirname(os.path.abspath(__file__))!r})
""" + OPEN_JET + """
from paraview import smtrace
smtrace.start_trace()
""")


def session(state):
    """What is set on its filters, and their pictures."""
    load(state + ".pvsm")
    (scene,) = [view for _, view in views() if view.InteractionMode == "3D"]
    for bench in filters().values():
        check_camera(bench, scene)
    return {name: (values(bench), picture(bench, "Intensity")) for name, bench in filters().items()}


steps = [session(state) for state in ("clicked", "turned", "dragged", "compared")]
assert [len(step) for step in steps] == [1, 1, 1, 3]
for earlier, later in zip(steps, steps[1:]):
    assert np.abs(earlier["Schlieren1"][1] - later["Schlieren1"][1]).max() > 0.05 or later is steps[3]
assert steps[1]["Schlieren1"][0]["ViewDirection"] != steps[0]["Schlieren1"][0]["ViewDirection"]
assert float(steps[2]["Schlieren1"][0]["CutoffOffset"]) > 0

play_trace("traced.pvsm", OPEN_JET)
traced = session("traced")
assert traced.keys() == steps[-1].keys()
for name, (expected, intensity) in steps[-1].items():
    found, made = traced[name]
    assert found == expected, (name, [(key, expected[key], found[key]) for key in expected
                                      if expected[key] != found[key]])
    assert np.abs(made - intensity).max() < 1e-5, name
