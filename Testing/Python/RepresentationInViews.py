# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Data drawn as Schlieren beside surfaces, in two views, over time, from state files and scripts, and where nothing
can be drawn."""

import math
import os

import numpy as np
from paraview import simple, smstate
from plugin_testing import comes_back
from representation_testing import GREY_LEVEL, filter_like, pixels_of, show
from series_testing import write_series

SIZE = (120, 90)


def new_view():
    view = simple.CreateRenderView(ViewSize=list(SIZE), OrientationAxesVisibility=0)
    view.CameraParallelProjection = 1
    return view


def delete(*views):
    for one in views:
        simple.Delete(one)


def agrees(shown, display, view):
    return shown.shape == SIZE[::-1] and np.abs(shown - filter_like(display, view, SIZE)).max() <= GREY_LEVEL


# A surface hides what is behind it, whether it is before the flow, in it or behind it, and else all is as without.
wavelet = simple.Calculator(Input=simple.Wavelet(WholeExtent=3 * [-8, 8]), ResultArrayName="rho", Function="RTData")
wavelet.UpdatePipeline()
view = new_view()
display = show(wavelet, view)
simple.ResetCamera(view)
bounds = view.CameraParallelScale
alone = pixels_of(view, SIZE)
assert agrees(alone, display, view)
for z in (-20, 0, 20):
    ball = simple.Sphere(Center=[4, 2, z], Radius=3, ThetaResolution=64, PhiResolution=64)
    surface = simple.Show(ball, view)
    surface.AmbientColor = surface.DiffuseColor = [1, 0, 0]
    both = pixels_of(view, SIZE, channels=slice(None))
    hidden = both[..., 0] != both[..., 2]
    rows, columns = np.nonzero(hidden)
    pixel = 2 * view.CameraParallelScale / SIZE[1]
    area = hidden.sum() * pixel**2 / (math.pi * 3**2)
    assert abs(area - 1) < 0.05, (z, area)
    # x is right and y is up.
    place = [(columns.mean() + 0.5 - SIZE[0] / 2) * pixel, (rows.mean() + 0.5 - SIZE[1] / 2) * pixel]
    assert np.allclose(place, [4, 2], atol=pixel / 2), (z, place)
    assert np.abs(both[..., 0] - alone)[~hidden].max() <= 2 * GREY_LEVEL, z
    simple.Delete(ball)

# The image fills the view, but is no reason to place the camera elsewhere.
simple.ResetCamera(view)
assert math.isclose(view.CameraParallelScale, bounds), (view.CameraParallelScale, bounds)

# Streaming updates trace or draw, never both, so that none takes the time of both.
bench, drawn, updates = display.SchlierenBench, [], set()
display.SchlierenTimeSlice = 0.01
bench.SamplesPerPixel = 300
simple.Render(view)


def information(name):
    bench.UpdatePropertyInformation()
    return bench.GetProperty(name).GetData()


tag = view.GetRenderWindow().AddObserver("EndEvent", lambda *_: drawn.append(None))
while information("Finished") == 0:
    count = information("ImageCount")
    drawn.clear()
    view.SMProxy.StreamingUpdate(True)
    updates.add((information("ImageCount") > count, len(drawn) > 0))
view.GetRenderWindow().RemoveObserver(tag)
assert {(True, False), (False, True)} <= updates and (True, True) not in updates, updates
# What one of them has taken up of a change is announced by the next update all the same: state files and panels follow it.
cutoff, announced = bench.Cutoff, []
tag = bench.SMProxy.AddObserver("UpdateDataEvent", lambda *_: announced.append(None))
bench.SamplesPerPixel = 301
simple.Render(view)
assert information("Finished") == 0
bench.Cutoff = "Shadowgraph"
announced.clear()
view.SMProxy.StreamingUpdate(True)
simple.Render(view)
assert announced
bench.SMProxy.RemoveObserver(tag)
bench.Cutoff = cutoff
display.SchlierenTimeSlice, bench.SamplesPerPixel = 0, 1

# With a perspective camera it agrees with surfaces everywhere: of bodies before, beside and behind the focal point, what
# their surfaces hide is where they block light.
camera = view.GetActiveCamera()
view.CameraParallelProjection = 0
places = [[-4, 2, 6], [3, -3, 0], [4, 4, -6]]
balls = [simple.Sphere(Center=place, Radius=1.5, ThetaResolution=64, PhiResolution=64) for place in places]
bodies = simple.AppendGeometry(Input=balls)
# A mesh, whose walls are where the surfaces are, not as fine as samples.
mesh = simple.Transform(Input=simple.Calculator(Input=simple.Wavelet(WholeExtent=3 * [-24, 24]), ResultArrayName="rho", Function="RTData"))
mesh.Transform.Scale = 3 * [1 / 3]
mesh.UpdatePipeline()
simple.Hide(wavelet, view)
inside = show(mesh, view, Bodies=bodies, KMode="Value", KScale=1e-9, GladstoneDaleConstant=1e-9)  # the gas is grey
LARGE = (480, 360)
for angle, zoom in ((30, 1), (60, 1), (30, 6)):  # the last one is within the data
    simple.ResetCamera(view)
    camera.SetViewAngle(angle)
    camera.Dolly(zoom)
    alone = pixels_of(view, LARGE)
    assert camera.GetViewAngle() == angle
    assert agrees(pixels_of(view, SIZE), inside, view), angle
    surface = simple.Show(bodies, view)
    simple.SetProperties(surface, AmbientColor=[1, 0, 0], Ambient=1, Diffuse=0, Specular=0)
    both = pixels_of(view, LARGE, channels=slice(None))
    simple.Hide(bodies, view)
    hidden = both[..., 0] - both[..., 2] > 128  # half of the pixel
    dark = alone < 64
    assert 500 < hidden.sum() < 0.8 * hidden.size, (angle, zoom, hidden.sum())
    # Pixels at the rim are partly dark.
    around = [np.roll(hidden, shift, (0, 1)) for shift in ((1, 0), (-1, 0), (0, 1), (0, -1))]
    rim = np.any(around, axis=0) & ~np.all(around, axis=0)
    assert (dark != hidden)[~rim].sum() < 1e-3 * hidden.sum(), (angle, zoom, (dark != hidden)[~rim].sum())
    shift = (dark.sum() - hidden.sum()) / (0.5 * rim.sum())  # of the silhouettes, pixels
    assert abs(shift) < 0.2, (angle, zoom, shift)
simple.Delete(mesh)
simple.Delete(bodies)
simple.Show(wavelet, view)
view.CameraParallelProjection = 1
simple.ResetCamera(view)

# Another view of the same data has its own camera and settings, unless they are linked.
second = new_view()
other = show(wavelet, second, Cutoff="Shadowgraph")
simple.AddCameraLink(view, second, "both")
camera.Azimuth(35)
simple.Render(view)
assert agrees(pixels_of(view, SIZE), display, view)
assert agrees(pixels_of(second, SIZE), other, second)
assert np.allclose(second.CameraPosition, view.CameraPosition)
simple.RemoveCameraLink("both")

# A state file and a script of it draw the same.
display.SchlierenBench.KnifeEdgeAngle = 30
kept = [pixels_of(one, SIZE) for one in (view, second)]
simple.SaveState("views.pvsm")
assert os.path.getsize("views.pvsm") < 600000
script = smstate.get_state()
delete(view, second)
del view, second, camera, display, other, surface


def check_kept():
    made = {one.GetXMLName() + str(index): one for index, one in enumerate(simple.GetViews())}
    assert len(made) == 2, made
    images = [pixels_of(one, SIZE) for one in made.values()]
    for image in kept:
        assert any(np.array_equal(image, found) for found in images)
    delete(*made.values())


comes_back("views.pvsm", script, check_kept)
simple.ResetSession()


# Over time.
def pulse(x, y, z, time):
    return 1 + (0.5 + 0.4 * math.sin(math.pi * time)) * np.exp(-(x**2 + y**2 + z**2) / 0.09)


TIMES = [0, 0.5, 1, 1.5]
write_series("pulse.pvd", TIMES, 20, pulse)
flow = simple.PVDReader(FileName=os.path.abspath("pulse.pvd"))
flow.UpdatePipeline()
view = new_view()
display = show(flow, view, KMode="Value", KScale=500)
simple.ResetCamera(view)
scene = simple.GetAnimationScene()
scene.UpdateAnimationUsingDataTimeSteps()
frames = {}
for time in TIMES + [0.5]:
    scene.AnimationTime = time
    frames[time] = pixels_of(view, SIZE)
    assert agrees(frames[time], display, view), time
assert all(np.ptp(frames[0] - frames[time]) > 10 for time in (0.5, 1.5))
simple.SaveAnimation("pulse.png", view, ImageResolution=list(SIZE))
for index, time in enumerate(TIMES):
    assert np.array_equal(pixels_of(f"pulse.{index:04}.png"), frames[time]), time

# An automatic k is kept over time, as that of the filter.
bench = display.SchlierenBench
bench.KMode = "Automatic"
used = set()
for time in TIMES:
    scene.AnimationTime = time
    pixels_of(view, SIZE)
    bench.UpdatePropertyInformation()
    used.add(bench.GetProperty("KScaleUsed").GetData())
assert len(used) == 1 and used != {0}, used

# What cannot be drawn leaves the view as it is without, and says so once, however often it is drawn.
errors = []


def note(*arguments):
    errors.append(arguments[-1])


note.CallDataType = "string0"
bench.GetClientSideObject().AddObserver("ErrorEvent", note)
bench.Density = ["POINTS", "nowhere"]
view.UseColorPaletteForBackground = 0
view.Background = [0, 0, 1]
for _ in range(3):
    view.GetActiveCamera().Azimuth(10)
    simple.Render(view)
blank = pixels_of(view, SIZE, channels=slice(None))
assert (blank == [0, 0, 255]).all()
assert len(errors) == 1 and "nowhere" in errors[0], errors
bench.Density = ["POINTS", "rho"]
assert agrees(pixels_of(view, SIZE), display, view) and len(errors) == 1

# Surfaces have nothing that light could pass through.
display.Visibility = 0
empty = show(simple.Sphere(), view)
empty.SchlierenBench.GetClientSideObject().AddObserver("ErrorEvent", note)
simple.Render(view)
simple.Render(view)
assert 1 <= len(errors) <= 2, errors
delete(view)
del view, scene, display, bench, empty
