# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""What the tests of several ranks share: how they are started, and flows of which each rank has a part."""

import os
import shutil
import subprocess
import sys


# To be followed by a number. Ranks that wait leave the processors to others, as tests run side by side.
MPIEXEC = ["mpiexec", "--allow-run-as-root", "--oversubscribe", "--mca", "mpi_yield_when_idle", "1", "-np"]


def skip_without_mpi():
    if not shutil.which("mpiexec") or not shutil.which("pvbatch"):
        print("Skipped: there is no mpiexec (Debian: openmpi-bin) or no pvbatch.")
        sys.exit(77)


def on(ranks):
    """The command that runs a script on so many ranks."""
    pvbatch = ["pvbatch", "--force-offscreen-rendering"]
    return pvbatch if ranks == 1 else [*MPIEXEC, str(ranks), *pvbatch]


def run(command, *arguments, ends=True, script=sys.argv[0], folder=".", **environment):
    """Runs a script, by default that of the test, with arguments and more environment, and gives its output. `ends`:
    whether it succeeds; None: it may."""
    # What makes MPI believe that a process belongs to others.
    inherited = {name: value for name, value in os.environ.items()
                 if not name.startswith(("OMPI_", "PMIX_", "PRTE_"))}
    done = subprocess.run([*command, os.path.abspath(script), *arguments], env=inherited | environment, cwd=folder, text=True,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=300, check=False)
    print(done.stdout)
    assert ends in (None, done.returncode == 0) and "Traceback" not in done.stdout, command
    return done.stdout


def is_rank0():
    from vtkmodules.vtkParallelCore import vtkMultiProcessController
    return vtkMultiProcessController.GetGlobalController().GetLocalProcessId() == 0  # not always with --sym


def on_several():
    from vtkmodules.vtkParallelCore import vtkMultiProcessController
    controller = vtkMultiProcessController.GetGlobalController()
    return controller is not None and controller.GetNumberOfProcesses() > 1


