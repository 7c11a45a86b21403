# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""ParaView's abort button stops the refractive index that a view waits for, whose data are to be drawn as Schlieren;
another setting begins anew."""

import os

from views_testing import FOLDER
from window_testing import DISPLAY, Session

REPORT = os.path.join(FOLDER, "report.txt")

user = Session()
user.python("""
import inside_window
bench = GetDisplayProperties(FindSource("flow"), GetActiveView()).SchlierenBench
inside_window.END = click_during(bench.GetClientSideObject(), 0.05, widget("AbortButton"))
""")
user.event(DISPLAY + "/Representation/displayRepresentationWidget/comboBox", "set_string", "Schlieren")
user.python("""
import inside_window
inside_window.END()
abort = widget("AbortButton")
view, display = GetActiveView(), GetDisplayProperties(FindSource("flow"), GetActiveView())
bench = display.SchlierenBench
pause(0.5)
assert (information(bench, "MediumBuilds"), information(bench, "PictureCount")) == (0, 0), (
    information(bench, "MediumBuilds"), information(bench, "PictureCount"), information(bench, "Status"))
assert not abort.isEnabled()
# Nothing begins anew by itself.
view.GetActiveCamera().Azimuth(10)
Render(view)
pause(0.5)
assert information(bench, "MediumBuilds") == 0
""")
user.event(DISPLAY + "/Representation/displayRepresentationWidget/comboBox", "set_string", "Outline")
user.event(DISPLAY + "/Representation/displayRepresentationWidget/comboBox", "set_string", "Schlieren")
user.python(f"""
view, display = GetActiveView(), GetDisplayProperties(FindSource("flow"), GetActiveView())
bench = display.SchlierenBench
bench.GladstoneDaleConstant = 3e-4
Render(view)
until(lambda: information(display, "SchlierenFinished") == 1 and information(bench, "PictureCount") > 0)
assert information(bench, "MediumBuilds") == 1
with open({REPORT!r}, "w") as file:
    file.write("made")
""")
user.play("""
from paraview.simple import *
flow = Tetrahedralize(Input=Calculator(Input=Wavelet(WholeExtent=3 * [-24, 24]), ResultArrayName="rho", Function="RTData"), registrationName="flow")
display = Show(flow)
display.SetRepresentationType("Outline")
ResetCamera()
SetActiveSource(flow)
Render()
""")

with open(REPORT, encoding="utf-8") as file:
    assert file.read() == "made"
