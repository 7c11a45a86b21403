# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""One k for a series: that of the strongest image, in a view and in a filter; the abort button leaves the k that was."""

import os

import numpy as np
from window_testing import BENCH, FOLDER, PROPERTIES, ViewsSession
from series_testing import write_series

SERIES = os.path.join(FOLDER, "flow.pvd")
TIMES = list(range(21))


def blob(x, y, z, time):
    strength = 0.1 + 0.4 * max(0, 1 - abs(time - 10) / 5)
    return 1 - strength * np.maximum(0, 1 - (x**2 + y**2 + z**2) / 0.6**2)**2


HELPERS = """
import inside_window
def fit():
    QTimer.singleShot(0, widget("propertiesPanel", *inside_window.PANEL).findChild(QAction, "FitKOverSeries").trigger)
    process_events()
def k():
    return information(inside_window.BENCH, "KScaleUsed")
def check():
    "Fits, at the first time, whose own k is five times that of the strongest."
    settle_views()
    abort, bench, own = widget("AbortButton"), inside_window.BENCH, k()
    end = click_during(bench.GetClientSideObject(), 0.04, abort)
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
for time in 10, 20, 0:
    scene.AnimationTime = time
    inside_window.SETTLE()
    assert k() == inside_window.fitted, (time, k())
"""

write_series(SERIES, TIMES, 21, blob)
user = ViewsSession(BENCH)
user.press("OneImage")
user.python(HELPERS + """
(display,) = displays()
inside_window.BENCH, inside_window.PANEL, inside_window.SETTLE = display.SchlierenBench, ["SchlierenBench"], settle_views
check()
""")
user.python(HELPERS + KEPT + "SetActiveSource(FindSource('flow'))\n")
user.choose_filter("Schlieren")
user.properties = PROPERTIES
user.choose("ImageSize/LineEdit0", "64")
user.choose("ImageSize/LineEdit1", "64")
user.choose("Quality/ComboBox", "Interactive")  # that of the fit, too
user.apply()
user.python(HELPERS + """
bench = FindSource("Schlieren1")
inside_window.BENCH, inside_window.PANEL, inside_window.SETTLE = bench, [], lambda: settle(bench)
settle(bench)
check()
""")
user.python(HELPERS + KEPT)
user.play(f"""
from paraview.simple import *
flow = OpenDataFile({SERIES!r}, registrationName="flow")
flow.UpdatePipeline()
GetAnimationScene().UpdateAnimationUsingDataTimeSteps()
view = GetActiveViewOrCreate("RenderView")
Show(flow, view)
view.ResetCamera()
SetActiveSource(flow)
""")
