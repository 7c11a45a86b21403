# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Each mistake of a user ends in one line that says what is wrong, no image, and an exit code."""

import os
import subprocess

from demo_testing import DATA, SOURCE, run_demo, run_here
from vtkmodules.vtkImagingCore import vtkRTAnalyticSource
from vtkmodules.vtkIOXML import vtkXMLImageDataWriter

JET = os.path.join(DATA, "ladenburg_jet_3d.vti")


def fails(*arguments, saying, run=run_here):
    returned, _, err = run(*arguments, "--output", "never.png")
    assert returned == 1, f"{arguments}: exit code {returned}"
    lines = [line for line in err.splitlines() if "error: " in line]
    assert len(lines) == 1 and all(word in lines[0] for word in saying), f"{arguments}: {err}"
    assert "Traceback" not in err, err
    assert not os.path.exists("never.png"), f"{arguments}: there is an image"


def write(name, dimensions):
    source = vtkRTAnalyticSource()
    source.SetWholeExtent(*(number for n in dimensions for number in (0, n - 1)))
    writer = vtkXMLImageDataWriter()
    writer.SetFileName(name)
    writer.SetDataModeToBinary()
    writer.SetInputConnection(source.GetOutputPort())
    writer.Write()


fails(JET, "--array", "Rho", saying=("no array 'Rho'", "Its arrays: rho"))
write("wavelet.vti", (9, 9, 9))
fails("wavelet.vti", saying=("choose one with --array", "RTData"))
fails("wavelet.vti", "--formula", "2*Rtdata", saying=("'2*Rtdata' gives no values", "RTData"))
write("line.vti", (9, 1, 1))
fails("line.vti", "--array", "RTData", saying=("line.vti", "no thickness along"))
with open("broken.vti", "w") as stream:
    stream.write('<VTKFile type="ImageData" version="0.1"><ImageData>')
fails("broken.vti", saying=("ParaView", "broken.vti"))
fails(os.path.join(DATA, "bluntfin_plot3d", "bluntfinq.bin"), saying=("no reader for",))
fails(JET, "--set", "KnifeAngle=3", saying=("no property 'KnifeAngle'", "KnifeEdgeAngle"))
fails(JET, "--set", "Quality=Best", saying=("'Quality' does not take 'Best'", "Interactive, Fine"))
fails(JET, "--model", "Refractive Index", "--array", "rho", "--plugin", "nothing.so",
      saying=("nothing.so", "does not load"), run=run_demo)

# The command itself finds such mistakes before it installs or builds anything, and so it helps.
command = os.path.join(SOURCE, "Utilities", "demo")
done = subprocess.run([command, "nowhere.vti"], capture_output=True, text=True, timeout=60)
assert done.returncode == 1 and "no file 'nowhere.vti'" in done.stderr and not done.stdout, done
done = subprocess.run([command, JET, "--view", "w"], capture_output=True, text=True, timeout=60)
assert done.returncode == 2 and "--view" in done.stderr and "'w'" in done.stderr and not done.stdout, done
done = subprocess.run([command, "--help"], capture_output=True, text=True, timeout=60)
assert done.returncode == 0 and "--array NAME" in done.stdout, done
