# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Views that the toolbar makes begin in parallel projection, as large as they were seen before: there waves have an image.
It is undone with them. A perspective that is chosen later stays that of other views."""

from views_testing import OPEN_JET, ViewsSession

HELPERS = """
import inside_window
def height(view):
    "What the view shows at the depth of its focal point."
    camera = view.GetActiveCamera()
    return (camera.GetParallelScale() if camera.GetParallelProjection()
            else camera.GetDistance() * np.tan(np.radians(camera.GetViewAngle() / 2)))
def check_projection(is_parallel, count):
    assert len(GetRenderViews()) == count
    assert {bool(view.CameraParallelProjection) for view in GetRenderViews()} == {is_parallel}
"""
user = ViewsSession()
user.python(HELPERS + """
check_projection(False, 1)
view = GetActiveView()
GetLayout(view).SplitVertical(0, 0.5)  # half as high, so that a view beside it is not narrow
process_events()
ResetCamera(view)
inside_window.height = height(view)
""")
user.press("OneImage")
user.python(HELPERS + """
check_projection(True, 2)
for view in GetRenderViews():
    assert np.isclose(height(view), inside_window.height), (height(view), inside_window.height)
check_linked_now(*by_name("RenderView1", "Schlieren View"))
""")
user.undo()
user.python(HELPERS + "check_projection(False, 1)\nassert np.isclose(height(GetActiveView()), inside_window.height)")
user.redo()
user.python(HELPERS + """
check_projection(True, 2)
(display,) = displays()
bench = display.SchlierenBench
bench.LightModel = "Waves"
bench.Cutoff = "Phase Contrast"
settle_soon()
image = intensity(bench)
assert len(image) and np.ptp(image) > 0.05, np.ptp(image)
bench.Cutoff = "Knife Edge"
bench.LightModel = "Rays"
scene = FindView("RenderView1")
scene.CameraParallelProjection = 0
Render(scene)
SetActiveView(scene)
""")
user.press("OneImage")
user.python(HELPERS + "check_projection(False, 3)")
user.play(OPEN_JET)
