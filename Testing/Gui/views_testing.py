# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""What the tests of the toolbar Schlieren share: pressing it, and looking at what it has made."""

import base64
import os
import re
import subprocess
import sys

import numpy as np

SOURCE = os.environ["SCHLIEREN_SOURCE_DIR"]
sys.path.insert(0, os.path.join(SOURCE, "Testing", "Python"))

from plugin_testing import image_array, simple  # noqa: E402, F401
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy  # noqa: E402
from vtkmodules.vtkCommonDataModel import vtkImageData  # noqa: E402
from vtkmodules.vtkIOImage import vtkPNGReader, vtkPNGWriter  # noqa: E402
from window_testing import FOLDER, Session  # noqa: E402

JET = os.path.join(SOURCE, "Testing", "Data", "ladenburg_jet_3d.vti")
TOOLBAR = "pqClientMainWindow/SchlierenToolBar/"
TRACE = os.path.join(FOLDER, "trace.py")

# Lets a session's scripts import inside_window.py.
INSIDE = f"""
import sys
sys.path.insert(0, {os.path.dirname(os.path.abspath(__file__))!r})
"""

# Opened and applied: images are shown as outlines.
OPEN_JET = f"""
from paraview.simple import *
jet = OpenDataFile({JET!r}, registrationName="jet")
jet.UpdatePipeline()
view = GetActiveViewOrCreate("RenderView")
Show(jet, view)
view.ResetCamera()
SetActiveSource(jet)
"""

# A mesh with a density, shown as a surface.
MESH = """
from paraview.simple import *
wave = Wavelet(WholeExtent=3 * [-8, 8], registrationName="wave")
rho = Calculator(Input=wave, Function="1e-3*RTData+1", ResultArrayName="rho",
                 registrationName="density")
mesh = AppendDatasets(Input=[rho], registrationName="mesh")
mesh.UpdatePipeline()
view = GetActiveViewOrCreate("RenderView")
Show(mesh, view)
view.ResetCamera()
SetActiveSource(mesh)
"""

# Writes the Python trace of what is done first, when the view shows it.
TRACE_FIRST_STEP = f"""
from paraview import smtrace
smtrace.start_trace()
def write(*_):
    if servermanager.vtkSMTrace.GetActiveTracer():
        text = smtrace.get_current_trace_output()
        if "SetActiveSource(" in text:
            with open({TRACE!r}, "w") as file:
                file.write(text)
            smtrace.stop_trace()
view.SMProxy.AddObserver("EndEvent", write)
"""


class ViewsSession(Session):
    def press(self, name):
        self.event(TOOLBAR + name, "activate")

    def check_button(self, name, prop, value):
        self.check_at(TOOLBAR + name, prop, value)

    def check_message(self, text):
        """The message that a mistake ends in; it is closed."""
        box = "pqClientMainWindow/SchlierenMessage"
        self.check_at(box, "text", text)
        self.event(box + "/qt_msgbox_buttonbox/1QPushButton0", "activate")

    def undo(self):
        self.menu("menu_Edit", "actionEditUndo")

    def redo(self):
        self.menu("menu_Edit", "actionEditRedo")


def traced(script, name):
    """What a trace sets of what it calls `name`: pairs of property and value, as text. It is name.A = 1, or since
    ParaView 6 name.Set(A=1, ...) with a line for each."""
    return re.findall(rf"^(?:{name}\.|    )(\w+) ?= ?(.*?),?$", script, re.MULTILINE)


def play_trace(state, before):
    """Plays what was traced in a program of its own, after the script `before`, and saves the state."""
    script = os.path.join(FOLDER, "played.py")
    with open(TRACE, encoding="utf-8") as trace, open(script, "w", encoding="utf-8") as file:
        file.write(f"import sys\nsys.path.insert(0, {os.path.join(SOURCE, 'Testing', 'Python')!r})\nimport quick_sessions\n"
                   f"{before}\n{trace.read()}\nRenderAllViews()\nSaveState({state!r})\n"
                   "[Delete(view) for view in GetRenderViews()]\n")
    environment = dict(os.environ, PV_PLUGIN_PATH=os.path.dirname(os.environ["SCHLIEREN_PLUGIN"]))
    done = subprocess.run(["pvpython", script], cwd=FOLDER, env=environment, text=True, check=False,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=100)
    print(done.stdout)
    assert done.returncode == 0, f"pvpython ended with {done.returncode}"


