# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""ParaView's abort button where Apply waits for the image of a filter, with the builtin server: there is none then, until
something is changed. Where a view waits for the refractive index of data that are to be drawn as Schlieren, it stops
that, and another setting begins anew."""

from window_testing import DISPLAY, MESH, ViewsSession

BOX = DISPLAY + "/Representation/displayRepresentationWidget/comboBox"
STEPS = """
bench = FindSource("Schlieren1")
abort, accept = widget("AbortButton"), widget("propertiesPanel", "Accept")
def points(source):
    return source.GetDataInformation().GetNumberOfPoints()
def line():
    return widget("Frame.2", "Viewport", "SchlierenStatus").text()
def apply_and_abort(source, fraction):
    end = click_during(source.GetClientSideObject(), fraction, abort)
    click(accept)
    end()
    assert not abort.isEnabled()
"""

user = ViewsSession()
user.choose_filter("Schlieren")
user.choose("ImageSize/LineEdit0", "256")
user.choose("ImageSize/LineEdit1", "256")
user.apply()
user.python(STEPS + """
settle(bench)
assert points(bench) == 256 * 256 and not line().startswith("No image")
""")

# The image.
user.type("SamplesPerPixel/LineEdit0", "800")
user.python(STEPS + """
apply_and_abort(bench, 0.05)
assert points(bench) == 0 and line() == "No image: it was stopped", (points(bench), line())

# Neither rendering nor an update requests more.
Render(FindView("Image of Schlieren1"))
bench.UpdatePipeline()
assert points(bench) == 0
""")
user.type("SamplesPerPixel/LineEdit0", "2")
user.apply()
user.python(STEPS + """
settle(bench)
assert points(bench) == 256 * 256 and information(bench, "Status").startswith("2 samples")
Delete(bench)
Delete(FindView("Image of Schlieren1"))

# Drawn in a view.
import inside_window
view = FindView("RenderView1")
SetActiveView(view)
HideAll(view)
flow = Tetrahedralize(Input=Calculator(Input=Wavelet(WholeExtent=3 * [-24, 24]), ResultArrayName="rho", Function="RTData"), registrationName="flow")
display = Show(flow, view)
display.SetRepresentationType("Outline")
ResetCamera(view)
SetActiveSource(flow)
Render(view)
made = display.SchlierenBench.GetClientSideObject()
inside_window.END = click_during(made, 0.05, abort)
inside_window.SAID = []
made.AddObserver("ProgressEvent", lambda *_: inside_window.SAID.extend(
    label.text() for label in abort.parentWidget().findChildren(QtWidgets.QLabel)))
""")
user.event(BOX, "set_string", "Schlieren")
user.python("""
import inside_window
inside_window.END()
assert any("computing the refractive index" in text for text in inside_window.SAID), set(inside_window.SAID)
abort = widget("AbortButton")
view, display = GetActiveView(), GetDisplayProperties(FindSource("flow"), GetActiveView())
bench = display.SchlierenBench
pause(0.5)
assert (builds(bench), information(bench, "ImageCount")) == (0, 0), (
    builds(bench), information(bench, "ImageCount"), information(bench, "Status"))
assert not abort.isEnabled()
# Nothing begins anew by itself.
view.GetActiveCamera().Azimuth(10)
Render(view)
pause(0.5)
assert builds(bench) == 0
""")
user.event(BOX, "set_string", "Outline")
user.event(BOX, "set_string", "Schlieren")
user.python("""
view = GetActiveView()
bench = GetDisplayProperties(FindSource("flow"), view).SchlierenBench
bench.GladstoneDaleConstant = 3e-4
settle_soon()
assert builds(bench) == 1
""")
user.play(MESH)
