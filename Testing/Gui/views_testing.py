# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""What the tests of the toolbar Schlieren share: pressing it, and looking at what it has made."""

import base64
import os
import re
import subprocess

import numpy as np

from window_testing import FOLDER, MESH, OPEN_JET, OPEN_WHOLE_JET, SOURCE, ViewsSession  # noqa: F401, finds the next
from plugin_testing import image_array, simple  # noqa: F401
from shown_testing import check_display, check_linked, drawn, filters, frame_view, shown, values, views  # noqa: F401
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkIOImage import vtkPNGReader, vtkPNGWriter

TRACE = os.path.join(FOLDER, "trace.py")

# Writes the Python trace of what is done first, when the view shows it.
TRACE_FIRST_STEP = f"""
from paraview import smtrace
smtrace.start_trace()
def write(*_):
    if servermanager.vtkSMTrace.GetActiveTracer():
        text = smtrace.get_current_trace_output()
        if "AddCameraLink(" in text:
            with open({TRACE!r}, "w") as file:
                file.write(text)
            smtrace.stop_trace()
view.SMProxy.AddObserver("EndEvent", write)
"""


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
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=300)
    print(done.stdout)
    assert done.returncode == 0, f"pvpython ended with {done.returncode}"


def load(state):
    simple.ResetSession()
    simple.LoadState(os.path.join(FOLDER, state))


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
