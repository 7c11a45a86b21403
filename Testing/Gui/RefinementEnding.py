# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""What ends while images of filters and a flow drawn as Schlieren are being refined: the filter, its flow, the views, the
program. Each step leaves a line, which it would not after a crash."""

import os

from filter_testing import SCENE, SIZE
from window_testing import FOLDER, Session

REPORT = os.path.join(FOLDER, "report.txt")
with open(REPORT, "w", encoding="utf-8"):
    pass
STEPS = f"""
import os
flow, bench, shadows, turned, shown, other = by_name(
    "flow", "bench", "shadows", "RenderView1", "RenderView2", "RenderView3")
def report(text):
    with open({REPORT!r}, "a") as file:
        file.write(text + "\\n")
def begin():
    "Renders another image and stops in the middle of the refinement."
    for filter in FindSource("bench"), FindSource("shadows"):
        if filter:
            filter.SamplesPerPixel = 4000
            filter.KnifeEdgeAngle += 1
            filter.ParallelScale += 1
    for view in shown, other:
        if FindSource("bench") or FindSource("shadows"):
            Render(view)
    until(lambda: not finished(FindSource("bench")), 20)
def draw():
    "Draws the flow as Schlieren, and stops in the middle of its refinement."
    display = Show(FindSource("flow"), turned)
    display.SetRepresentationType("Schlieren")
    display.SchlierenBench.SamplesPerPixel = 4000
    Render(turned)
    until(lambda: " of 4000 " in information(display.SchlierenBench, "Status"), 20)
    return display
def make(flow, name, view):
    SetActiveSource(flow)
    made = Schlieren(Input=flow, registrationName=name, ImageSize={[SIZE, SIZE]}, GladstoneDaleConstant=1e-6)
    Show(made, view).SetRepresentationType("Slice")
    return made
"""

user = Session()

# Other properties are applied, by a script and in the panel.
user.python(STEPS + """
begin()
bench.KnifeEdgeAngle = 90
bench.SamplesPerPixel = shadows.SamplesPerPixel = 2
bench.UpdatePipeline()
assert finished(bench) and information(bench, "Status").startswith("2 samples"), "A script has no complete data"
Render(shown)
Render(other)
until(lambda: finished(shadows))
report("changed")
begin()
""")
user.choose("Cutoff/ComboBox", "Circular")
user.type("SamplesPerPixel/LineEdit0", "1")
user.apply()
user.python(STEPS + """
assert bench.Cutoff == "Circular"
until(lambda: finished(bench))
report("applied")

begin()
Hide(bench, shown)
pause(0.2)
count = information(bench, "PictureCount")
pause(0.3)
assert information(bench, "PictureCount") == count and not finished(bench)
report("hidden")

bench.SamplesPerPixel = 1
Show(bench, shown)
LoadPlugin(os.environ["SCHLIEREN_PLUGIN"], remote=False, ns=globals())
begin()
pause(0.2)
report("loaded again")

Delete(bench)
pause(0.2)
report("filter deleted")

# In the middle of a turn of its own.
bench = make(flow, "bench", shown)
begin()
def delete(*_):
    shown.SMProxy.RemoveObserver(tag)
    Delete(bench)
tag = shown.SMProxy.AddObserver("EndEvent", delete)
until(lambda: not FindSource("bench"), 20)
pause(0.2)
report("deleted when shown")

bench = make(flow, "bench", shown)
begin()
Delete(bench)
Delete(shadows)
Delete(flow)
del bench, shadows, flow
pause(0.2)
report("all deleted")

flow = Calculator(Input=Wavelet(WholeExtent=3 * [-8, 8]), ResultArrayName="rho", Function="RTData", registrationName="flow")
flow.UpdatePipeline()
bench, shadows = make(flow, "bench", shown), make(flow, "shadows", other)
begin()
Delete(shown)
pause(0.3)
assert not finished(bench)
report("view closed")

display = draw()
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
Delete(bench)
Delete(shadows)
Delete(flow)
del bench, shadows, flow
pause(0.2)
report("drawn flow deleted")

flow = Calculator(Input=Wavelet(WholeExtent=3 * [-8, 8]), ResultArrayName="rho", Function="RTData", registrationName="flow")
flow.UpdatePipeline()
Show(flow, turned)
ResetCamera(turned)
draw()
report("to be quit")
""")
user.play(SCENE)

with open(REPORT, encoding="utf-8") as file:
    lines = file.read().split("\n")
assert lines == ["changed", "applied", "hidden", "loaded again", "filter deleted", "deleted when shown", "all deleted",
                 "view closed", "view that draws closed", "drawn flow deleted", "to be quit", ""], lines
