# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Data drawn as Schlieren beside a surface by two ranks and by a server look as they do in one process; a server that
cannot draw says what to do. Skipped without mpiexec, pvbatch and pvserver.

With arguments, the part that another process does: draw into a file, or be the client of a server and do so."""

import os
import re
import shutil
import socket
import subprocess
import sys

from ranks_testing import MPIEXEC

PROGRAMS = ("mpiexec", "pvbatch", "pvpython", "pvserver")
CANNOT_DRAW = "xvfb-run -a -s -noreset pvserver"
DRAWS = "The server draws without a display."  # as it does since VTK 9.6


def without_mpi():
    """The environment without what makes MPI believe that a process belongs to others."""
    return {name: value for name, value in os.environ.items() if not name.startswith(("OMPI_", "PMIX_", "PRTE_"))}


# Only those who do the work import ParaView: MPI does not let a process that uses it start others that do.
# pylint: disable=import-outside-toplevel
def draw(path, is_remote=False):
    import quick_sessions  # noqa: F401
    from paraview import simple
    simple.LoadPlugin(os.environ["SCHLIEREN_PLUGIN"], remote=is_remote, ns=vars(simple))
    flow = simple.Calculator(Input=simple.Wavelet(WholeExtent=3 * [-10, 10]), ResultArrayName="rho", Function="RTData")
    flow.UpdatePipeline()
    view = simple.CreateRenderView(ViewSize=[240, 180], OrientationAxesVisibility=0, CameraParallelProjection=1)
    display = simple.Show(flow, view)
    display.SetRepresentationType("Schlieren")
    display.SchlierenBench.Quality = "Interactive"
    surface = simple.Show(simple.Sphere(Radius=3, Center=[2, 0, 0]), view)
    surface.DiffuseColor = [1, 0, 0]
    simple.ResetCamera(view)
    view.GetActiveCamera().Azimuth(20)
    if is_remote:
        # Drawn once with another camera and size.
        view.ViewSize = [60, 60]
        simple.Render(view)
        view.GetActiveCamera().Azimuth(30)
        simple.Render(view)
        view.GetActiveCamera().Azimuth(-30)
        view.ViewSize = [240, 180]  # by which a screenshot's fonts are scaled
    simple.SaveScreenshot(path, view, ImageResolution=[240, 180])
    display.SchlierenBench.UpdatePropertyInformation()
    assert "sample" in display.SchlierenBench.Status, display.SchlierenBench.Status
    simple.Delete(view)
    draw_mesh(simple, flow, path)


def draw_mesh(simple, flow, path):
    """Of data that stay on their ranks, where there are several, all of which trace rays."""
    mesh = simple.Transform(Input=flow)
    view = simple.CreateRenderView(ViewSize=[120, 90], OrientationAxesVisibility=0, CameraParallelProjection=1)
    display = simple.Show(mesh, view)
    display.SetRepresentationType("Schlieren")
    display.SchlierenBench.Quality = "Interactive"
    display.SchlierenBench.GatherLimit = 0
    simple.ResetCamera(view)
    for _ in range(2):
        view.GetActiveCamera().Azimuth(10)
        simple.Render(view)
        display.SchlierenBench.UpdatePropertyInformation()
        assert "sample" in display.SchlierenBench.Status, display.SchlierenBench.Status
        onSeveral = os.path.basename(path) == "2.png"
        assert ("on each of 2 ranks" in display.SchlierenBench.Status) == onSeveral, display.SchlierenBench.Status
        assert ("stay on their ranks" in display.SchlierenBench.Grid) == onSeveral, display.SchlierenBench.Grid
    simple.SaveScreenshot("mesh" + path, view, ImageResolution=[120, 90])


def draw_with_server(path, *launcher):
    import quick_sessions  # noqa: F401
    from paraview import servermanager, simple
    with socket.socket() as free:
        free.bind(("localhost", 0))
        port = free.getsockname()[1]
    # It tries until this process listens, and ends when this process does. With a launcher it has no display.
    environment = {name: value for name, value in without_mpi().items() if not launcher or name != "DISPLAY"}
    server = subprocess.Popen(
        [*launcher, "pvserver", "--reverse-connection", "--client-host=localhost", f"--server-port={port}"],
        env=environment)
    try:
        simple.ReverseConnect(str(port))
        assert servermanager.ActiveConnection.IsRemote()
        simple.LoadPlugin(os.environ["SCHLIEREN_PLUGIN"], remote=False, ns=vars(simple))
        view = simple.CreateRenderView()
        canDraw = view.GetClientSideObject().GetRemoteRenderingAvailable()
        assert canDraw or launcher
        if canDraw and launcher:
            print(DRAWS)
        simple.Delete(view)
        if canDraw:
            draw(path, is_remote=True)
        else:
            draw_nothing()
    except BaseException:
        server.kill()
        raise


def draw_nothing():
    from paraview import simple
    simple.LoadPlugin(os.environ["SCHLIEREN_PLUGIN"], remote=True, ns=vars(simple))
    flow = simple.Calculator(Input=simple.Wavelet(WholeExtent=3 * [-4, 4]), ResultArrayName="rho", Function="RTData")
    view = simple.CreateRenderView(ViewSize=[120, 90])
    simple.Show(flow, view).SetRepresentationType("Schlieren")
    simple.Render(view)
    simple.Render(view)  # which says it no more
    # The filter works there.
    bench = simple.Schlieren(Input=flow, ImageSize=[32, 32])
    bench.UpdatePipeline()
    bench.UpdatePropertyInformation()
    assert "sample" in bench.Status, bench.Status
    simple.Delete(view)


def pixels(path):
    import numpy as np
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkIOImage import vtkPNGReader
    reader = vtkPNGReader()
    reader.SetFileName(path)
    reader.Update()
    values = vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars()).astype(float)
    assert values.shape[1] == 3 and np.ptp(values) > 100, path
    return values


def compare():
    environment = without_mpi()
    for launcher, mode, path, *arguments in (
            ([*MPIEXEC, "1", "pvbatch"], "draw", "1.png"), ([*MPIEXEC, "2", "pvbatch"], "draw", "2.png"),
            (["pvpython"], "server", "server.png"), (["pvpython"], "server", "blind.png", "env")):
        done = subprocess.run([*launcher, os.path.abspath(__file__), mode, path, *arguments], env=environment,
                              timeout=240, check=True, capture_output=True, text=True)
        said = done.stdout + done.stderr
        assert "remote rendering" not in said, said
        errors = re.findall(r"ERR\|.*(?:\n(?!.*(?:ERR|WARN)\|).*)?", said)
        expected = CANNOT_DRAW if path == "blind.png" and DRAWS not in said else None
        assert len(errors) == (1 if expected else 0) and all(expected in error for error in errors), said
    for path in ("2.png", "server.png"):
        # Edges of surfaces may be smoothed by whatever composites the images.
        assert (abs(pixels(path) - pixels("1.png")).max(axis=1) > 1).mean() < 0.01, path
        assert abs(pixels("mesh" + path) - pixels("mesh1.png")).max() <= 1, path


# No exit from a process of MPI but at its end.
if sys.argv[1:]:
    {"draw": draw, "server": draw_with_server}[sys.argv[1]](*sys.argv[2:])
elif all(map(shutil.which, PROGRAMS)):
    compare()
else:
    print("Skipped: it takes", *PROGRAMS)
    sys.exit(77)
