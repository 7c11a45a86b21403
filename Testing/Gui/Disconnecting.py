# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The knife dragged, the colour filter painted, and the menu's Disconnect, with
a server; afterwards the same images are made without one, and one click makes another. Skipped without pvserver."""

import json
import os

import numpy as np
from server_testing import play
from filter_testing import saved
from window_testing import FOLDER, ViewsSession

K = 200
SETTINGS = {"ImageSize": [96, 96], "GladstoneDaleConstant": 2e-6, "KMode": "Value", "KScale": K, "Quality": "Interactive"}
SIDE = 280  # pixels of the cutoff plane, where all of it is from -0.005 to 0.005 both ways
PLANE, PREVIEW = "SchlierenCutoff/Plane", "ColorFilterImage/Preview"
SETTLE = """
(bench,) = [source for source in GetSources().values() if source.GetXMLName() == "Schlieren"]
settle(bench)
"""
SCENE = f"""
from paraview.simple import *
flow = Calculator(Input=Wavelet(WholeExtent=3 * [-8, 8]), ResultArrayName="rho", Function="RTData", registrationName="flow")
flow.UpdatePipeline()
bench = Schlieren(Input=flow, registrationName="bench", **{SETTINGS})
view = GetActiveViewOrCreate("RenderView")
Show(bench, view)
ResetCamera(view)
Render()
SetActiveSource(bench)
"""


user = ViewsSession()


def keep(step):
    user.python(SETTLE + f"""
import json
save({step!r}, bench)
with open(os.path.join(FOLDER, {step + ".json"!r}), "w") as file:
    json.dump(values(bench), file)
""")


def steps(name):
    """Of a filter; what is kept has this name."""
    keep(name + "first")
    user.check(PLANE, "enabled", "true")
    user.size_plane(SIDE)
    user.check(PLANE, "range", 0.005)
    x, y = 20 + SIDE // 2, 2 + SIDE // 2 - 30
    user.drag(PLANE, (x, y), (x + 40, y), (x + 21, y))
    user.menu("menu_Edit", "actionEditUndo")
    user.check("CutoffOffset/DoubleLineEdit0", "text", 0)
    user.menu("menu_Edit", "actionEditRedo")
    keep(name + "dragged")
    user.choose("CutoffOffset/DoubleLineEdit0", "0")
    user.choose("Cutoff/ComboBox", "Color Filter")
    user.apply()
    user.python(SETTLE)
    user.drag(PREVIEW, (80, 90), (150, 90))
    keep(name + "painted")
    user.click("ColorFilterImage/PaintOnImage")
    user.drag_view(0, (0.5, 0.5), (0.55, 0.55))
    keep(name + "brushed")
    user.click("ColorFilterImage/PaintOnImage")


steps("served ")
user.python(SETTLE + """
bench.SamplesPerPixel = 2
Render()
""")
user.menu("menu_File", "actionServerDisconnect")
user.event("pqClientMainWindow/1QMessageBox0/qt_msgbox_buttonbox/1QPushButton0", "activate")
user.python("until(lambda: not GetSources())\n" + SCENE)
steps("")
user.python("""
view = GetActiveView()
Hide(FindSource("bench"), view)
flow = FindSource("flow")
Show(flow, view)
ResetCamera(view)
SetActiveSource(flow)
""")
user.press("OneImage")
user.python("""
((_, scene), (_, view)) = views()
check_linked_now(scene, view)
drawn(FindSource("flow"), view).SchlierenBench.Quality = "Interactive"
Render(view)
settle_views()
assert np.ptp(intensity(drawn(FindSource("flow"), view).SchlierenBench)) > 0.2
""")
play(user, SCENE, is_remote=True)


def kept(step):
    """What was set on the filter, and its image."""
    image = saved(step)["intensity"]
    assert np.ptp(image) > 0.2
    with open(os.path.join(FOLDER, step + ".json"), encoding="utf-8") as file:
        return json.load(file), image


found = [[kept(name + step) for step in ("first", "dragged", "painted", "brushed")] for name in ("", "served ")]
for (here, image_here), (there, image_there) in zip(*found):
    assert here == there, [(name, here[name], there[name]) for name in here if here[name] != there[name]]
    assert np.abs(image_here - image_there).max() < 1e-5
(first, dragged, painted, brushed) = found[1]
assert float(first[0]["CutoffOffset"]) == 0
assert float(dragged[0]["CutoffOffset"]) == round(K * 21 * 0.01 / SIDE, 3)
assert painted[0]["ColorFilterImage"].startswith("data:image/png")
assert brushed[0]["ColorFilterImage"] not in ("", painted[0]["ColorFilterImage"])
for (_, before), (_, after) in zip(found[1], found[1][1:]):
    assert np.abs(before - after).max() > 0.01
