# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""A flow in a 3-D view, and the images of filters beside it."""

import os

import numpy as np
from window_testing import FOLDER

SIZE = 96

# The script that sets it up: "flow" in RenderView1, "bench" in RenderView2 and "shadows" in RenderView3.
SCENE = f"""
from paraview.simple import *
flow = Calculator(Input=Wavelet(WholeExtent=3 * [-8, 8]), ResultArrayName="rho", Function="RTData", registrationName="flow")
flow.UpdatePipeline()
turned = GetActiveViewOrCreate("RenderView")
Show(flow, turned).SetRepresentationType("Outline")
ResetCamera(turned)
benches = {{}}
for place, (name, cutoff) in enumerate((("bench", "Knife Edge"), ("shadows", "Shadowgraph"))):
    layout = GetLayout(turned)
    layout.SplitHorizontal(0 if place == 0 else 2, 0.5)
    view = CreateView("RenderView")
    AssignViewToLayout(view, layout, 2 if place == 0 else 6)
    SetActiveSource(flow)
    bench = Schlieren(Input=flow, registrationName=name, ImageSize={[SIZE, SIZE]}, Cutoff=cutoff,
                      GladstoneDaleConstant=1e-6, Quality="Fine", KMode="Automatic")
    shown = Show(bench, view)
    shown.SetRepresentationType("Slice")
    ColorBy(shown, ("POINTS", "Intensity"))
    view.InteractionMode = "2D"
    ResetCamera(view)
    Render(view)
    benches[name] = bench
SetActiveSource(benches["bench"])
"""


def saved(name):
    with np.load(os.path.join(FOLDER, name + ".npz")) as kept:
        return dict(kept)
