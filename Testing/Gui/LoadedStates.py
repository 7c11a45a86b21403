# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""State files: images of filters look as they did, and stay so when a view of the flow is turned."""

import os

import numpy as np
from filter_testing import SCENE, saved, scripted
from views_testing import FOLDER, ViewsSession, simple
from plugin_testing import Schlieren, output
from vtkmodules.util.numpy_support import vtk_to_numpy

# The filters, the 3-D view and the images' views.
FIND = """
def parts():
    bench, shadows = by_name("bench", "shadows")
    def view_of(source):
        (view,) = [view for view in GetRenderViews() if view.SMProxy.FindRepresentation(source.SMProxy, 0)]
        return view
    (turned,) = [view for view in GetRenderViews() if view.InteractionMode == "3D"]
    return bench, shadows, turned, view_of(bench), view_of(shadows)
bench, shadows, turned, shown, other = parts()
"""
KEEP = FIND + """
bench.SamplesPerPixel = shadows.SamplesPerPixel = 2
Render(shown)
Render(other)
settle(bench, shadows)
save({0!r}, bench, turned, shown)
save({0!r} + "Shadows", shadows, turned, other)
"""

user = ViewsSession()


def keep(step):
    user.python(KEEP.format(step))


user.python(FIND + """
for source in bench, shadows:
    source.ViewDirection, source.ViewUp, source.FocalPoint = [-0.6, 0, -0.8], [0, 1, 0], [1, 0, 0]
    source.ParallelScale = 12
""")
keep("first")
user.save_state("first.pvsm")

# The menu's loading closes all views, and lets the filters be.
user.python(FIND + """
bench.SamplesPerPixel = 5
[RenameSource("closed " + name, FindSource(name)) for name in ("flow", "bench", "shadows")]
""")
user.menu("menu_File", "actionFileLoadServerState")
user.event("pqClientMainWindow/FileLoadServerStateDialog", "filesSelected", os.path.join(FOLDER, "first.pvsm"))
user.idle()
keep("loaded")
user.python(FIND + """
closed = FindSource("closed bench")
assert closed.SamplesPerPixel == 5
closed.SamplesPerPixel = 2
Hide(bench, shown)
Show(closed, shown).SetRepresentationType("Slice")
Render(shown)
settle(closed)
save("closed", closed, turned)
Delete(closed)
Show(bench, shown)
""")
user.drag_view(1, (0.3, 0.5), (0.35, 0.55), (0.4, 0.6), (0.45, 0.6), (0.5, 0.6))
keep("turned")
user.play(SCENE)

for step in ("first", "loaded", "turned", "closed"):
    for name in ("bench", "shadows")[:1 if step == "closed" else 2]:
        kept = saved(step + ("Shadows" if name == "shadows" else ""))
        made = scripted(simple, Schlieren, kept, name)
        simple.SetProperties(made, SamplesPerPixel=2)
        intensity = vtk_to_numpy(output(made).GetPointData().GetArray("Intensity"))
        assert np.ptp(intensity) > (0.1 if name == "bench" else 0.01), np.ptp(intensity)
        assert np.abs(intensity - kept["intensity"]).max() < 1e-5, (step, name)
        assert np.allclose(kept["direction"], [-0.6, 0, -0.8]) and kept["scale"] == 12
assert np.allclose(saved("loaded")["position1"], saved("first")["position1"])
assert not np.allclose(saved("turned")["position0"], saved("loaded")["position0"])
