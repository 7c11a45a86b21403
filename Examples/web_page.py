# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""A jet in a web page, by trame: the mouse turns it, and a slider the knife edge. ParaView draws it where this runs.

    python3 -m venv --system-site-packages web && web/bin/pip install trame trame-vtk trame-vuetify
    Utilities/with-display pvpython Examples/web_page.py --venv web --server --port 8080

The page is then at http://localhost:8080. The first line's Python is that of pvpython: Debian's /usr/bin/python3.
"""

import os
import sys

from paraview.simple import *
from paraview.web import venv  # noqa: F401, which reads --venv

root = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
sys.path.insert(0, os.path.join(root, "Examples"))
from load_schlieren import load_schlieren  # noqa: E402

try:
    from trame.app import get_server
    from trame.ui.vuetify3 import SinglePageLayout
    from trame.widgets import paraview, vuetify3
except ImportError as error:
    sys.exit(f"{error}: give --venv a folder made as this script's first lines say.")

load_schlieren(globals())
jet = OpenDataFile(os.path.join(root, "Testing", "Data", "ladenburg_jet_3d.vti"))
view = CreateView("RenderView", ViewSize=[900, 480], OrientationAxesVisibility=0)
display = Show(jet, view)
display.SetRepresentationType("Schlieren")
display.SchlierenBench.Density = ["POINTS", "rho"]
view.CameraParallelProjection = 1
ResetCamera(view)

server = get_server()


@server.state.change("angle")
def turn_the_edge(angle, **_):
    display.SchlierenBench.KnifeEdgeAngle = float(angle)
    server.controller.show()


with SinglePageLayout(server) as page:
    page.title.set_text("Schlieren")
    with page.toolbar:
        vuetify3.VSlider(v_model=("angle", 90), min=0, max=360, step=15, label="Knife edge, degrees", thumb_label=True,
                         hide_details=True)
    with page.content, vuetify3.VContainer(fluid=True, classes="pa-0 fill-height"):
        server.controller.show = paraview.VtkRemoteView(view).update
server.start()