# A Gaussian ball in a cube of 12 x 12 x 12 cells, of which each rank has a part, whatever is requested.
WHOLE_EXTENT = """
info = self.GetExecutive().GetOutputInformation(0)
info.Set(self.CAN_HANDLE_PIECE_REQUEST(), 1)
if IS_GRID:
    info.Set(self.GetExecutive().WHOLE_EXTENT(), [0, 12, 0, 12, 0, 12], 6)
"""
BALL = """
import numpy as np
from vtkmodules.vtkCommonCore import vtkIdList, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkFiltersCore import vtkAppendFilter, vtkExtractCells, vtkPointDataToCellData
from vtkmodules.vtkFiltersGeneral import vtkDataSetTriangleFilter
from vtkmodules.vtkParallelCore import vtkMultiProcessController
from vtkmodules.util.numpy_support import numpy_to_vtk
ranks = vtkMultiProcessController.GetGlobalController()
rank, number = ranks.GetLocalProcessId(), ranks.GetNumberOfProcesses()
kind = KIND
n = 12

def axis(start, end):
    return -1 + 2 * np.arange(start, end + 1) / n

def put_values(data, x, y, z):
    values = numpy_to_vtk((1.2 + 0.1 * np.exp(-(x * x + y * y + z * z) / 0.16)).ravel(), deep=1)
    values.SetName("rho")
    data.GetPointData().AddArray(values)

def put_place(image, extent):
    image.SetOrigin(-1, -1, -1)
    image.SetSpacing(2 / n, 2 / n, 2 / n)
    image.SetExtent(*extent)

def put_block(blocks, level, at):
    block = vtkImageData()
    size = 0.125 / 2**level
    block.SetDimensions(9, 9, 9)
    block.SetSpacing(size, size, size)
    block.SetOrigin(*(np.array(at) * 8 * size - 1 / 2**level))
    x, y, z = (block.GetOrigin()[i] + size * (np.arange(8) + 0.5) for i in range(3))
    x, y, z = x[None, None, :], y[None, :, None], z[:, None, None]
    rho = 1.2 + 0.1 * np.exp(-(x * x + y * y + z * z) / 0.16)
    rho[np.broadcast_to((abs(x + 0.5) < 0.2) & (abs(y - 0.1) < 0.2) & (abs(z - 0.2) < 0.4), rho.shape)] = np.nan
    values = numpy_to_vtk(rho.ravel(), deep=1)
    values.SetName("rho")
    block.GetCellData().AddArray(values)
    blocks.SetBlock(level * 8 + at[0] + 2 * at[1] + 4 * at[2], block)

isGrid = kind in ("image", "rectilinear", "curvilinear")
first, last = (n * rank // number, n * (rank + 1) // number) if isGrid else (0, n)
z, y, x = np.meshgrid(axis(first, last), axis(0, n), axis(0, n), indexing="ij")
extent = (0, n, 0, n, first, last)
output = self.GetOutputDataObject(0)
if kind == "image":
    put_place(output, extent)
    put_values(output, x, y, z)
elif kind == "rectilinear":
    output.SetExtent(*extent)
    output.SetXCoordinates(numpy_to_vtk(axis(0, n), deep=1))
    output.SetYCoordinates(numpy_to_vtk(axis(0, n), deep=1))
    output.SetZCoordinates(numpy_to_vtk(axis(first, last), deep=1))
    put_values(output, x, y, z)
elif kind == "curvilinear":
    x = x * (1 + 0.1 * z)
    output.SetExtent(*extent)
    points = vtkPoints()
    points.SetDataTypeToDouble()
    points.SetData(numpy_to_vtk(np.stack([x.ravel(), y.ravel(), z.ravel()], 1), deep=1))
    output.SetPoints(points)
    put_values(output, x, y, z)
elif kind == "amr":
    # A cube of 8 blocks, in its middle 8 of half the size, and again, one by one to the ranks: those of three ranks have
    # the same numbers of cells and the same bounds.
    for n in range(24):
        if n * 7 % number == rank:
            put_block(output, n // 8, [n % 2, n // 2 % 2, n // 4 % 2])
        else:
            output.SetBlock(n, None)
else:
    image = vtkImageData()
    put_place(image, extent)
    put_values(image, x, y, z)
    cells = vtkDataSetTriangleFilter() if kind == "tetrahedra" else vtkAppendFilter()
    cells.AddInputDataObject(image)
    cells.Update()
    mesh = cells.GetOutput()
    # Those between two oblique planes.
    normal = np.array([0.3, -0.5, 0.8])
    own = vtkIdList()
    bounds = [0] * 6
    for cell in range(mesh.GetNumberOfCells()):
        mesh.GetCellBounds(cell, bounds)
        place = np.dot(normal, [bounds[0] + bounds[1], bounds[2] + bounds[3], bounds[4] + bounds[5]]) / 2
        if int(np.clip((place / np.abs(normal).sum() + 1) / 2 * number, 0, number - 1)) == rank:
            own.InsertNextId(cell)
    extract = vtkExtractCells()
    extract.SetInputData(mesh)
    extract.SetCellList(own)
    means = vtkPointDataToCellData()
    means.SetInputConnection(extract.GetOutputPort())
    means.SetPassPointData(kind != "cell data")
    means.Update()
    output.ShallowCopy(means.GetOutput())
    if kind != "cell data":
        output.GetCellData().Initialize()
"""


STEPS = """
info.Set(self.GetExecutive().TIME_STEPS(), TIMES, len(TIMES))
info.Set(self.GetExecutive().TIME_RANGE(), [TIMES[0], TIMES[-1]], 2)
"""
TIME = """
info = self.GetExecutive().GetOutputInformation(0)
key = self.GetExecutive().UPDATE_TIME_STEP()
time = info.Get(key) if info.Has(key) else TIMES[0]
"""
TIME_OF_OUTPUT = """
output.GetInformation().Set(output.DATA_TIME_STEP(), time)
"""


def moving_ball(kind, output, times):
    """A source of the ball, which is at x = time, with these time steps."""
    from paraview.simple import ProgrammableSource
    script = TIME + BALL.replace("KIND", repr(kind)).replace("-(x * x", "-((x - time)**2") + TIME_OF_OUTPUT
    information = WHOLE_EXTENT.replace("IS_GRID", str(output == "vtkImageData")) + STEPS
    return ProgrammableSource(OutputDataSetType=output, Script=script.replace("TIMES", repr(times)),
                              ScriptRequestInformation=information.replace("TIMES", repr(times)))
