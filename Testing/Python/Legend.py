# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The legend in views: where it is, that its scale has the image's own light, in screenshots of any size and in tiles."""

import numpy as np
from paraview import simple
from representation_testing import pixels_of, show
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkRenderingCore import vtkWindowToImageFilter

SIZE = (400, 300)

flow = simple.Calculator(Input=simple.Wavelet(WholeExtent=3 * [-8, 8]), ResultArrayName="rho", Function="RTData")
flow.UpdatePipeline()
view = simple.CreateRenderView(ViewSize=list(SIZE), OrientationAxesVisibility=0, CameraParallelProjection=1)
display = show(flow, view)
simple.ResetCamera(view)


def box_of(drawn, hidden):
    """Where they differ, as fractions of the image: left, right, bottom, top."""
    rows, columns = np.nonzero(np.abs(drawn - hidden) > 0)
    height, width = drawn.shape
    return np.array([columns.min() / width, (columns.max() + 1) / width, rows.min() / height, (rows.max() + 1) / height])


without = pixels_of(view, SIZE)
display.SchlierenLegend = 1
seen = pixels_of(view, SIZE)
box = box_of(seen, without)
assert 0.25 < box[1] - box[0] < 0.6 and 0.15 < box[3] - box[2] < 0.6, box
assert box[1] > 0.95 and box[2] < 0.05, box

# Somewhere in it a row goes from black to white, by as much from each pixel to the next.
inside = seen[: int(box[3] * SIZE[1]), int(box[0] * SIZE[0]):]
scales = [row for row in inside if row.min() <= 2 and row.max() >= 253]
ramp = max((np.diff(row)[(np.diff(row) > 0) & (np.diff(row) < 6)].sum() for row in scales), default=0)
assert ramp > 240, ramp

# With a white panel's opposite behind it: the image does not shine through to what the texts have.
simple.SetProperties(display.SchlierenBench, Cutoff="Bright Field")
bright = pixels_of(view, SIZE)
display.SchlierenLegend = 0
assert np.ptp(box_of(bright, pixels_of(view, SIZE)) - box) < 0.05
simple.SetProperties(display.SchlierenBench, Cutoff="Knife Edge")

# In each corner.
display.SchlierenLegend = 1
for corner, sides in (("Lower Left", (0, 2)), ("Upper Left", (0, 3)), ("Upper Right", (1, 3))):
    display.SchlierenLegendCorner = corner
    there = box_of(pixels_of(view, SIZE), without)
    for side in sides:
        assert abs(there[side] - side % 2) < 0.05, (corner, there)
    assert np.allclose(there[1] - there[0], box[1] - box[0], atol=0.01), (corner, there)
display.SchlierenLegendCorner = "Lower Right"

# In a smaller view it has a smaller font, and without its last lines covers a quarter at most.
heights = [(box[3] - box[2]) * SIZE[1]]
for size in (300, 200), (280, 170):
    view.ViewSize = list(size)
    display.SchlierenLegend = 0
    alone = pixels_of(view, size)
    display.SchlierenLegend = 1
    left, right, bottom, top = box_of(pixels_of(view, size), alone)
    assert 0.15 < (right - left) * (top - bottom) < 0.26, (size, left, right, bottom, top)
    heights.append((top - bottom) * size[1])
assert heights[1] < 0.85 * heights[0] and heights[2] < 0.92 * heights[1], heights

# A view that it would cover has none.
view.ViewSize = [150, 110]
tiny = pixels_of(view, (150, 110))
display.SchlierenLegend = 0
assert np.array_equal(tiny, pixels_of(view, (150, 110)))
display.SchlierenLegend = 1
view.ViewSize = list(SIZE)

# A screenshot twice as large, and one that is drawn in tiles, have it at the same place, as large.
double = (2 * SIZE[0], 2 * SIZE[1])
large = pixels_of(view, double)
wide = pixels_of(view, (1280, 720))
display.SchlierenLegend = 0
largeWithout = pixels_of(view, double)
assert np.allclose(box_of(large, largeWithout), box, atol=0.03), (box_of(large, largeWithout), box)

# However much larger than its view a screenshot is, the legend covers 12 % at most, and has all of its lines.
left, right, bottom, top = box_of(wide, pixels_of(view, (1280, 720)))
assert 0.08 < (right - left) * (top - bottom) <= 0.12, (left, right, bottom, top)


def in_tiles(name):
    simple.Render(view)
    tiles = vtkWindowToImageFilter()
    tiles.SetInput(view.GetRenderWindow())
    tiles.SetScale(2, 2)
    writer = vtkPNGWriter()
    writer.SetFileName(name)
    writer.SetInputConnection(tiles.GetOutputPort())
    writer.Write()
    return pixels_of(name)


tiledWithout = in_tiles("without.png")
display.SchlierenLegend = 1
tiled = box_of(in_tiles("tiles.png"), tiledWithout)
assert np.allclose(tiled, box, atol=0.03), (tiled, box)

# An image that has failed has none, and no display that is hidden.
display.Visibility = 0
hidden = pixels_of(view, SIZE)
assert np.ptp(hidden) == 0, np.ptp(hidden)
