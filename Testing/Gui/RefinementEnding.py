# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""What ends while a flow that is drawn as Schlieren is being refined: its settings, its visibility, the view, the flow,
the program. Each step leaves a line, which it would not after a crash."""

import os

from views_testing import INSIDE
from window_testing import FOLDER, Session

REPORT = os.path.join(FOLDER, "report.txt")
with open(REPORT, "w", encoding="utf-8"):
    pass
FLOW = """
flow = Calculator(Input=Wavelet(WholeExtent=3 * [-8, 8]), ResultArrayName="rho", Function="RTData", registrationName="flow")
flow.UpdatePipeline()
Show(flow, turned)
ResetCamera(turned)
"""
STEPS = f"""
flow, turned = by_name("flow", "RenderView1")
def report(text):
    with open({REPORT!r}, "a") as file:
        file.write(text + "\\n")
def draw():
    "Draws the flow as Schlieren, and stops in the middle of its refinement."
    display = Show(FindSource("flow"), turned)
    display.SetRepresentationType("Schlieren")
    display.SchlierenBench.SamplesPerPixel = 4000
    Render(turned)
    until(lambda: " of 4000 " in information(display.SchlierenBench, "Status"), 20)
    return display
"""

user = Session()
user.python(STEPS + """
display = draw()
bench = display.SchlierenBench
bench.KnifeEdgeAngle = 90
bench.SamplesPerPixel = 2
Render(turned)
settle_views()
assert information(bench, "Status").startswith("2 samples"), information(bench, "Status")
report("changed")

draw()
Hide(flow, turned)
Render(turned)
pause(0.2)
count = information(bench, "PictureCount")
pause(0.3)
assert information(bench, "PictureCount") == count
report("hidden")

LoadPlugin(os.environ["SCHLIEREN_PLUGIN"], remote=False, ns=globals())
draw()
pause(0.2)
report("loaded again")

# A filter of the same flow, complete at once.
made = Schlieren(Input=flow, registrationName="bench", ImageSize=[96, 96], GladstoneDaleConstant=1e-6)
made.UpdatePipeline()
assert finished(made)
Delete(made)
del made
report("filter deleted")

display.SetRepresentationType("Outline")
Render(turned)
display.SetRepresentationType("Schlieren")
draw()
Delete(turned)
pause(0.2)
report("view that draws closed")

turned = CreateView("RenderView", registrationName="RenderView1")
AssignViewToLayout(turned)
Show(flow, turned)
ResetCamera(turned)
draw()
Delete(flow)
del flow
pause(0.2)
report("drawn flow deleted")
""" + FLOW + """
draw()
report("to be quit")
""")
user.play(INSIDE + """
from paraview.simple import *
turned = GetActiveViewOrCreate("RenderView")
""" + FLOW)

with open(REPORT, encoding="utf-8") as file:
    lines = file.read().split("\n")
assert lines == ["changed", "hidden", "loaded again", "filter deleted", "view that draws closed", "drawn flow deleted",
                 "to be quit", ""], lines
