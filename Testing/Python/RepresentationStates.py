# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Data drawn as Schlieren: the k that is kept over time, in state files and scripts; bodies that block light; two flows
in one view."""

import os

import numpy as np
from paraview import simple, smstate
from plugin_testing import comes_back
from representation_testing import GREY_LEVEL, filter_like, pixels_of, show
from series_testing import write_series
from vtkmodules.vtkCommonCore import vtkFileOutputWindow, vtkOutputWindow

SIZE = (120, 90)
TIMES = [0, 1]


def column(x, _, z, time):
    """Once and three times as strong."""
    return 1 + (1 + 2 * time) * np.exp(-(x**2 + z**2) / 0.09)


def new_view():
    return simple.CreateRenderView(ViewSize=list(SIZE), OrientationAxesVisibility=0, CameraParallelProjection=1)


def k_of(bench):
    """k, or the distance of a shadowgraph's screen."""
    bench.UpdatePropertyInformation()
    return bench.GetProperty("AutomaticUsed").GetData()


# A state keeps what was automatic at another time.
def check_kept(cutoff):
    flow = simple.PVDReader(FileName=os.path.abspath("column.pvd"), registrationName="flow")
    flow.UpdatePipeline()
    view = new_view()
    display = show(flow, view, Cutoff=cutoff)
    simple.ResetCamera(view)
    scene = simple.GetAnimationScene()
    scene.UpdateAnimationUsingDataTimeSteps()
    pixels_of(view, SIZE)
    first = k_of(display.SchlierenBench)
    scene.AnimationTime = 1
    kept = pixels_of(view, SIZE)
    assert k_of(display.SchlierenBench) == display.SchlierenBench.LockedK == first > 0
    simple.SaveState("locked.pvsm")
    script = smstate.get_state()
    simple.Delete(view)
    del view, display, scene

    def check():
        (found,) = simple.GetViews()
        again = simple.GetDisplayProperties(simple.FindSource("flow"), found)
        simple.GetAnimationScene().AnimationTime = 1  # scripts do not keep it
        assert np.array_equal(pixels_of(found, SIZE), kept)
        assert k_of(again.SchlierenBench) == again.SchlierenBench.LockedK == first
        simple.Delete(found)

    comes_back("locked.pvsm", script, check)
    simple.ResetSession()


write_series("column.pvd", TIMES, 16, column)
for of in ("Knife Edge", "Shadowgraph"):
    check_kept(of)

# A body is black where light meets it, as in the filter's image, and as large as it is, give or take half a voxel.
wavelet = simple.Calculator(Input=simple.Wavelet(WholeExtent=3 * [-16, 16]), ResultArrayName="rho", Function="RTData")
wavelet.UpdatePipeline()
ball = simple.Sphere(Center=[2, 1, 0], Radius=8, ThetaResolution=64, PhiResolution=64)
ball.UpdatePipeline()
view = new_view()
display = show(wavelet, view, GladstoneDaleConstant=1e-7)
simple.ResetCamera(view)
without = pixels_of(view, SIZE)
display.SchlierenBench.Bodies = ball
image = pixels_of(view, SIZE)
assert np.abs(image - filter_like(display, view, SIZE)).max() <= GREY_LEVEL
pixel = 2 * view.CameraParallelScale / SIZE[1]
rows, columns = np.nonzero((image == 0) & (without > 0))
assert abs(np.sqrt(len(rows) * pixel**2 / np.pi) - 8) < 0.6, len(rows)
place = [(columns.mean() + 0.5 - SIZE[0] / 2) * pixel, (rows.mean() + 0.5 - SIZE[1] / 2) * pixel]
assert np.allclose(place, [2, 1], atol=pixel), place
ball.Radius = 6
rows, columns = np.nonzero((pixels_of(view, SIZE) == 0) & (without > 0))
assert abs(np.sqrt(len(rows) * pixel**2 / np.pi) - 6) < 0.6, len(rows)
display.SchlierenBench.Bodies = None
assert np.array_equal(pixels_of(view, SIZE), without)

# Of two flows in a view one is drawn, and one message says so, until that changes.
window = vtkFileOutputWindow()
window.SetFileName("messages.txt")
window.FlushOn()
vtkOutputWindow.SetInstance(window)


def messages():
    if not os.path.exists("messages.txt"):
        return 0
    with open("messages.txt", encoding="utf-8") as file:
        return file.read().count("Two flows")


if os.path.exists("messages.txt"):
    os.remove("messages.txt")
other = simple.Calculator(Input=simple.Wavelet(WholeExtent=3 * [-16, 16], XFreq=20), ResultArrayName="rho", Function="RTData")
other.UpdatePipeline()
second = simple.Show(other, view)
pixels_of(view, SIZE)
assert messages() == 0
second.SetRepresentationType("Schlieren")
for _ in range(3):
    assert np.array_equal(pixels_of(view, SIZE), without)
assert messages() == 1
display.Visibility = 0
alone = pixels_of(view, SIZE)
assert not np.array_equal(alone, without)
assert np.abs(alone - filter_like(second, view, SIZE)).max() <= GREY_LEVEL
display.Visibility = 1
assert np.array_equal(pixels_of(view, SIZE), without)
assert messages() == 2
simple.Delete(view)
del view, display, second
