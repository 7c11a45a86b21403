# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""What the view shows behind a flow, seen through it: where it should be by a closed form, and as it is without the flow."""

import numpy as np
from paraview import simple
from plugin_testing import Schlieren
from representation_testing import pixels_of, show

SIZE = (240, 180)
HALF_HEIGHT = 6
BOARD = -40.0  # its z
WIDTH = 16.0   # of the flow along each axis, whose middle is the origin


def board(view):
    """Dark, from far left to x = 0, behind the flow; and a ball before it."""
    plane = simple.Plane(Origin=[-60, -60, BOARD], Point1=[0, -60, BOARD], Point2=[-60, 60, BOARD])
    simple.SetProperties(simple.Show(plane, view), DiffuseColor=[0, 0, 0], AmbientColor=[0, 0, 0])
    ball = simple.Sphere(Center=[5, 3, 12], Radius=1.5, PhiResolution=60, ThetaResolution=60)
    simple.SetProperties(simple.Show(ball, view), AmbientColor=[0.5, 0.5, 0.5], DiffuseColor=[0.5, 0.5, 0.5])


def flow_in(view, slope):
    """Its refractivity grows along x."""
    flow = simple.Calculator(Input=simple.Wavelet(WholeExtent=3 * [-8, 8]), Function=f"{slope}*coordsX",
                             ResultArrayName="N")
    flow.UpdatePipeline()
    return flow, show(flow, view, IndexModel="Refractivity", IndexArray=["POINTS", "N"], AmbientRefractivity=0,
                      Cutoff="Background Oriented", BackgroundPattern="Scene")


def edge_of(row):
    """Columns from the middle of the image to where a row becomes half as light as at its end."""
    half = row[-1] / 2
    right = int(np.argmax(row > half))
    assert 0 < right
    return right - 1 + (half - row[right - 1]) / (row[right] - row[right - 1]) + 0.5 - len(row) / 2


simple._DisableFirstRenderCameraReset()  # pylint: disable=protected-access
view = simple.CreateRenderView(
    ViewSize=list(SIZE), OrientationAxesVisibility=0, UseColorPaletteForBackground=0, Background=[0.8, 0.8, 0.8],
    CameraPosition=[0, 0, 60], CameraFocalPoint=[0, 0, 0], CameraViewUp=[0, 1, 0], CameraParallelProjection=1,
    CameraParallelScale=HALF_HEIGHT, CenterAxesVisibility=0)
board(view)
plain = pixels_of(view, SIZE)
assert abs(edge_of(plain[20])) < 0.6 and plain[135, 195] < 180, "The scene is not what it should be"

# Light that leaves after the path L is bent by the slope times L, and has been displaced by half of that times L.
slope = 2e-3
flow, display = flow_in(view, slope)
shift = slope * WIDTH * (WIDTH / 2 + (-WIDTH / 2 - BOARD))
expected = -shift * SIZE[1] / (2 * HALF_HEIGHT)
assert expected < -15
for size, scale in ((SIZE, 1), ((720, 540), 3)):  # the larger one in tiles
    image = pixels_of(view, size)
    for row in (20, 60):
        assert abs(edge_of(image[scale * row]) - scale * expected) < 0.5 * scale + 0.5, (size, edge_of(image[scale * row]))
    # The ball before the flow is where it was.
    assert np.abs(pixels_of(view, SIZE) - plain)[120:150, 180:210].max() <= 1

# The distance that is given counts.
display.SchlierenBench.BackgroundDistance = 0
near = slope * WIDTH * WIDTH / 2 * SIZE[1] / (2 * HALF_HEIGHT)
assert abs(edge_of(pixels_of(view, SIZE)[20]) + near) < 0.5
display.SchlierenBench.BackgroundDistance = -1

# A second rendering needs no re-tracing and makes no other image; another scene another image, of the same rays.


def counts():
    bench = display.SchlierenBench.GetClientSideObject()
    return [bench.GetImageCount(), bench.GetTotalRaysTraced()]


simple.Render(view)
images, rays = counts()
simple.Render(view)
assert counts() == [images, rays]
view.Background = [0.4, 0.4, 0.4]
simple.Render(view)
assert counts() == [images + 1, rays]
assert abs(pixels_of(view, SIZE)[20, 230] - 102) <= 1
view.Background = [0.8, 0.8, 0.8]

# Without refraction it is the scene, also with a perspective: but for edges, which light between the rays makes softer.
for parallel in (1, 0):
    view.CameraParallelProjection = parallel
    simple.Hide(flow, view)
    without = pixels_of(view, SIZE)
    simple.Show(flow, view)
    flow.Function = "0*coordsX"
    through = pixels_of(view, SIZE)
    difference = np.abs(through - without)
    assert np.ptp(without) > 150
    assert (difference > 1).mean() < 0.02, (parallel, (difference > 1).mean())
    edges = [edge_of(pixels[20]) for pixels in (through, without)]
    assert abs(edges[0] - edges[1]) < 0.6, edges

# The filter alone knows of no scene.
alone = Schlieren(Input=flow, IndexModel="Refractivity", IndexArray=["POINTS", "N"], Cutoff="Background Oriented",
                  BackgroundPattern="Scene", ImageSize=[20, 20])
alone.UpdatePipeline()
assert alone.GetDataInformation().GetNumberOfPoints() == 0, "An image of nothing"
