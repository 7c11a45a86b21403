# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""ParaView's abort button where Apply waits for the image of a filter, with the builtin server: there is none then, until
something is changed."""

import os

from views_testing import FOLDER, INSIDE, MESH, ViewsSession

REPORT = os.path.join(FOLDER, "report.txt")
with open(REPORT, "w", encoding="utf-8"):
    pass
STEPS = f"""
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
def report(text):
    with open({REPORT!r}, "a") as file:
        file.write(text + "\\n")
"""

user = ViewsSession()
user.choose_filter("Schlieren")
user.apply()
user.python(STEPS + """
settle(bench)
assert points(bench) == 512 * 512 and not line().startswith("No image")
""")

# The image.
user.type("SamplesPerPixel/LineEdit0", "200")
user.python(STEPS + """
apply_and_abort(bench, 0.05)
assert points(bench) == 0 and line() == "No image: it was stopped", (points(bench), line())

# Neither rendering nor an update requests more.
Render(FindView("Image of Schlieren1"))
bench.UpdatePipeline()
assert points(bench) == 0
report("stopped")
""")
user.type("SamplesPerPixel/LineEdit0", "2")
user.apply()
user.python(STEPS + """
settle(bench)
assert points(bench) == 512 * 512 and information(bench, "Status").startswith("2 samples")
report("applied")
""")

user.play(INSIDE + MESH)

with open(REPORT, encoding="utf-8") as file:
    steps = file.read().split("\n")
assert steps == ["stopped", "applied", ""], steps
