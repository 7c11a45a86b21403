# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The knife dragged, the colour filter painted, and the menu's Disconnect, with
a server and without: the same images, and afterwards one click makes another. Skipped without pvserver."""

import numpy as np
from server_testing import connect, start_server
from filter_testing import saved
from views_testing import ViewsSession, check_linked, drawn, filters, load, image_array, simple, values, views
from representation_testing import pixels_of

K = 200
SETTINGS = {"ImageSize": [96, 96], "GladstoneDaleConstant": 2e-6, "KMode": "Value", "KScale": K}
SIDE = 280  # pixels of the cutoff plane, where all of it is from -0.005 to 0.005 both ways
PLANE, PREVIEW = "SchlierenCutoff/Plane", "ColorFilterImage/Preview"
SETTLE = """
(bench,) = [source for source in GetSources().values() if source.GetXMLName() == "Schlieren"]
settle(bench)
"""
FLOW = """
from paraview.simple import *
flow = Calculator(Input=Wavelet(WholeExtent=3 * [-8, 8]), ResultArrayName="rho", Function="RTData", registrationName="flow")
flow.UpdatePipeline()
"""
SCENE = FLOW + f"""
import os, sys
sys.path.insert(0, os.path.join(os.environ["SCHLIEREN_SOURCE_DIR"], "Testing", "Gui"))
bench = Schlieren(Input=flow, registrationName="bench", **{SETTINGS})
view = GetActiveViewOrCreate("RenderView")
Show(bench, view)
ResetCamera(view)
Render()
SetActiveSource(bench)
"""


def session(name, before):
    """Plays it after a script, for states of this name."""
    user = ViewsSession()

    def keep(step):
        user.python(SETTLE + f"save({name + step!r}, bench)")
        user.save_state(name + step + ".pvsm")

    keep("first")
    user.check(PLANE, "enabled", "true")
    user.size_plane(SIDE)
    user.check(PLANE, "range", 0.005)
    x, y = 20 + SIDE // 2, 2 + SIDE // 2 - 30
    user.drag(PLANE, (x, y), (x + 40, y), (x + 21, y))
    user.menu("menu_Edit", "actionEditUndo")
    user.check("CutoffOffset/DoubleLineEdit0", "text", 0)
    user.menu("menu_Edit", "actionEditRedo")
    keep("dragged")
    user.choose("CutoffOffset/DoubleLineEdit0", "0")
    user.choose("Cutoff/ComboBox", "Color Filter")
    user.apply()
    user.python(SETTLE)
    user.drag(PREVIEW, (80, 90), (150, 90))
    keep("painted")
    user.click("ColorFilterImage/PaintOnImage")
    user.drag_view(0, (0.5, 0.5), (0.55, 0.55))
    keep("brushed")
    user.click("ColorFilterImage/PaintOnImage")

    if name:
        user.python(SETTLE + """
bench.SamplesPerPixel = 2
Render()
""")
        user.menu("menu_File", "actionServerDisconnect")
        user.event("pqClientMainWindow/1QMessageBox0/qt_msgbox_buttonbox/1QPushButton0", "activate")
        user.python("pause(0.3)\nassert not GetSources()\n" + FLOW + """
view = GetActiveViewOrCreate("RenderView")
Show(flow, view)
ResetCamera(view)
SetActiveSource(flow)
""")
        user.press("OneImage")
        user.python("settle_views()")
        user.save_state("afterwards.pvsm")
    user.play(before + SCENE)


session("", "")
server, port = start_server()
try:
    session("served ", connect(port))
finally:
    server.kill()


def values_of(state):
    """What is set on its filter, the image that the window had, and the one of the state."""
    load(state + ".pvsm")
    (bench,) = filters().values()
    shown = saved(state)["intensity"]
    assert np.ptp(shown) > 0.2
    assert np.abs(shown - image_array(bench, "Intensity").ravel()).max() < 1e-5, state
    return values(bench), shown


steps = [[values_of(name + step) for step in ("first", "dragged", "painted", "brushed")]
         for name in ("", "served ")]
for (here, image_here), (there, image_there) in zip(*steps):
    assert here == there, [(name, here[name], there[name]) for name in here if here[name] != there[name]]
    assert np.abs(image_here - image_there).max() < 1e-5
(first, dragged, painted, brushed) = steps[1]
assert float(first[0]["CutoffOffset"]) == 0
assert float(dragged[0]["CutoffOffset"]) == round(K * 21 * 0.01 / SIDE, 3)
assert painted[0]["ColorFilterImage"].startswith("data:image/png")
assert brushed[0]["ColorFilterImage"] not in ("", painted[0]["ColorFilterImage"])
for (_, before), (_, after) in zip(steps[1], steps[1][1:]):
    assert np.abs(before - after).max() > 0.01

load("afterwards.pvsm")
((_, scene), (_, view)) = views()
check_linked("afterwards.pvsm", scene, view)
assert np.ptp(pixels_of(view, (120, 90))) > 50
drawn(simple.FindSource("flow"), view)
