# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""One k for a series: that of the strongest image, in a view and in a filter; the abort button leaves the k that was."""

import os

import numpy as np
from views_testing import FOLDER, INSIDE, ViewsSession
from series_testing import write_series
from window_testing import BENCH

SERIES = os.path.join(FOLDER, "flow.pvd")
TIMES = list(range(41))


def blob(x, y, z, time):
    strength = 0.1 + 0.4 * max(0, 1 - abs(time - 20) / 10)
    return 1 - strength * np.maximum(0, 1 - (x**2 + y**2 + z**2) / 0.6**2)**2


HELPERS = """
import inside_window
def fit():
    click(widget("propertiesPanel", *inside_window.PANEL, "FitKOverSeries").findChild(QtWidgets.QPushButton))
def k():
    return information(inside_window.BENCH, "KScaleUsed")
def check():
    "Fits, at the first time, whose own k is five times that of the strongest."
    settle_views()
    abort, bench, own = widget("AbortButton"), inside_window.BENCH, k()
    end = click_during(bench.GetClientSideObject(), 0.02, abort)
    fit()
    end()
    inside_window.SETTLE()
    assert np.isclose(k(), own, rtol=1e-3), (k(), own)
    assert not abort.isEnabled()
    fit()
    inside_window.SETTLE()
    inside_window.fitted = k()
    assert np.isclose(k() / own, 0.2, rtol=0.01), (k(), own)
    assert "k locked at" in information(bench, "Status")
    assert not abort.isEnabled()
"""
KEPT = """
inside_window.SETTLE()
scene = GetAnimationScene()
for time in 20, 40, 0:
    scene.AnimationTime = time
    inside_window.SETTLE()
    assert k() == inside_window.fitted, (time, k())
"""

write_series(SERIES, TIMES, 25, blob)
user = ViewsSession(BENCH)
user.press("OneImage")
user.python(HELPERS + """
(display,) = displays()
inside_window.BENCH, inside_window.PANEL, inside_window.SETTLE = display.SchlierenBench, ["SchlierenBench"], settle_views
check()
""")
user.python(HELPERS + KEPT + "SetActiveSource(FindSource('flow'))\n")
user.choose_filter("Schlieren")
user.apply()
user.python(HELPERS + """
bench = FindSource("Schlieren1")
inside_window.BENCH, inside_window.PANEL, inside_window.SETTLE = bench, [], lambda: settle(bench)
settle(bench)
check()
""")
user.python(HELPERS + KEPT)
user.play(INSIDE + f"""
from paraview.simple import *
flow = OpenDataFile({SERIES!r}, registrationName="flow")
flow.UpdatePipeline()
GetAnimationScene().UpdateAnimationUsingDataTimeSteps()
view = GetActiveViewOrCreate("RenderView")
Show(flow, view)
view.ResetCamera()
SetActiveSource(flow)
""")
