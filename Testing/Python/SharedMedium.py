# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""One medium for all views and filters of the same data: what is drawn in two views and made by a filter, counted."""

import numpy as np
from paraview import simple
from plugin_testing import Schlieren, image_array
from representation_testing import GREY_LEVEL, filter_like, pixels_of, show

SIZE = (120, 90)


def builds(*benches):
    return [bench.GetClientSideObject().GetMediumBuilds() for bench in benches]


def new_view(azimuth):
    view = simple.CreateRenderView(ViewSize=list(SIZE), OrientationAxesVisibility=0, CameraParallelProjection=1)
    view.GetActiveCamera().Azimuth(azimuth)
    return view


wavelet = simple.Wavelet(WholeExtent=3 * [-12, 12])
mesh = simple.Tetrahedralize(Input=wavelet)
for flow in (wavelet, mesh):
    flow.UpdatePipeline()
    views = [new_view(azimuth) for azimuth in (0, 50)]
    displays = [show(flow, view, Density=["POINTS", "RTData"]) for view in views]
    images = []
    for view in views:
        simple.ResetCamera(view)
        images.append(pixels_of(view, SIZE))
    bench = Schlieren(Input=flow, Density=["POINTS", "RTData"])
    image_array(bench, "Intensity")
    benches = [display.SchlierenBench for display in displays] + [bench]
    assert builds(*benches) == [1, 0, 0], builds(*benches)
    for display, view, image in zip(displays, views, images):
        assert np.abs(image - filter_like(display, view, SIZE)).max() <= GREY_LEVEL
    assert builds(*benches) == [1, 0, 0], builds(*benches)

    # Another cutoff of one makes none, another medium of one is its own.
    displays[0].SchlierenBench.Cutoff = "Shadowgraph"
    simple.Render(views[0])
    assert builds(*benches) == [1, 0, 0], builds(*benches)
    bench.DensityScale = 2
    image_array(bench, "Intensity")
    assert builds(*benches) == [1, 0, 1], builds(*benches)
    bench.DensityScale = 0
    image_array(bench, "Intensity")
    assert builds(*benches) == [1, 0, 1], builds(*benches)

    # The view that made it goes; the others keep it.
    simple.Delete(views[0])
    del displays[0], benches[0]
    views[1].GetActiveCamera().Azimuth(10)
    simple.Render(views[1])
    assert builds(*benches) == [0, 1], builds(*benches)

    # New data: one medium again.
    wavelet.Maximum = 200 if flow is wavelet else 150
    pixels_of(views[1], SIZE)
    image_array(bench, "Intensity")
    assert sum(builds(*benches)) == 2, builds(*benches)
    simple.Delete(bench)
    simple.Delete(views[1])
    del views, displays, benches, bench, display, view
