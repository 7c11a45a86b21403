# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Data drawn as Schlieren in the window: chosen in the Representation box, turned by mouse, released, complete, and
changed in the panel."""

import json
import os
import sys

import numpy as np

sys.path.insert(0, os.path.join(os.environ["SCHLIEREN_SOURCE_DIR"], "Testing", "Python"))

from plugin_testing import Schlieren, picture, simple  # noqa: E402
from window_testing import FOLDER, PANEL, Session  # noqa: E402

DISPLAY = PANEL + "/scrollArea/qt_scrollarea_viewport/scrollAreaWidgetContents/DisplayFrame/ProxyPanel"
SAVE = """
import inside_window
LOG = inside_window.LOG
view, display = GetActiveView(), GetDisplayProperties(FindSource("flow"), GetActiveView())
assert display.Representation == "Schlieren", display.Representation
bench = display.SchlierenBench
until(lambda: information(display, "SchlierenFinished") == 1)
image = bench.GetClientSideObject().GetOutputDataObject(0)
assert information(display, "SchlierenReduction") == 1
size = view.ViewSize
assert image.GetDimensions()[:2] == tuple(size), (image.GetDimensions(), size)
camera = view.GetActiveCamera()
np.savez(os.path.join(FOLDER, "{0}.npz"), intensity=vtk_to_numpy(image.GetPointData().GetArray("Intensity")),
         size=size, position=camera.GetPosition(), focus=camera.GetFocalPoint(), up=camera.GetViewUp(),
         scale=camera.GetParallelScale(), cutoff=bench.Cutoff)
with open(os.path.join(FOLDER, "{0}.json"), "w") as file:
    file.write(str(LOG))
LOG.clear()
"""

user = Session()
user.event(DISPLAY + "/Representation/displayRepresentationWidget/comboBox", "set_string", "Schlieren")
user.python(SAVE.format("chosen"))
user.drag_view(0, (0.3, 0.5), (0.35, 0.55), (0.4, 0.6), (0.45, 0.6), (0.5, 0.6))
user.python(SAVE.format("turned"))
user.event(DISPLAY + "/SchlierenBench/ProxySelectionWidget/frame/ChosenProxyWidget/Cutoff/ComboBox", "set_string",
           "Circular Complement")
user.python(SAVE.format("changed"))
user.play("""
import inside_window
from inside_window import information
from paraview.simple import *
flow = Wavelet(registrationName="flow", WholeExtent=3 * [-30, 30])
display = Show(flow)
view = GetActiveView()
view.CameraParallelProjection = 1
ResetCamera()
SetActiveSource(flow)
Render()
# What has been drawn.
inside_window.LOG = []
def note(*_):
    inside_window.LOG.append(information(display, "SchlierenReduction"))
view.SMProxy.AddObserver("EndEvent", note)
""")

wavelet = simple.Wavelet(WholeExtent=3 * [-30, 30])
wavelet.UpdatePipeline()


def drawn(name):
    """What was drawn in this step, as the reductions of the images, after a check of the last one."""
    kept = np.load(os.path.join(FOLDER, name + ".npz"))
    bench = Schlieren(
        Input=wavelet, Density=["POINTS", "RTData"], Cutoff=kept["cutoff"].item(), ImageSize=kept["size"].tolist(), ViewUp=kept["up"].tolist(),
        ViewDirection=(kept["focus"] - kept["position"]).tolist(), FocalPoint=kept["focus"].tolist(),
        ParallelScale=float(kept["scale"]))
    difference = np.abs(picture(bench, "Intensity").ravel() - kept["intensity"])
    assert difference.max() < 1e-5, (name, difference.max(), difference.mean())
    with open(os.path.join(FOLDER, name + ".json"), encoding="utf-8") as file:
        return json.load(file)


assert drawn("chosen")[-1] == 1
turned = drawn("turned")
assert len(turned) >= 4 and turned[-1] == 1 and max(turned) > 1, turned
# Another cutoff needs no rays.
assert set(drawn("changed")) == {1}
assert np.load(os.path.join(FOLDER, "changed.npz"))["cutoff"].item() == "Circular Complement"
