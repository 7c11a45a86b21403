# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Runs the demo's Python part as a user does and takes its image apart."""

import os
import re
import runpy
import subprocess
import sys
import tempfile

import numpy as np
from paraview import simple
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkOutputWindow
from vtkmodules.vtkIOImage import vtkPNGReader

PVPYTHON = sys.argv[1]
SOURCE = os.environ["SCHLIEREN_SOURCE_DIR"]
DATA = os.path.join(SOURCE, "Testing", "Data")
SCRIPT = os.path.join(SOURCE, "Utilities", "four_images", "main.py")
sys.path.insert(0, os.path.dirname(SCRIPT))

from sheet import layout  # noqa: E402


def snippets(page):
    """The Python scripts that a page of Documentation prints."""
    with open(os.path.join(SOURCE, "Documentation", page + ".md"), encoding="utf-8") as file:
        return re.findall(r"^```python\n(.*?)^```", file.read(), re.DOTALL | re.MULTILINE)


def run_demo(*arguments):
    """(exit code, stdout, stderr) of the demo."""
    done = subprocess.run([PVPYTHON, SCRIPT, *arguments], capture_output=True, text=True,
                          timeout=170)
    print(done.stdout, done.stderr, flush=True)
    return done.returncode, done.stdout, done.stderr


def run_here(*arguments):
    """As run_demo(), in this process, which has ParaView already."""
    kept = sys.argv, sys.stdout, sys.stderr, sys.__stdout__, sys.__stderr__
    window = vtkOutputWindow.GetInstance()  # which pvpython's streams end in
    sys.argv = [SCRIPT, *arguments]
    with tempfile.TemporaryFile("w+") as out, tempfile.TemporaryFile("w+") as err:
        sys.__stdout__, sys.__stderr__ = out, err  # which the demo prints to
        try:
            runpy.run_path(SCRIPT, run_name="__main__")
            code = 0
        except SystemExit as end:
            code = end.code
            if isinstance(code, str):
                print(code, file=err)
                code = 1
        finally:
            sys.argv, sys.stdout, sys.stderr, sys.__stdout__, sys.__stderr__ = kept
            vtkOutputWindow.SetInstance(window)
        simple.ResetSession()
        said = [stream.seek(0) or stream.read() for stream in (out, err)]
    print(*said, flush=True)
    return code, *said


def image_array(path):
    """A PNG as rows (top first) x columns x RGB, as floats 0 to 255."""
    reader = vtkPNGReader()
    reader.SetFileName(path)
    reader.Update()
    columns, rows, _ = reader.GetOutput().GetDimensions()
    pixels = vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars())
    return pixels.reshape(rows, columns, -1)[::-1].astype(float)


def tiles(path, frame):
    """Volume (RGB, 0 to 255), vertical knife, horizontal knife and shadowgraph (grey, 0 to 1).

    Row 0 is the lowest one, as in the frame's coordinates.
    """
    sheet = image_array(path)
    width, height, corners, _ = layout(frame)
    assert sheet.shape == (height, width, 3), f"The sheet is {sheet.shape}"
    parts = [sheet[top:top + frame.height, left:left + frame.width][::-1] for left, top in corners]
    for part in parts[1:]:
        assert np.ptp(part, axis=2).max() == 0, "A bench's image is not grey"
    return [parts[0]] + [part[..., 0] / 255 for part in parts[1:]]


def check_not_blank(volume, vertical, horizontal, shadow):
    for name, tile in (("vertical", vertical), ("horizontal", horizontal), ("shadow", shadow)):
        mean, deviation = tile.mean(), tile.std()
        saturated = np.mean((tile == 0) | (tile == 1))
        print(f"{name}: mean {mean:.3f}, deviation {deviation:.3f}, saturated {saturated:.3f}")
        assert 0.35 < mean < 0.65, f"{name}: most of the light should be undisturbed"
        assert deviation > 0.01, f"{name}: blank"
        assert saturated < 0.15, f"{name}: clipped"
    colorful = np.mean(np.ptp(volume, axis=2) > 60)
    print(f"volume: {colorful:.2f} of it is coloured")
    assert 0.1 < colorful < 0.98, "volume: blank"
