# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""What ends while a picture is being refined: the filter, its flow, the views, the session, the program. Each
step leaves a line, which it would not after a crash."""

import os

from follow_testing import SCENE
from window_testing import FOLDER, Session

REPORT = os.path.join(FOLDER, "report.txt")
open(REPORT, "w", encoding="utf-8").close()
BEGIN = f"""
import os
def report(text):
    with open({REPORT!r}, "a") as file:
        file.write(text + "\\n")
def begin():
    "Turns the camera and stops in the middle of the refinement."
    global flow, bench, shadows, turned, shown, other
    flow, bench, shadows, turned, shown, other = by_name(
        "flow", "bench", "shadows", "RenderView1", "RenderView2", "RenderView3")
    bench.SamplesPerPixel = shadows.SamplesPerPixel = 400
    turned.CameraPosition = [40, 20, 30 + turned.CameraPosition[2]]
    Render(turned)
    until(lambda: not finished(bench), 20)
def again():
    ResetSession()
    exec({SCENE!r}, globals())
    begin()
begin()
"""

user = Session()

# Other properties are applied, by a script and in the panel; following goes on.
user.python(BEGIN + """
bench.KnifeEdgeAngle = 90
bench.SamplesPerPixel = shadows.SamplesPerPixel = 2
Render(shown)
assert finished(bench)
until(lambda: finished(shadows))
report("changed")
begin()
""")
user.choose("Cutoff/ComboBox", "Circular")
user.type("SamplesPerPixel/LineEdit0", "1")
user.apply()
user.python(BEGIN.replace("\nbegin()\n", "\n") + """
bench, shadows = by_name("bench", "shadows")
assert bench.Cutoff == "Circular" and finished(bench)
shadows.SamplesPerPixel = 1
until(lambda: finished(shadows))
report("applied")

begin()
Hide(bench, shown)
count = information(bench, "PictureCount")
pause(0.5)
assert information(bench, "PictureCount") <= count + 1 and not finished(bench)
report("hidden")

again()
Delete(shown)
pause(0.5)

report("view closed")

again()
Delete(turned)
bench.SamplesPerPixel = shadows.SamplesPerPixel = 4
until(lambda: finished(bench) and finished(shadows))
report("followed view closed")

again()
RenameView("another", turned)
pause(0.1)
assert bench.FollowedView == "another", bench.FollowedView
report("renamed")

again()
Delete(bench)
pause(0.3)
report("filter deleted")

again()
Delete(bench)
Delete(shadows)
Delete(flow)
del bench, shadows, flow
pause(0.3)
report("all deleted")

again()
LoadPlugin(os.environ["SCHLIEREN_PLUGIN"], remote=False, ns=globals())
pause(0.2)
bench.SamplesPerPixel = shadows.SamplesPerPixel = 1
until(lambda: finished(bench) and finished(shadows))
report("loaded again")

# In the middle of a turn of its own.
again()
def delete(*_):
    shown.SMProxy.RemoveObserver(tag)
    Delete(bench)
tag = shown.SMProxy.AddObserver("EndEvent", delete)
turned.CameraPosition = [10, 60, 30]
pause(1)
assert not FindSource("bench")
report("deleted when shown")

again()
Disconnect()
Connect()
pause(0.3)
report("disconnected")

exec(SCENE, globals())
begin()
report("to be quit")
""".replace("SCENE", repr(SCENE)))
user.play(SCENE)

with open(REPORT, encoding="utf-8") as file:
    lines = file.read().split("\n")
assert lines == ["changed", "applied", "hidden", "view closed", "followed view closed", "renamed",
                 "filter deleted", "all deleted", "loaded again", "deleted when shown", "disconnected",
                 "to be quit", ""], lines
