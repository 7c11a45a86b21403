# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The keyboard: a shortcut adds a schlieren view, and Escape gives a drag of the cutoff up."""

import os

from views_testing import FOLDER, INSIDE, OPEN_JET, ViewsSession, drawn, load, simple, views
from window_testing import BENCH

REPORT = os.path.join(FOLDER, "report.txt")
with open(REPORT, "w", encoding="utf-8"):
    pass
PLANE = "SchlierenCutoff/Plane"
SIDE, TOP = 280, 50  # pixels: of the plane; of what is free of other handles

user = ViewsSession(BENCH)
user.python("""
assert not displays()
press_key(Qt.Key.Key_L, Qt.KeyboardModifier.ControlModifier | Qt.KeyboardModifier.ShiftModifier)
until(displays)
settle_views()
""")
user.save_state("added.pvsm")
user.check(PLANE, "enabled", "true")
user.size_plane(SIDE)

# What a drag changes before it is cancelled, and what there is then.
LOOK = f"""
(display,) = displays()
bench = display.SchlierenBench
def intensity():
    image = bench.GetClientSideObject().GetOutputDataObject(0)
    return np.array(vtk_to_numpy(image.GetPointData().GetArray("Intensity")))
def path(name):
    return os.path.join(FOLDER, name + ".npy")
def same():
    kept = np.load(path("before"))
    return finished(bench) and len(intensity()) == len(kept) and np.abs(intensity() - kept).max() < 1e-6
def check_given_up(text):
    until(same)
    assert bench.CutoffOffset == 0 and bench.KMode == "Automatic Kept" and bench.KnifeEdgeAngle == 0
    with open({REPORT!r}, "a") as file:
        file.write(text + "\\n")
"""


def mouse(event, buttons, x, y):
    user.event(f"{BENCH}/{PLANE}", event, f"{buttons},0,{x},{y}")


# The edge is a line up through the middle.
x, y = 20 + SIDE // 2, TOP
user.python(LOOK + "np.save(path('before'), intensity())\n"
            "widget('propertiesPanel', 'SchlierenCutoff', 'Plane').setFocus()")
mouse("mousePress", "1,1", x, y)
mouse("mouseMove", "0,1", x + 20, y)
mouse("mouseMove", "0,1", x + 40, y)
user.python(LOOK + "until(lambda: bench.CutoffOffset > 0.01 and not same())\npress_key(Qt.Key.Key_Escape)\n"
            "check_given_up('dragged')")
user.check("CutoffOffset/DoubleLineEdit0", "text", 0)

# The mouse, still down, drags nothing any more.
mouse("mouseMove", "0,1", x + 60, y)
mouse("mouseRelease", "1,0", x + 60, y)
user.python(LOOK + "pause(0.3)\ncheck_given_up('released')")

# By a key that is still down.
user.python(LOOK + """
press_key(Qt.Key.Key_Right, release=False)
until(lambda: bench.CutoffOffset > 0 and not same())
press_key(Qt.Key.Key_Escape)
check_given_up('key')
""")
user.check("CutoffOffset/DoubleLineEdit0", "text", 0)
user.save_state("given_up.pvsm")

# There is nothing else to be undone than the view.
user.undo()
user.save_state("undone.pvsm")
user.play(INSIDE + OPEN_JET)

with open(REPORT, encoding="utf-8") as file:
    steps = file.read().split("\n")
assert steps == ["dragged", "released", "key", ""], steps

for state in ("added", "given_up"):
    load(state + ".pvsm")
    _, (_, view) = views()
    bench = drawn(simple.FindSource("jet"), view).SchlierenBench
    assert bench.CutoffOffset == 0 and bench.KMode == "Automatic Kept"
load("undone.pvsm")
assert len(views()) == 1
