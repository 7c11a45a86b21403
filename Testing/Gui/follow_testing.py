# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""A flow in a 3-D view, and pictures beside it that follow its camera."""

import os

import numpy as np
from window_testing import FOLDER

SIZE = 96

# The script that sets it up: "bench" in RenderView2 and "shadows" in RenderView3 follow RenderView1.
SCENE = f"""
import os, sys
sys.path.insert(0, os.path.join(os.environ["SCHLIEREN_SOURCE_DIR"], "Testing", "Gui"))
from paraview.simple import *
flow = Wavelet(WholeExtent=3 * [-8, 8], registrationName="flow")
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
                      GladstoneDaleConstant=1e-6, Quality="Draft", FollowedView="RenderView1")
    shown = Show(bench, view)
    shown.SetRepresentationType("Slice")
    ColorBy(shown, ("POINTS", "Intensity"))
    view.InteractionMode = "2D"
    ResetCamera(view)
    Render(view)
    benches[name] = bench
SetActiveSource(benches["bench"])
"""


def scripted(simple, schlieren, camera, name="bench"):
    """The picture that a script makes of what a saved camera sees, by a filter of its own."""
    position, focus = camera["position0"], camera["focal_point0"]
    direction = (focus - position) / np.linalg.norm(focus - position)
    # The middle of the data, at 0, has the same size in both.
    scale = (camera["parallel_scale0"] if camera["parallel0"]
             else -position @ direction * np.tan(np.radians(camera["angle0"]) / 2))
    flow = simple.Wavelet(WholeExtent=3 * [-8, 8])
    flow.UpdatePipeline()
    return schlieren(Input=flow, ImageSize=[SIZE, SIZE], GladstoneDaleConstant=1e-6, Quality="Draft",
                     Cutoff={"bench": "Knife Edge", "shadows": "Shadowgraph"}[name],
                     ViewDirection=list(direction), ViewUp=list(camera["view_up0"]),
                     FocalPoint=list(focus), ParallelScale=float(scale))


def saved(name):
    with np.load(os.path.join(FOLDER, name + ".npz")) as kept:
        return dict(kept)
