# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""A schlieren view: a shortcut adds it, and Escape gives a drag of the cutoff up. k is found once: it stays while the
camera moves and the view changes its size, and another view of the same technique has it; another technique has its
own. Fit K Again finds it for the image as it is now, whatever k was."""

from window_testing import BENCH, OPEN_JET, ViewsSession

PLANE = "SchlierenCutoff/Plane"
SIDE, TOP = 280, 50  # pixels: of the plane; of what is free of other handles

user = ViewsSession(BENCH)
user.python("""
assert not displays()
press_key(Qt.Key.Key_L, Qt.KeyboardModifier.ControlModifier | Qt.KeyboardModifier.ShiftModifier)
until(displays)
settle_views()
(display,) = displays()
bench = display.SchlierenBench
assert bench.CutoffOffset == 0 and bench.KMode == "Automatic Kept"
""")
user.check(PLANE, "enabled", "true")
user.size_plane(SIDE)

# What a drag changes before it is cancelled, and what there is then.
LOOK = """
(display,) = displays()
bench = display.SchlierenBench
import inside_window
def same():
    kept, now = inside_window.before, intensity(bench)
    return finished(bench) and len(now) == len(kept) and np.abs(now - kept).max() < 1e-6
def check_given_up():
    until(same)
    assert bench.CutoffOffset == 0 and bench.KMode == "Automatic Kept" and bench.KnifeEdgeAngle == 0
"""


def mouse(event, buttons, x, y):
    user.event(f"{BENCH}/{PLANE}", event, f"{buttons},0,{x},{y}")


# The edge is a line up through the middle.
x, y = 20 + SIDE // 2, TOP
user.python(LOOK + "inside_window.before = intensity(bench)\n"
            "widget('propertiesPanel', 'SchlierenCutoff', 'Plane').setFocus()")
mouse("mousePress", "1,1", x, y)
mouse("mouseMove", "0,1", x + 20, y)
mouse("mouseMove", "0,1", x + 40, y)
user.python(LOOK + "until(lambda: bench.CutoffOffset > 0.01 and not same())\npress_key(Qt.Key.Key_Escape)\n"
            "check_given_up()")
user.check("CutoffOffset/DoubleLineEdit0", "text", 0)

# The mouse, still down, drags nothing any more.
mouse("mouseMove", "0,1", x + 60, y)
mouse("mouseRelease", "1,0", x + 60, y)
user.python(LOOK + "pause(0.3)\ncheck_given_up()")

# By a key that is still down.
user.python(LOOK + """
press_key(Qt.Key.Key_Right, release=False)
until(lambda: bench.CutoffOffset > 0 and not same())
press_key(Qt.Key.Key_Escape)
check_given_up()
""")
user.check("CutoffOffset/DoubleLineEdit0", "text", 0)

# There is nothing else to be undone than the view.
user.undo()
user.python("assert len(views()) == 1")

HELPERS = """
def k_of(display):
    return information(display.SchlierenBench, "KScaleUsed")
def by_age():
    return sorted(displays(), key=lambda display: display.SMProxy.GetGlobalID())
"""

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
click(widget("propertiesPanel", "SchlierenBench", "FitKAgain"))
import inside_window
settle_views()
inside_window.found = found = [k_of(display) for display in by_age()]
assert found[1] == inside_window.k and found[0] < 0.95 * inside_window.k, (found, inside_window.k)
""")

user.python(HELPERS + """
import inside_window
(display, _) = by_age()
display.SchlierenBench.Cutoff = "Bright Field"
RenderAllViews()
settle_views()
assert k_of(display) > 0 and k_of(display) != inside_window.k
""")
user.play(OPEN_JET)
