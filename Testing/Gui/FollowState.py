# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""A state file is loaded while pictures are being refined, and while a mouse button is down: those of the
file and those before are right, and follow the new view of that name. And a followed view that is not there."""

import os

import numpy as np
from follow_testing import SCENE, saved, scripted
from views_testing import FOLDER, ViewsSession, simple
from plugin_testing import Schlieren, output
from vtkmodules.util.numpy_support import vtk_to_numpy
from window_testing import PANEL

# The filters, the 3-D view and the pictures' views.
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


def load_state(name):
    user.menu("menu_File", "actionFileLoadServerState")
    user.event("pqClientMainWindow/FileLoadServerStateDialog", "filesSelected", os.path.join(FOLDER, name))
    user.idle()


def keep(step):
    user.python(KEEP.format(step))


user.python(FIND + "shown.UseFXAA = 0")
keep("first")
user.save_state("first.pvsm")

# In the middle of a refinement. The menu's loading closes all views, and lets the filters be.
user.python(FIND + """
bench.SamplesPerPixel = shadows.SamplesPerPixel = 400
turned.CameraPosition = [40, 20, 50]
Render(turned)
until(lambda: not finished(bench), 20)
[RenameSource("closed " + name, FindSource(name)) for name in ("flow", "bench", "shadows")]
""")
load_state("first.pvsm")
keep("loaded")
user.python(FIND + """
assert (shown.UseFXAA, other.UseFXAA, turned.UseFXAA) == (0, 1, 1)
closed = FindSource("closed bench")
assert closed.SamplesPerPixel == 400 and closed.FollowedView == "RenderView1"
closed.SamplesPerPixel = 2
Hide(bench, shown)
Show(closed, shown).SetRepresentationType("Slice")
Render(shown)
save("closed", closed, turned)
Delete(closed)
Show(bench, shown)
""")

# While a mouse button is down, which is released over the new view.
user.view_event(1, "mousePress", (0.3, 0.5), 1, 1)
user.view_event(1, "mouseMove", (0.35, 0.55), 1, 1)
user.python("[RenameSource('dragged ' + name, FindSource(name)) for name in ('flow', 'bench', 'shadows')]")
load_state("first.pvsm")
keep("loadedDown")
user.view_event(1, "mouseMove", (0.5, 0.6), 1, 1)
user.view_event(1, "mouseRelease", (0.5, 0.6), 1, 0)
user.drag_view(1, (0.3, 0.5), (0.35, 0.55), (0.4, 0.6), (0.45, 0.6), (0.5, 0.6))
keep("turned")

# One whose followed view is not there: it stays as it is, can be changed, and follows another one when told.
user.python("""
with open(os.path.join(FOLDER, "first.pvsm")) as file:
    state = file.read()
parts = state.split('name="FollowedView"')
assert len(parts) == 3
parts[1:] = [part.replace('value="RenderView1"', 'value="Nowhere"', 1) for part in parts[1:]]
with open(os.path.join(FOLDER, "nowhere.pvsm"), "w") as file:
    file.write('name="FollowedView"'.join(parts))
[Delete(source) for (name, _), source in list(GetSources().items()) if "flow" not in name]
[Delete(source) for source in list(GetSources().values())]
""")
load_state("nowhere.pvsm")
user.python("SetActiveSource(FindSource('bench'))")
user.check("FollowedView/Choice", "currentText", "Nowhere (not there)")
user.drag_view(1, (0.3, 0.5), (0.35, 0.55), (0.4, 0.6), (0.45, 0.6), (0.5, 0.6))
keep("nowhere")
user.python("CreateView('RenderView', registrationName='Another')")
user.check("FollowedView/Choice", "currentText", "Nowhere (not there)")
user.python("Delete(FindView('Another'))")
user.check_at(PANEL + "/Accept", "enabled", "false")
user.check("FollowedView/Choice", "currentText", "Nowhere (not there)")
user.choose("KnifeEdgeAngle/DoubleRangeWidget/DoubleLineEdit", "90")
user.apply()
keep("changed")
user.check("FollowedView/Choice", "currentText", "Nowhere (not there)")
user.choose("FollowedView/Choice", "RenderView1")
user.check("FollowedView/Choice", "currentText", "RenderView1")
user.apply()
keep("following")
user.drag_view(1, (0.3, 0.5), (0.35, 0.55), (0.4, 0.6), (0.45, 0.6), (0.5, 0.6))
keep("followingOn")

user.play(SCENE)


def is_scripted(name, camera, bench="bench", **properties):
    """Whether a kept picture is the one of a script with a kept camera."""
    made = scripted(simple, Schlieren, saved(camera), bench)
    simple.SetProperties(made, SamplesPerPixel=2, **properties)
    values = vtk_to_numpy(output(made).GetPointData().GetArray("Intensity"))
    assert np.ptp(values) > (0.1 if bench == "bench" else 0.01), np.ptp(values)
    kept = saved(name)
    assert kept["reduction"] == 1 and kept["limit"] == 0
    return np.abs(values - kept["intensity"]).max() < 1e-5


for step in ("first", "loaded", "loadedDown", "turned"):
    assert is_scripted(step, step), step
    assert is_scripted(step + "Shadows", step, "shadows"), step
assert np.allclose(saved("loaded")["position0"], saved("first")["position0"])
assert is_scripted("closed", "closed")
assert not is_scripted("turned", "loadedDown")

for step in ("nowhere", "changed"):
    assert not np.allclose(saved(step)["position0"], saved("first")["position0"])
assert is_scripted("nowhere", "first") and is_scripted("nowhereShadows", "first", "shadows")
assert is_scripted("changed", "first", KnifeEdgeAngle=90)
assert not is_scripted("changed", "first")
for step in ("following", "followingOn"):
    assert is_scripted(step, step, KnifeEdgeAngle=90), step
    assert is_scripted(step + "Shadows", "first", "shadows"), step
assert not is_scripted("followingOn", "following", KnifeEdgeAngle=90)
