# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Apply and the abort button where a server of two ranks makes the image: refined in the window, stopped, and begun
again. Skipped without pvserver or mpiexec."""

import os

from server_testing import connect, start_ranks
from views_testing import FOLDER, INSIDE, MESH, ViewsSession

REPORT = os.path.join(FOLDER, "report.txt")
with open(REPORT, "w", encoding="utf-8"):
    pass

server, port = start_ranks(2)
user = ViewsSession()
user.choose_filter("Schlieren")
user.type("SamplesPerPixel/LineEdit0", "20000")
user.apply()
user.python(f"""
bench = FindSource("Schlieren1")
abort, bar = widget("AbortButton"), widget("ProgressBar")
until(lambda: abort.isEnabled())
until(lambda: " of 20000 samples" in information(bench, "Status"))
until(lambda: bar.text().startswith("Refining: "))
assert not finished(bench)
QTest.mouseClick(abort, Qt.MouseButton.LeftButton)
line = widget("Frame.2", "Viewport", "SchlierenStatus")
assert line.text().startswith("Stopped. ") and not abort.isEnabled() and information(bench, "Stopped") == 1
rays = information(bench, "TotalRaysTraced")
Render(FindView("Image of Schlieren1"))
pause(0.5)
assert information(bench, "TotalRaysTraced") == rays
bench.SamplesPerPixel = 2
Render(FindView("Image of Schlieren1"))
until(lambda: information(bench, "Status").startswith("2 samples"))
assert information(bench, "Stopped") == 0
with open({REPORT!r}, "w") as file:
    file.write("done")
""")
try:
    user.play(connect(port) + INSIDE + MESH)
finally:
    server.kill()

with open(REPORT, encoding="utf-8") as file:
    assert file.read() == "done"
