# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""ParaView's abort button: it stops an image that is being refined, which stays as it is until Apply,
and with the builtin server also a refractive index that Apply waits for."""

import os

from views_testing import FOLDER, INSIDE, MESH, ViewsSession

REPORT = os.path.join(FOLDER, "report.txt")
with open(REPORT, "w", encoding="utf-8"):
    pass
STEPS = f"""
bench = FindSource("Schlieren1")
abort, bar = widget("AbortButton"), widget("ProgressBar")
def line():
    return widget("Frame.2", "Viewport", "SchlierenStatus")
def is_stopped():
    stopped = information(bench, "Stopped") == 1
    assert stopped == line().text().startswith("Stopped. "), line().text()
    return stopped
def report(text):
    with open({REPORT!r}, "a") as file:
        file.write(text + "\\n")
"""

user = ViewsSession()
user.choose_filter("Schlieren")
user.type("SamplesPerPixel/LineEdit0", "2000")
user.apply()
user.python(STEPS + """
until(lambda: abort.isEnabled())
until(lambda: " of 2000 samples" in information(bench, "Status"))
pause(0.5)
until(lambda: bar.text().startswith("Refining: "))
assert 0 <= information(bench, "PercentDone") < 100
assert not is_stopped() and not finished(bench)
QTest.mouseClick(abort, Qt.MouseButton.LeftButton)
assert is_stopped() and finished(bench) and not abort.isEnabled() and bar.text() == ""

# Neither rendering nor an update nor a screenshot requests more.
rays = information(bench, "TotalRaysTraced")
Render(FindView("Image of Schlieren1"))
bench.UpdatePipeline()
SaveScreenshot(os.path.join(FOLDER, "stopped.png"), FindView("Image of Schlieren1"))
pause(0.5)
assert information(bench, "TotalRaysTraced") == rays and is_stopped()
report("stopped")
""")
user.type("SamplesPerPixel/LineEdit0", "2")
user.apply()
user.python(STEPS + """
settle(bench)
assert not is_stopped() and information(bench, "Status").startswith("2 samples")
until(lambda: not abort.isEnabled())
report("applied")

# Before the refractive index is known.
accept = widget("propertiesPanel", "Accept")
""")
user.choose("GladstoneDaleConstant/DoubleLineEdit0", "0.0003")
user.python(STEPS + """
builds = information(bench, "MediumBuilds")
end = click_during(bench.GetClientSideObject(), 0.05, abort)
click(widget("propertiesPanel", "Accept"))
end()
assert is_stopped() and finished(bench) and not abort.isEnabled()
assert line().text() == "Stopped. No image: the refractive index is not known yet", line().text()
Render(FindView("Image of Schlieren1"))
assert bench.GetDataInformation().GetNumberOfPoints() == 0
assert information(bench, "MediumBuilds") == builds
report("no index")
""")
user.choose("GladstoneDaleConstant/DoubleLineEdit0", "0.00025")
user.apply()
user.python(STEPS + """
settle(bench)
assert not is_stopped() and information(bench, "MediumBuilds") > 0
assert bench.GetDataInformation().GetNumberOfPoints() == 512 * 512
report("index")
""")

user.play(INSIDE + MESH)

with open(REPORT, encoding="utf-8") as file:
    steps = file.read().split("\n")
assert steps == ["stopped", "applied", "no index", "index", ""], steps
