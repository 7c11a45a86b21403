# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""A flow that a view draws as Schlieren is refined: ParaView's progress bar says how far, the window responds meanwhile,
and the abort button stops it until the view is turned. With an argument, where a server makes the images; skipped
without pvserver."""

import os
import sys

import numpy as np
from server_testing import play
from views_testing import FOLDER, INSIDE, OPEN_JET, ViewsSession

REPORT = os.path.join(FOLDER, "turns.txt")
LONGEST = 0.07  # seconds until the window responds

user = ViewsSession()
user.press("OneImage")
user.python(f"""
import re
import inside_window
settle_views()
(display,), view = displays(), FindView("Schlieren View")
bench = display.SchlierenBench
abort, bar = widget("AbortButton"), widget("ProgressBar")
def line():
    return widget("Frame.2", "Viewport", "SchlierenStatus").text()
def is_refined():
    return re.match("Refining: [0-9]+ of 20000 samples", bar.text()) is not None
assert not abort.isEnabled() and bar.text() == ""
bench.TargetError = 0
bench.SamplesPerPixel = 20000
Render(view)
until(is_refined)
assert abort.isEnabled()
until(lambda: re.fullmatch("Refining: [0-9]+ of 20000 samples, about [0-9]+ (s|min|h)", bar.text()))
widget().grab().save(os.path.join(FOLDER, "refining.png"))
turns, end = [], inside_window.time.monotonic() + 5
while inside_window.time.monotonic() < end:
    turns.append(inside_window.process_events())
    assert is_refined() and 0 <= information(bench, "PercentDone") < 100
np.savetxt({REPORT!r}, turns)

# Stopped, it stays as it is, also where it is rendered and saved.
click(abort)
until(lambda: line().startswith("Stopped. "))
assert not abort.isEnabled() and bar.text() == ""
assert (information(bench, "Stopped"), information(display, "SchlierenFinished")) == (1, 1)
rays = information(bench, "TotalRaysTraced")
Render(view)
SaveScreenshot(os.path.join(FOLDER, "stopped.png"), view)
pause(1)
assert information(bench, "TotalRaysTraced") == rays and line().startswith("Stopped. ")

# Turned, it is made again.
view.GetActiveCamera().Azimuth(10)
bench.SamplesPerPixel = 2
Render(view)
settle_views()
assert information(bench, "Stopped") == 0 and line().startswith("2 samples"), line()
assert not abort.isEnabled() and bar.text() == ""

# Closed while it is refined.
bench.SamplesPerPixel = 20000
Render(view)
until(is_refined)
Delete(view)
until(lambda: bar.text() == "")
assert not abort.isEnabled()
""")

play(user, INSIDE + OPEN_JET, is_remote=len(sys.argv) > 1)

turns = np.loadtxt(REPORT)
print(f"The window responds within {1e3 * np.median(turns):.0f} ms, at most {1e3 * turns.max():.0f} ms.")
assert len(turns) > 20
# On a machine with nothing else to do it is LONGEST; blocked, it would be the time of a pass, a second and more.
assert np.median(turns) < 4 * LONGEST, np.sort(turns)[::-1]
