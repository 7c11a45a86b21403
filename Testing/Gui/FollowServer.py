# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Pictures follow a camera where a server makes them. Skipped without pvserver."""

import os
import sys

import numpy as np

sys.path.insert(0, os.path.join(os.environ["SCHLIEREN_SOURCE_DIR"], "Testing", "Python"))

from follow_testing import SCENE, saved, scripted  # noqa: E402
from plugin_testing import Schlieren, output, simple  # noqa: E402
from server_testing import connect, start_server  # noqa: E402
from vtkmodules.util.numpy_support import vtk_to_numpy  # noqa: E402
from window_testing import Session  # noqa: E402

SAVE = """
bench, shadows, turned, shown, other = by_name(
    "bench", "shadows", "RenderView1", "RenderView2", "RenderView3")
until(lambda: finished(bench) and finished(shadows))
pause(0.3)
save("{0}", bench, turned, shown)
save("{0}Shadows", shadows, turned, other)
"""

server, port = start_server()
user = Session()
user.drag_view(1, (0.3, 0.5), (0.35, 0.55), (0.4, 0.6), (0.45, 0.6), (0.5, 0.6))
user.python(SAVE.format("turned"))
user.drag_view(1, (0.5, 0.5), (0.5, 0.45), (0.5, 0.4), button=2)
user.python(SAVE.format("zoomed"))

# The server goes away in the middle of a refinement: that of the session, properly.
user.python("""
bench, turned = by_name("bench", "RenderView1")
bench.SamplesPerPixel = 400
turned.CameraPosition = [40, 20, 70]
Render(turned)
until(lambda: not finished(bench), 20)
Disconnect()
pause(0.3)
""")
try:
    user.play(connect(port) + SCENE)
finally:
    server.kill()

for step in ("turned", "zoomed"):
    for name in ("bench", "shadows"):
        kept = saved(step + ("Shadows" if name == "shadows" else ""))
        made = output(scripted(simple, Schlieren, saved(step), name))
        values = vtk_to_numpy(made.GetPointData().GetArray("Intensity"))
        assert np.abs(values - kept["intensity"]).max() < 1e-6, (step, name)
        assert kept["reduction"] == 1 and kept["limit"] == 0
assert np.abs(saved("turned")["intensity"] - saved("zoomed")["intensity"]).max() > 0.1
