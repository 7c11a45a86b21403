# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Data drawn as Schlieren in the window: chosen in the Representation box, turned by mouse, released, complete, and
changed in the panel."""

import json
import os

import numpy as np
from plugin_testing import simple
from representation_testing import filter_like
from window_testing import FOLDER, PANEL, Session

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
user.event(DISPLAY + "/SchlierenBench/Frame/ProxyPanel/Cutoff/ComboBox", "set_string", "Circular Complement")
user.python(SAVE.format("changed") + """
widget().grab().save(os.path.join(FOLDER, "window.png"))
""")
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
