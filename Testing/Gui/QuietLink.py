# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""A change of the cutoff draws the image again, but not the 3-D view that is linked with it; a camera that moves, by a
script, by a reset or by the mouse, draws both, and the images of all views become complete."""

from views_testing import OPEN_JET, ViewsSession

HELPERS = """
import inside_window, time
scene, view = by_name("RenderView1", "Schlieren View")
(display,) = displays()
bench = display.SchlierenBench
def drawn_by(change):
    "How often the 3-D view and the image are drawn for a change."
    before = dict(inside_window.counts)
    change()
    settle_views()
    return [inside_window.counts[name] - before[name] for name in ("scene", "view")]
"""
user = ViewsSession()
user.press("OneImage")
user.python(HELPERS + """
Render(view)  # a script's first one resets the camera
settle_soon()
inside_window.counts = {"scene": 0, "view": 0}
def count(name):
    def note(*_):
        inside_window.counts[name] += 1
    return note
scene.SMProxy.AddObserver("EndEvent", count("scene"))
view.SMProxy.AddObserver("EndEvent", count("view"))

def turn_edge():
    bench.KnifeEdgeAngle = 30
    Render(view)
in_scene, in_view = drawn_by(turn_edge)
assert in_scene == 0 and in_view > 0, (in_scene, in_view)

def press_keys():
    plane = widget("propertiesPanel", "SchlierenCutoff", "Plane")
    plane.setFocus()
    since = time.process_time()
    for _ in range(5):
        QTest.keyClick(plane, Qt.Key.Key_Right)
        settle_views()
    print(f"A key takes {(time.process_time() - since) / 5:.2f} s of the processor", flush=True)
SetActiveView(view)
in_scene, in_view = drawn_by(press_keys)
assert in_scene == 0 and in_view > 0 and bench.CutoffOffset > 0, (in_scene, in_view)

def move(camera):
    def moved():
        camera.GetActiveCamera().Azimuth(10)
        Render(camera)
    return moved
for one in (scene, view):
    assert min(drawn_by(move(one))) > 0
    check_linked_now(scene, view)
def reset():
    view.GetActiveCamera().Dolly(2)
    Render(view)
    ResetCamera(view)
    Render(view)
assert min(drawn_by(reset)) > 0
check_linked_now(scene, view)
inside_window.before = dict(inside_window.counts)
""")
user.drag_view(1, (0.3, 0.5), (0.35, 0.55), (0.4, 0.6))
user.python(HELPERS + """
settle_views()
assert all(inside_window.counts[name] > inside_window.before[name] for name in inside_window.counts)
check_linked_now(scene, view)
assert information(display, "SchlierenReduction") == 1
""")
user.play(OPEN_JET)
