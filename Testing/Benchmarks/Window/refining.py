# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""For how long ParaView's window is blocked while a server refines an image: see README.md."""

import os
import sys
import tempfile

SOURCE = os.environ["SCHLIEREN_SOURCE_DIR"]
os.environ.setdefault("SCHLIEREN_TEST_OUTPUT", tempfile.mkdtemp(prefix="schlieren"))
os.environ.setdefault("SCHLIEREN_PARAVIEW", "paraview")
sys.path.insert(0, os.path.join(SOURCE, "Testing", "Gui"))

from server_testing import play  # noqa: E402
from window_testing import Session  # noqa: E402

REPORT = os.path.join(os.environ["SCHLIEREN_TEST_OUTPUT"], "report.txt")

SCENE = """
from paraview.simple import *
flow = Wavelet(WholeExtent=3 * [-128, 127], registrationName="flow")
view = GetActiveViewOrCreate("RenderView")
display = Show(flow, view)
display.SchlierenBench.Density = ["POINTS", "RTData"]
display.SchlierenBench.GladstoneDaleConstant = 1e-6
display.SetRepresentationType("Schlieren")
ResetCamera(view)
GetLayout(view).SplitHorizontal(0, 0.5)
Render(view)
"""

REFINE = f"""
import time
flow, view = by_name("flow", "RenderView1")
image_of = GetDisplayProperties(flow, view).SchlierenBench
for quality in "Fine", "Publication", "Publication":
    image_of.Quality = quality
    GetActiveCamera().Azimuth(20)
    Render(view)
    begin = time.perf_counter()
    turns = []
    while len(turns) % 20 != 1 or not finished(image_of):
        turns.append(process_events())
    working = sorted(turn for turn in turns if turn > 0.01)
    with open({REPORT!r}, "a") as file:
        file.write(
            f"{{quality:12}} {{time.perf_counter() - begin:5.1f}} s in {{len(working)}} turns of "
            f"{{1e3 * sum(working) / len(working):.0f}} ms, the longest "
            f"{{', '.join(f'{{1e3 * turn:.0f}}' for turn in working[:-4:-1])}} ms\\n")
"""

user = Session()
user.python(REFINE)
play(user, SCENE, True)
with open(REPORT, encoding="utf-8") as file:
    print(file.read())
