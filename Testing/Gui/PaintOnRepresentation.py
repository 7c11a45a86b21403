# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Painting the colour filter through the image of data that are drawn as Schlieren, with a parallel and a perspective
camera: where the rays of the brushed pixels meet the filter, it is painted, and the view shows it. With an argument,
where a server makes the image; skipped without pvserver."""

import os
import sys

import numpy as np

sys.path.insert(0, os.path.join(os.environ["SCHLIEREN_SOURCE_DIR"], "Testing", "Python"))

from server_testing import connect, start_server  # noqa: E402
from views_testing import png, png_of_text  # noqa: E402
from window_testing import BENCH, DISPLAY, FOLDER, Session  # noqa: E402

WIDGET = BENCH + "/ColorFilterImage"
SIDE, K, COLOR, BRUSH = 256, 300, (10, 200, 30), 6
PLACES = {"parallel": (0.62, 0.42), "perspective": (0.45, 0.6)}
is_remote = len(sys.argv) > 1

user = Session()


def look(name):
    """Keeps what the filter is, where rays go and what the view shows."""
    user.python(f"""
view, display = GetActiveView(), GetDisplayProperties(FindSource("flow"), GetActiveView())
bench = display.SchlierenBench
until(lambda: finished(bench) and information(bench, "Status")[:7] != "Preview")
pause(0.5)
until(lambda: finished(bench) and information(bench, "Status")[:7] != "Preview")
deflection = [] if {is_remote} else \\
    vtk_to_numpy(bench.GetClientSideObject().GetOutputDataObject(0).GetPointData().GetArray("Deflection"))
np.savez(os.path.join(FOLDER, {name!r}), text=bench.ColorFilterImage, size=view.ViewSize, deflection=deflection,
         camera=view.CameraPosition)
SaveScreenshot(os.path.join(FOLDER, {name + ".png"!r}), view, ImageResolution=list(view.ViewSize))
""")


user.event(DISPLAY + "/Representation/displayRepresentationWidget/comboBox", "set_string", "Schlieren")
user.python(f"""
view, display = GetActiveView(), GetDisplayProperties(FindSource("flow"), GetActiveView())
display.SchlierenBench.Cutoff = "Color Filter"
display.SchlierenBench.KMode, display.SchlierenBench.KScale = "Value", {K}
display.SchlierenBench.GladstoneDaleConstant = 2e-6
Render(view)
""")
look("wheel")
user.event(WIDGET + "/Brush", "setChosenColor", ",".join(map(str, COLOR)))
user.event(WIDGET + "/BrushSize", "set_int", BRUSH)
for kind, place in PLACES.items():
    user.python(f"""
GetActiveView().CameraParallelProjection = {int(kind == "parallel")}
Render()
""")
    look("before" + kind)
    user.event(WIDGET + "/PaintOnImage", "activate")
    user.check_at(WIDGET + "/PaintOnImage", "checked", "true")
    user.drag_view(0, place, place)
    look(kind)
    user.event(WIDGET + "/PaintOnImage", "activate")
    user.check_at(WIDGET + "/PaintOnImage", "checked", "false")
    user.event(WIDGET + "/Clear", "activate")
user.event(WIDGET + "/PaintOnImage", "activate")
user.drag_view(0, (0.4, 0.4), (0.45, 0.5))
user.event(WIDGET + "/PaintOnImage", "activate")
user.check_at(WIDGET + "/Undo", "enabled", "true")
user.event(WIDGET + "/Undo", "activate")
look("taken")

# Another representation shows no such image.
user.event(DISPLAY + "/Representation/displayRepresentationWidget/comboBox", "set_string", "Outline")
user.python("""
from inside_window import widget
assert not widget("propertiesPanel", "SchlierenBench", "ColorFilterImage", "PaintOnImage").isVisible()
""")

server, prefix = None, "from paraview.simple import *"
if is_remote:
    server, port = start_server()
    prefix = connect(port)
try:
    user.play(prefix + """
flow = Calculator(Input=Wavelet(WholeExtent=3 * [-8, 8]), ResultArrayName="rho", Function="RTData", registrationName="flow")
flow.UpdatePipeline()
view = GetActiveViewOrCreate("RenderView")
view.OrientationAxesVisibility = view.CenterAxesVisibility = 0
Show(flow, view)
view.CameraParallelProjection = 1
ResetCamera()
SetActiveSource(flow)
Render()
""")
finally:
    if server:
        server.kill()


def seen(name):
    return np.load(os.path.join(FOLDER, name + ".npz"))


def shown(name):
    return png(os.path.join(FOLDER, name + ".png")).astype(int)


centres = (np.arange(SIDE) + 0.5) / SIDE * 2 - 1
on_filter = np.stack(np.meshgrid(centres, centres), axis=-1)
assert str(seen("wheel")["text"]) == str(seen("taken")["text"]) == ""
for kind, (x, y) in PLACES.items():
    kept = seen(kind)
    assert np.array_equal(kept["camera"], seen("before" + kind)["camera"]), "The view has turned."
    columns, rows = kept["size"]
    image = png_of_text(str(kept["text"]))
    painted = (image == COLOR).all(axis=2)
    assert painted.sum() > 100, kind
    changed = np.abs(shown(kind) - shown("before" + kind)).max(axis=2) > 20
    assert changed.sum() > 100, kind
    row, column = np.mgrid[:rows, :columns]
    away = np.hypot(column + 0.5 - x * columns, row + 0.5 - (1 - y) * rows) - BRUSH / 200 * min(rows, columns)
    assert changed[away < -2].mean() > 0.9, (kind, changed[away < -2].mean())
    if not is_remote:
        # The mouse is somewhere in a pixel, so that those at the circle's rim may be in or out.
        places = np.clip(K * kept["deflection"].reshape(rows, columns, 3)[..., :2], -1, 1)
        for points, is_in in ((places[away < -1.5], True), (places[away < 1.5], False)):
            distance = np.min([np.hypot(*(on_filter - point).transpose(2, 0, 1)) for point in points], axis=0)
            if is_in:
                assert painted[distance < BRUSH / 100 - 2 / SIDE].all(), kind
            else:
                assert not painted[distance > BRUSH / 100 + 2 / SIDE].any(), kind
