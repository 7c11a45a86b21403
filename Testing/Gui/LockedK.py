# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""In the views that the toolbar makes k is found once: it stays while the camera moves and the view changes its size, and
another view of the same technique has it; another technique has its own. Fit K Again finds it for the image as it is now, whatever
k was."""

from views_testing import OPEN_JET, ViewsSession
from window_testing import BENCH

HELPERS = """
def k_of(display):
    return information(display.SchlierenBench, "KScaleUsed")
def by_age():
    return sorted(displays(), key=lambda display: display.SMProxy.GetGlobalID())
"""

user = ViewsSession(BENCH)
user.press("OneImage")
user.python(HELPERS + """
import inside_window
settle_views()
(display,) = displays()
(view,) = by_name("Schlieren View")
inside_window.k = k_of(display)
assert inside_window.k > 0 and display.SchlierenBench.KMode == "Automatic Kept"
display.SchlierenBench.Quality = "Interactive"  # which makes images faster, and does not change k

# Only the lip of the nozzle is seen, in a view of another size.
view.CameraParallelProjection = 1
view.CameraFocalPoint = [0.001, 0.005, 0]
view.CameraPosition = [0.001, 0.005, 0.1]
view.CameraParallelScale = 0.0015
GetLayout(view).SetSplitFraction(0, 0.3)
Render(view)
settle_views()
assert k_of(display) == inside_window.k, (k_of(display), inside_window.k)
assert "k locked at" in information(display.SchlierenBench, "Status")
""")

# Another view of it.
user.press("OneImage")
user.python(HELPERS + """
import inside_window
until(lambda: len(displays()) == 2)
settle_views()
assert {k_of(display) for display in displays()} == {inside_window.k}, [k_of(display) for display in displays()]
(view,) = by_name("Schlieren View")
view.CameraFocalPoint = [0.001, 0.005, 0]
view.CameraPosition = [0.001, 0.005, 0.1]
view.CameraParallelScale = 0.0015
Render(view)
settle_views()
SetActiveView(view)
SetActiveSource(FindSource("jet"))
""")

# Found again.
user.python(HELPERS + """
click(widget("propertiesPanel", "SchlierenBench", "FitKAgain").findChild(QtWidgets.QPushButton))
import inside_window
settle_views()
inside_window.found = found = [k_of(display) for display in by_age()]
assert found[1] == inside_window.k and found[0] < 0.95 * inside_window.k, (found, inside_window.k)
""")

user.python(HELPERS + """
import inside_window
(display, _) = by_age()
display.SchlierenBench.Cutoff = "Circular"
RenderAllViews()
settle_views()
assert k_of(display) > 0 and k_of(display) != inside_window.k
""")
user.play(OPEN_JET)