def load(state):
    simple.ResetSession()
    simple.LoadState(os.path.join(FOLDER, state))


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
    return simple.servermanager._getPyProxy(found) if found else None  # pylint: disable=protected-access


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


def screenshot(view, name, size):
    """RGB, rows x columns, lowest row first."""
    path = os.path.join(FOLDER, name)
    simple.SaveScreenshot(path, view, ImageResolution=size)
    return png(path)


def frame(bench, view, size, scale):
    """Makes the image of so many pixels, 2 * scale high, and lets it fill its view, pixel on pixel: no
    window's size matters then."""
    bench.ImageSize = size
    bench.ParallelScale = view.CameraParallelScale = scale
    bench.UpdatePipeline()
    low, high = np.reshape(bench.GetDataInformation().GetBounds(), (3, 2))[:2].T
    middle = list((low + high) / 2)
    view.CameraParallelProjection = 1
    view.CameraFocalPoint, view.CameraPosition = middle + [0], middle + [10 * scale]
    view.CameraViewUp = [0, 1, 0]
    view.OrientationAxesVisibility = 0
    shown(bench, view).SchlierenLegend = 0
    view.UseFXAA = 0  # would mix neighbouring pixels where they differ much


def show_grey(bench, view):
    """As the toolbar's images are shown: black is 0, white is 1."""
    simple.ColorBy(shown(bench, view), ("POINTS", "Intensity"))
    colors = simple.GetColorTransferFunction("Intensity")
    colors.AutomaticRescaleRangeMode = "Never"
    colors.ColorSpace = "RGB"
    colors.RGBPoints = [0, 0, 0, 0, 1, 1, 1, 1]
    shown(bench, view).SetScalarBarVisibility(view, False)


def check_baseline(view, name, size):
    """What the view shows, or several views side by side, is the kept image of that name."""
    several = view if isinstance(view, list) else [view]
    made = np.concatenate([screenshot(one, f"{place}{name}", size) for place, one in enumerate(several)],
                          axis=1)
    write_png(made, os.path.join(FOLDER, name))
    kept = png(os.path.join(SOURCE, "Testing", "Baseline", name))
    assert made.shape == kept.shape, (name, made.shape, kept.shape)
    difference = np.abs(made - kept)
    # The first is seen everywhere, the second in a small place: a line that has moved.
    assert difference.mean() < 0.2, (name, difference.mean())
    assert (difference.max(axis=2) > 40).mean() < 0.002, (name, (difference.max(axis=2) > 40).mean())


def write_png(pixels, path):
    """RGB, rows x columns, lowest row first."""
    image = vtkImageData()
    image.SetDimensions(pixels.shape[1], pixels.shape[0], 1)
    image.GetPointData().SetScalars(numpy_to_vtk(pixels.reshape(-1, 3).astype(np.uint8), deep=True))
    writer = vtkPNGWriter()
    writer.SetFileName(path)
    writer.SetInputData(image)
    writer.Write()


def png(path):
    reader = vtkPNGReader()
    reader.SetFileName(path)
    reader.Update()
    image = reader.GetOutput()
    columns, rows, _ = image.GetDimensions()
    return vtk_to_numpy(image.GetPointData().GetScalars()).reshape(rows, columns, -1).astype(int)


def png_of_text(text):
    """The pixels of an image that a property has as text."""
    head = "data:image/png;base64,"
    assert text.startswith(head), text[:40]
    path = os.path.join(FOLDER, "decoded.png")
    with open(path, "wb") as file:
        file.write(base64.b64decode(text[len(head):]))
    return png(path)


def values(proxy, without=()):
    """All that is set on a filter, as text."""
    return {name: str(proxy.GetPropertyValue(name)) for name in proxy.ListProperties()
            if name not in ("Input", "Bodies", "TransferFunctions", "GradedFilter") + without
            and not proxy.GetProperty(name).SMProperty.GetInformationOnly()}
