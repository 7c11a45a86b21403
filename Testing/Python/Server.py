# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""An image that a server makes, as scripts of its client request it and get it. Skipped without pvserver.

With a number, that of its ranks; then skipped without mpiexec, too."""

import os
import shutil
import socket
import subprocess
import sys
import time

import numpy as np
import quick_sessions  # noqa: F401
from paraview import servermanager, simple
from ranks_testing import MPIEXEC
from vtkmodules.util.numpy_support import vtk_to_numpy

PLUGIN = os.environ["SCHLIEREN_PLUGIN"]


def bench():
    """Two fields, one through a curve, with a ball in them; two rays per pixel, unlike any preset."""
    wavelet = simple.Wavelet(WholeExtent=3 * [-8, 8])
    fields = simple.Calculator(Input=wavelet, Function="coordsX", ResultArrayName="x")
    fields.UpdatePipeline()
    curve = simple.CreatePiecewiseFunction(Points=[0, 1, 0.5, 0, 0.5, 0, 0.5, 0, 1, 1, 0.5, 0])
    line = simple.CreatePiecewiseFunction(Points=[0, 0, 0.5, 0, 1, 1, 0.5, 0])
    return simple.Schlieren(Input=fields, Bodies=simple.Sphere(Radius=3), IndexModel="Transfer Functions",
                            Fields=["RTData", "x"], TransferFunctions=[curve, line], ImageSize=[32, 32],
                            Quality="Fine", SamplesPerPixel=2)


# Red, green, blue and white, as a PNG file.
PICTURE = ("data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAIAAAACCAIAAAD91JpzAAAAEklEQVR4nGP4z8DA"
           "AMIM/4EAAB/uBfsL2WiLAAAAAElFTkSuQmCC")


def arrays():
    schlieren = bench()
    image = servermanager.Fetch(schlieren)
    names = ("Intensity", "Deflection", "OpticalPathDifference", "BlockedFraction")
    made = {name: vtk_to_numpy(image.GetPointData().GetArray(name)).copy() for name in names}
    made["RaysTraced"] = vtk_to_numpy(image.GetFieldData().GetArray("RaysTraced")).copy()
    histogram = servermanager.Fetch(schlieren, idx=1)
    made["Rays"] = vtk_to_numpy(histogram.GetPointData().GetArray("Rays")).copy()
    schlieren.GradedFilter.Points = [0, 1, 0.5, 0, 1, 0, 0.5, 0]
    for cutoff, angle in (("Knife Edge", 180), ("Graded Filter", 0)):
        schlieren.Cutoff, schlieren.KnifeEdgeAngle = cutoff, angle
        image = servermanager.Fetch(schlieren)
        made[cutoff] = vtk_to_numpy(image.GetPointData().GetArray("Intensity")).copy()
    schlieren.Cutoff = "Color Filter"
    schlieren.ColorFilterImage = PICTURE
    colored = servermanager.Fetch(schlieren)
    made["Color"] = vtk_to_numpy(colored.GetPointData().GetArray("Color")).copy()
    made["Progressive"] = progressive(schlieren)
    return made


def progressive(schlieren):
    """As the window requests it."""
    schlieren.Cutoff = "Shadowgraph"
    schlieren.ImageSize = [256, 256]
    schlieren.SamplesPerPixel = 4
    schlieren.TimeLimit = 0.001
    start = time.monotonic()
    updates = 0
    schlieren.UpdatePipeline()
    schlieren.UpdatePropertyInformation()
    while not schlieren.GetProperty("Finished").GetData():
        schlieren.InvokeCommand("Refine")
        schlieren.UpdatePipeline()
        schlieren.UpdatePropertyInformation()
        updates += 1
    # Ranks that wait for each other in vain, do so for seconds.
    assert updates > 1 and time.monotonic() - start < 2 * updates, (updates, time.monotonic() - start)
    return vtk_to_numpy(servermanager.Fetch(schlieren).GetPointData().GetArray("Intensity")).copy()


pvserver, mpiexec = shutil.which("pvserver"), shutil.which("mpiexec")
if not pvserver or (sys.argv[1:] and not mpiexec):
    print("Skipped: there is no pvserver, or no mpiexec (Debian: openmpi-bin).")
    sys.exit(77)
launcher = [*MPIEXEC, sys.argv[1]] if sys.argv[1:] else []
# Without what makes MPI believe that a process belongs to others.
environment = {name: value for name, value in os.environ.items() if not name.startswith(("OMPI_", "PMIX_", "PRTE_"))}
simple.LoadPlugin(PLUGIN, remote=False, ns=vars(simple))
here = arrays()
simple.Disconnect()

with socket.socket() as free:
    free.bind(("localhost", 0))
    port = free.getsockname()[1]
# It tries until this process listens, and ends when this process does.
server = subprocess.Popen([*launcher, pvserver, "--reverse-connection", "--client-host=localhost",
                           f"--server-port={port}", "--force-offscreen-rendering"], env=environment)
try:
    simple.ReverseConnect(str(port))
    assert servermanager.ActiveConnection.IsRemote()
    simple.LoadPlugin(PLUGIN, remote=True, ns=vars(simple))
    there = arrays()
except BaseException:
    server.kill()
    raise
for name, values in here.items():
    assert np.array_equal(values, there[name]), name
assert np.ptp(here["Intensity"]) > 0.5 and here["BlockedFraction"].max() == 1
assert 2 * 32 * 32 <= here["RaysTraced"][0] < 4 * 32 * 32, here["RaysTraced"]
assert here["Rays"].shape == (256**2,) and here["Rays"].sum() > 0
assert np.abs(here["Knife Edge"] - here["Graded Filter"]).max() < 1e-3  # which falls from 1 to 0
assert len(np.unique(here["Color"], axis=0)) > 10
