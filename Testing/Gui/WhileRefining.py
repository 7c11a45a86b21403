# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""What interrupts a view whose image is far from complete: another time step, and Edit > Reset Session, after which a
new session works as the first one did. The key of the latter does nothing while a refractive index is computed."""

import os

import numpy as np
from window_testing import FOLDER, MESH, OPEN_JET, ViewsSession
from series_testing import write_series

TIMES = [0, 1, 2]
SERIES = os.path.join(FOLDER, "flow.pvd")


def blob(x, y, z, time):
    """Warm; becomes warmer."""
    return 1 - 0.1 * (1 + time) * np.maximum(0, 1 - (x**2 + y**2 + z**2) / 0.36)**2


write_series(SERIES, TIMES, 17, blob)

HELPERS = """
(display,) = displays()
bench = display.SchlierenBench
def path():
    "The largest optical path difference: twice as large in the second step as in the first."
    image = bench.GetClientSideObject().GetOutputDataObject(0)
    return np.abs(vtk_to_numpy(image.GetPointData().GetArray("OpticalPathDifference"))).max()
def refines():
    return not finished(bench) and " of 100000 samples" in information(bench, "Status")
"""
user = ViewsSession()
user.press("OneImage")
user.python(HELPERS + """
bench.Quality = "Fine"
bench.SamplesPerPixel = 100000
Render()
until(refines)
first = path()

# Steps while samples are added: the image is soon that of the new time, and is refined further.
for step, ratio in ((1, 2), (2, 3), (0, 1)):
    GetAnimationScene().AnimationTime = float(step)
    until(lambda: refines() and abs(path() / first - ratio) < 0.02)
until(refines)
""")
GONE = "until(lambda: not GetSources() and not displays())\n"
user.python("reset_session()\n")
user.idle()
user.python(GONE + MESH.replace("[-8, 8]", "[-24, 24]"))
user.press("OneImage")
user.python(HELPERS + """
until(lambda: information(bench, "ImageCount") > 0 and path() > 0)
""")

# While the refractive index is computed, its key does nothing; afterwards it does.
user.python(HELPERS + """
settle_views()
algorithm, requested, pressed = bench.GetClientSideObject(), [], []
def press():
    pressed.append(algorithm.GetProgress())
    QTest.keyClick(widget(), Qt.Key.Key_R, Qt.KeyboardModifier.ControlModifier)
def watch(*_):
    if not requested and 0 < algorithm.GetProgress() < 1:
        requested.append(QTimer.singleShot(0, press))
    if not pressed:
        time.sleep(0.1)  # the window looks at events after 0.05 s, also where that is all it takes
QApplication.setActiveWindow(widget())
tag, builds = algorithm.AddObserver("ProgressEvent", watch), algorithm.GetMediumBuilds()
bench.GladstoneDaleConstant = 3e-4
Render(FindView("Schlieren View"))
algorithm.RemoveObserver(tag)
assert pressed and all(0 < progress < 1 for progress in pressed), pressed
settle_views()
assert GetSources() and algorithm.GetMediumBuilds() > builds and not QApplication.activeModalWidget()
QTimer.singleShot(0, press)
QTimer.singleShot(500, confirm)
""")
user.idle()
user.python(GONE + OPEN_JET)
user.press("OneImage")
user.python(HELPERS + """
until(lambda: information(bench, "ImageCount") > 0 and path() > 0)
""")
user.play(f"""
from paraview.simple import *
flow = OpenDataFile({SERIES!r})
flow.UpdatePipeline()
view = GetActiveViewOrCreate("RenderView")
Show(flow, view)
view.ResetCamera()
SetActiveSource(flow)
""")
