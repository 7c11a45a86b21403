# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Data drawn as Schlieren beside a surface by two ranks, and by a server, look as they do in one process. Skipped
without mpiexec, pvbatch and pvserver.

With arguments, the part that another process does: draw into a file, or be the client of a server and do so."""

import os
import shutil
import socket
import subprocess
import sys

PROGRAMS = ("mpiexec", "pvbatch", "pvpython", "pvserver")


# Only those who do the work import ParaView: MPI does not let a process that uses it start others that do.
# pylint: disable=import-outside-toplevel
def draw(path, is_remote=False):
    from paraview import simple
    simple.LoadPlugin(os.environ["SCHLIEREN_PLUGIN"], remote=is_remote, ns=vars(simple))
    flow = simple.Wavelet(WholeExtent=3 * [-10, 10])
    flow.UpdatePipeline()
    view = simple.CreateRenderView(ViewSize=[120, 90], OrientationAxesVisibility=0, CameraParallelProjection=1)
    display = simple.Show(flow, view)
    display.SetRepresentationType("Schlieren")
    surface = simple.Show(simple.Sphere(Radius=3, Center=[2, 0, 0]), view)
    surface.DiffuseColor = [1, 0, 0]
    simple.ResetCamera(view)
    view.GetActiveCamera().Azimuth(20)
    simple.SaveScreenshot(path, view, ImageResolution=[120, 90])
    display.SchlierenBench.UpdatePropertyInformation()
    assert "sample" in display.SchlierenBench.Status, display.SchlierenBench.Status
    simple.Delete(view)


def draw_with_server(path):
    from paraview import servermanager, simple
    with socket.socket() as free:
        free.bind(("localhost", 0))
        port = free.getsockname()[1]
    # It tries until this process listens, and ends when this process does.
    server = subprocess.Popen(["pvserver", "--reverse-connection", "--client-host=localhost", f"--server-port={port}"])
    try:
        simple.ReverseConnect(str(port))
        assert servermanager.ActiveConnection.IsRemote()
        simple.LoadPlugin(os.environ["SCHLIEREN_PLUGIN"], remote=False, ns=vars(simple))
        draw(path, is_remote=True)
    except BaseException:
        server.kill()
        raise


def pixels(path):
    import numpy as np
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkIOImage import vtkPNGReader
    reader = vtkPNGReader()
    reader.SetFileName(path)
    reader.Update()
    values = vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars()).astype(float)
    assert values.shape == (90 * 120, 3) and np.ptp(values) > 100, path
    return values


def compare():
    # Without what tells MPI that a process belongs to others.
    environment = {name: value for name, value in os.environ.items() if not name.startswith(("OMPI_", "PMIX_", "PRTE_"))}
    ranks = ["mpiexec", "--allow-run-as-root", "--oversubscribe", "-np"]
    for launcher, mode, path in (([*ranks, "1", "pvbatch"], "draw", "1.png"),
                                 ([*ranks, "2", "pvbatch"], "draw", "2.png"),
                                 (["pvpython"], "server", "server.png")):
        subprocess.run([*launcher, os.path.abspath(__file__), mode, path], env=environment, timeout=100,
                       check=True)
    alone = pixels("1.png")
    for path in ("2.png", "server.png"):
        # Edges of surfaces may be smoothed by whatever composites the images.
        assert (abs(pixels(path) - alone).max(axis=1) > 1).mean() < 0.01, path


# No exit from a process of MPI but at its end.
if sys.argv[1:]:
    {"draw": draw, "server": draw_with_server}[sys.argv[1]](sys.argv[2])
elif all(map(shutil.which, PROGRAMS)):
    compare()
else:
    print("Skipped: it takes", *PROGRAMS)
    sys.exit(77)
