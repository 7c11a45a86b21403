# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""What views show: looked at within ParaView's window, or where a state has been loaded."""

import os
import re

import numpy as np
from paraview import servermanager, simple

FOLDER = os.environ["SCHLIEREN_TEST_OUTPUT"]


def views():
    """Those of the layout, in the order of their cells: (cell, view)."""
    layout = list(simple.GetLayouts().values())[0]
    found = [(layout.GetViewLocation(view.SMProxy), view) for view in simple.GetRenderViews()]
    return sorted(found, key=lambda pair: pair[0])


def filters():
    """The Schlieren filters by their names."""
    return {key[0]: proxy for key, proxy in sorted(simple.GetSources().items())
            if proxy.GetXMLName() == "Schlieren"}


def shown(bench, view):
    """How the view shows it; null where it does not."""
    found = view.SMProxy.FindRepresentation(bench.SMProxy, 0)
    return servermanager._getPyProxy(found) if found else None  # pylint: disable=protected-access


def drawn(flow, view):
    """How the view draws the flow as Schlieren."""
    display = shown(flow, view)
    assert display.Representation == "Schlieren" and display.Visibility == 1
    return display


def check_linked(state, scene, *others):
    """The views have the camera of the 3-D view, and keep it, because each is linked with it in a state file."""
    for view in others:
        for name in ("CameraPosition", "CameraFocalPoint", "CameraViewUp", "CameraViewAngle", "CameraParallelScale",
                     "CameraParallelProjection"):
            mine, its = view.GetPropertyValue(name), scene.GetPropertyValue(name)
            assert np.allclose(mine, its), (name, mine, its)
    with open(os.path.join(FOLDER, state), encoding="utf-8") as file:
        links = re.findall("<CameraLink name=.*?</CameraLink>", file.read(), re.DOTALL)
    pairs = [set(re.findall(r'id="(\d+)"', link)) for link in links]
    assert len(pairs) >= len(others) and all(len(pair) == 2 for pair in pairs), links
    assert len(set.union(*pairs)) == 1 + len(pairs), "Views without a link"


def frame_view(view, scale):
    """Parallel light, an image that is 2 * scale high, at its own k where k is automatic, and nothing else in it: no
    window's size matters then."""
    view.CameraParallelProjection, view.CameraParallelScale = 1, scale
    view.OrientationAxesVisibility = 0
    for display in view.Representations:
        if display.GetProperty("SchlierenBench") is not None:
            if display.SchlierenBench.KMode == "Automatic Kept":
                display.SchlierenBench.KMode, display.SchlierenBench.LockedK = "Automatic", 0
            display.SchlierenLegend = 0


def check_display(representation, white=1):
    """Intensity in grey between fixed ends, without a legend and with its own colours."""
    assert representation.Visibility == 1
    assert list(representation.ColorArrayName)[:2] == ["POINTS", "Intensity"]
    assert representation.UseSeparateColorMap == 1 and representation.MapScalars == 1
    points = np.reshape(representation.LookupTable.RGBPoints, (-1, 4))
    assert points[0, 0] == 0 and points[-1, 0] == white, points
    assert np.ptp(points[:, 1:], axis=1).max() == 0, "The colour map is not grey"
    assert representation.LookupTable.AutomaticRescaleRangeMode == "Never"
    assert not representation.LookupTable.SMProxy.IsScalarBarVisible(
        simple.LocateView(representation).SMProxy)


def values(proxy, without=()):
    """All that is set on a filter, as text."""
    return {name: str(proxy.GetPropertyValue(name)) for name in proxy.ListProperties()
            if name not in ("Input", "Bodies", "TransferFunctions", "GradedFilter") + without
            and not proxy.GetProperty(name).SMProperty.GetInformationOnly()}
