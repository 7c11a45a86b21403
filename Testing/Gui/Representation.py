# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Data drawn as Schlieren in the window: chosen in the Representation box, turned by mouse, released, complete, and
changed in the panel and in the cutoff editor."""

import json
import os
import sys

import numpy as np

sys.path.insert(0, os.path.join(os.environ["SCHLIEREN_SOURCE_DIR"], "Testing", "Python"))

from plugin_testing import Schlieren, image_array, simple  # noqa: E402
from window_testing import BENCH, DISPLAY, FOLDER, Session  # noqa: E402

SETTINGS = ("Cutoff", "KMode", "KScale", "CutoffOffset", "KnifeEdgeAngle")
PLANE = BENCH + "/SchlierenCutoff/Plane"
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
         scale=camera.GetParallelScale(), **{{name: bench.GetProperty(name).GetData() for name in {1}}})
with open(os.path.join(FOLDER, "{0}.json"), "w") as file:
    file.write(str(LOG))
LOG.clear()
"""

user = Session()
user.event(DISPLAY + "/Representation/displayRepresentationWidget/comboBox", "set_string", "Schlieren")
user.python(SAVE.format("chosen", SETTINGS))
user.drag_view(0, (0.3, 0.5), (0.35, 0.55), (0.4, 0.6), (0.45, 0.6), (0.5, 0.6))
user.python(SAVE.format("turned", SETTINGS))
user.event(BENCH + "/Cutoff/ComboBox", "set_string", "Dark Field")
user.python(SAVE.format("changed", SETTINGS))

# The editor shows the light at the cutoff, and the edge that is dragged in it.
user.event(BENCH + "/Cutoff/ComboBox", "set_string", "Knife Edge")
user.python("""
plane = widget("propertiesPanel", "SchlierenBench", "SchlierenCutoff", "Plane")
until(lambda: plane.isEnabled() and plane.property("range") > 0)
side = plane.property("side")
middle = QPointF(20 + side / 2, 2 + side / 2 - 30)
left, none = Qt.MouseButton.LeftButton, Qt.MouseButton.NoButton
for event, shift, button, buttons in ((QEvent.Type.MouseButtonPress, 0, left, left),
                                      (QEvent.Type.MouseMove, 20, none, left),
                                      (QEvent.Type.MouseMove, 30, none, left),
                                      (QEvent.Type.MouseButtonRelease, 30, left, none)):
    place = middle + QPointF(shift, 0)
    QApplication.sendEvent(plane, QMouseEvent(
        event, place, QPointF(plane.mapToGlobal(place.toPoint())), button, buttons, Qt.KeyboardModifier.NoModifier))
    pause(0.1)
""" + SAVE.format("dragged", SETTINGS))

user.play("""
import inside_window
from inside_window import information
from paraview.simple import *
flow = Calculator(Input=Wavelet(WholeExtent=3 * [-30, 30]), ResultArrayName="rho", Function="RTData", registrationName="flow")
display = Show(flow)
display.SchlierenBench.Quality, display.SchlierenBench.KMode = "Interactive", "Automatic"
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

wavelet = simple.Calculator(Input=simple.Wavelet(WholeExtent=3 * [-30, 30]), ResultArrayName="rho", Function="RTData")
wavelet.UpdatePipeline()


def drawn(name):
    """What was drawn in this step, as the reductions of the images, after a check of the last one."""
    kept = np.load(os.path.join(FOLDER, name + ".npz"))
    bench = Schlieren(
        Input=wavelet, Density=["POINTS", "rho"], **{name: kept[name].item() for name in SETTINGS}, ImageSize=kept["size"].tolist(), ViewUp=kept["up"].tolist(),
        ViewDirection=(kept["focus"] - kept["position"]).tolist(), FocalPoint=kept["focus"].tolist(),
        ParallelScale=float(kept["scale"]))
    difference = np.abs(image_array(bench, "Intensity").ravel() - kept["intensity"])
    assert difference.max() < 1e-5, (name, difference.max(), difference.mean())
    with open(os.path.join(FOLDER, name + ".json"), encoding="utf-8") as file:
        return json.load(file)


assert drawn("chosen")[-1] == 1
turned = drawn("turned")
assert len(turned) >= 4 and turned[-1] == 1 and max(turned) > 1, turned
# Another cutoff needs no rays.
assert set(drawn("changed")) == {1}
assert np.load(os.path.join(FOLDER, "changed.npz"))["Cutoff"].item() == "Dark Field"
assert set(drawn("dragged")) == {1}
dragged = np.load(os.path.join(FOLDER, "dragged.npz"))
assert dragged["Cutoff"].item() == "Knife Edge" and dragged["CutoffOffset"].item() > 0.01, dict(dragged)
