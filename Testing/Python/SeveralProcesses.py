# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Several ranks give the images of one process, or one error message. Skipped without mpiexec and pvbatch.

With arguments, what one or more ranks do: "images" and the file for its results, on several with "failures" after them
in the same processes, or "killed".
"""

import os
import re
import sys
from time import monotonic as time_of_day

import numpy as np
from ranks_testing import BALL, WHOLE_EXTENT, is_rank0, moving_ball, on, on_several, run, skip_without_mpi

HERE = os.path.dirname(os.path.abspath(__file__))
BENCH = {"Density": ["POINTS", "RTData"], "GladstoneDaleConstant": 1e-6, "ImageSize": [32, 32]}
ARRAYS = ("Deflection", "OpticalPathDifference", "BlockedFraction")


# Only those who do the work import the plugin: MPI does not let a process that uses it start others that do.
# pylint: disable=import-outside-toplevel
def ball(kind):
    """A ball of which each rank has a part, whatever is requested."""
    from paraview.simple import ProgrammableSource
    output = {"image": "vtkImageData", "rectilinear": "vtkRectilinearGrid", "curvilinear": "vtkStructuredGrid",
              "amr": "vtkMultiblockDataSet"}.get(kind, "vtkUnstructuredGrid")
    return ProgrammableSource(OutputDataSetType=output, Script=BALL.replace("KIND", repr(kind)),
                              ScriptRequestInformation=WHOLE_EXTENT.replace("IS_GRID", str(output != "vtkMultiblockDataSet" and "Unstructured" not in output)))


# Blocks side by side: structured ones of which each rank has a slab, whatever is requested, or whole ones in turn.
BLOCKS = """
import numpy as np
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkStructuredGrid
from vtkmodules.vtkParallelCore import vtkMultiProcessController
from vtkmodules.util.numpy_support import numpy_to_vtk
ranks = vtkMultiProcessController.GetGlobalController()
rank, number = ranks.GetLocalProcessId(), ranks.GetNumberOfProcesses()
n = 24
output = self.GetOutputDataObject(0)
for block in range(2):
    output.SetBlock(block, None)
    j = [n * rank // number, n * (rank + 1) // number]
    if HOW == "whole":
        j = [0, n]
        if block % number != rank:
            continue
    x, y = np.linspace(block - 1.0, block, n + 1), np.linspace(-1, 1, n + 1)[j[0]:j[1] + 1]
    z = {"3-D": np.linspace(-0.5, 0.5, 9), "one layer": np.array([-0.5, 0.5]), "2-D": np.zeros(1)}[DIMENSION]
    X, Y, Z = np.meshgrid(x, y, z, indexing="ij")
    places = np.stack([a.ravel(order="F") for a in (X, Y, Z)], axis=1)
    grid = vtkStructuredGrid()
    grid.SetDimensions(len(x), len(y), len(z))
    points = vtkPoints()
    points.SetData(numpy_to_vtk(places, deep=1))
    grid.SetPoints(points)
    values = numpy_to_vtk(1.2 + 0.1 * np.exp(-(places**2).sum(axis=1) / 0.1), deep=1)
    values.SetName("rho")
    grid.GetPointData().SetScalars(values)
    output.SetBlock(block, grid)
"""


def sources():
    """Names, sources, arrays, bodies, whether the data stay where they are with GatherLimit 0, and settings."""
    from paraview.simple import (Calculator, ExodusIIReader, GroupDatasets, HierarchicalFractal, OpenFOAMReader,
                                 PLOT3DReader, PointDatatoCellData, ProgrammableSource, Sphere, Tetrahedralize, Transform, Wavelet,
                                 XMLUnstructuredGridReader)
    body = Sphere(Radius=0.2, Center=[0.5, 0.2, 0])
    for kind in ("image", "rectilinear", "curvilinear", "hexahedra", "tetrahedra", "cell data"):
        yield (kind, ball(kind), ["CELLS" if kind == "cell data" else "POINTS", "rho"],
               body if kind in ("image", "hexahedra") else None, True, {})
    yield "amr", ball("amr"), ["CELLS", "rho"], body, False, {"MediumTolerance": 0.05}
    for dimension in ("2-D", "one layer", "3-D"):
        for how in ("slabs", "whole"):
            blocks = ProgrammableSource(OutputDataSetType="vtkMultiblockDataSet",
                                        Script=BLOCKS.replace("HOW", repr(how)).replace("DIMENSION", repr(dimension)))
            yield f"{how} of blocks in {dimension}", blocks, ["POINTS", "rho"], None, False, {}
    # Each rank gets what it requests.
    wavelet = Wavelet(WholeExtent=[-12, 14, -10, 10, -9, 9])
    settings = {"GladstoneDaleConstant": 1e-6}
    yield "requested image", wavelet, ["POINTS", "RTData"], Sphere(Radius=4, Center=[1, 2, 3]), True, settings
    yield "requested grid", Transform(Input=wavelet), ["POINTS", "RTData"], None, True, settings
    angle = "(coordsX + 12) * 3.14159265358979 / 13"
    ring = Calculator(Input=Transform(Input=wavelet), CoordinateResults=1, Function=f"(coordsY + 14) * cos({angle}) * iHat + "
                      f"(coordsY + 14) * sin({angle}) * jHat + coordsZ * kHat")
    ring = Calculator(Input=ring, ResultArrayName="rho", Function="1.2 + 0.1 * exp(-((coordsX - 14)^2 + coordsY^2) / 30)")
    yield "requested O-grid", ring, ["POINTS", "rho"], None, False, {}
    # Half of a shell, whose slices all end at the same axis.
    polar, around = "(coordsZ + 9) * 3.14159265358979 / 18", "(coordsX + 12) * 3.14159265358979 / 26"
    shell = Calculator(Input=Transform(Input=wavelet), CoordinateResults=1, Function=f"(coordsY + 14) * (cos({polar}) * iHat + "
                       f"sin({polar}) * (sin({around}) * jHat + cos({around}) * kHat))")
    shell = Calculator(Input=shell, ResultArrayName="rho", Function="1.2 + 0.1 * exp(-((coordsX - 14)^2 + coordsZ^2) / 30)")
    yield "requested shell with poles", shell, ["POINTS", "rho"], None, False, {}
    yield "requested tetrahedra", Tetrahedralize(Input=wavelet), ["POINTS", "RTData"], None, True, settings
    cells = GroupDatasets(Input=[PointDatatoCellData(Input=Wavelet(WholeExtent=[*ends, -10, 10, -9, 9]))
                                 for ends in ((-12, 0), (0, 14))])
    yield "requested blocks", cells, ["CELLS", "RTData"], None, False, settings
    # Files that each rank reads a part of, or all, or none, as their readers like it.
    data = os.path.join(HERE, "..", "Data", "")
    foam = OpenFOAMReader(FileName=data + "ladenburg_openfoam/ladenburg.foam")
    foam.MeshRegions = ["internalMesh"]
    foam.CellArrays = ["T"]
    disk = ExodusIIReader(FileName=[data + "disk_exodus/disk_out_ref.ex2"])
    disk.PointVariables = ["Temp"]
    fin = PLOT3DReader(FileName=data + "bluntfin_plot3d/bluntfinxyz.bin",
                       QFileName=data + "bluntfin_plot3d/bluntfinq.bin", FunctionFileName="")
    fin.Functions = [100]
    coarse = {"MediumTolerance": 0.1}
    yield "disk", disk, ["POINTS", "Temp"], None, False, coarse
    yield "fin", fin, ["POINTS", "Density"], None, True, coarse
    yield "wedge", foam, ["CELLS", "T"], None, False, coarse
    yield ("coil", XMLUnstructuredGridReader(FileName=[data + "heating_coil_fluid.vtu"]), ["POINTS", "Temperature"], None,
           None, coarse)
    yield "fractal", HierarchicalFractal(Dimensions=6), ["CELLS", "Fractal Volume Fraction"], None, False, coarse


def images():
    """Arrays that rank 0 has, by their names."""
    from paraview.simple import Calculator, TemporalInterpolator, TemporalStatistics
    from plugin_testing import Schlieren, image_array
    found = {}
    for name, source, density, bodies, stays, settings in sources():
        for limit in (0, 10000000) if name in ("image", "hexahedra") else (0,):
            kind = f"{name}, gathered" if limit else f"{name}, in pieces"
            seen = Schlieren(Input=source, Density=density, Bodies=bodies, ImageSize=[60, 60], GatherLimit=limit,
                             ViewDirection=[0, 0, -1] if "2-D" in name or "layer" in name else [0.2, -0.6, -0.8],
                             **({"MediumTolerance": 1e-2} | settings))
            for array in ARRAYS:
                found[f"{kind}: {array}"] = image_array(seen, array)
            seen.UpdatePropertyInformation()
            isInPieces = "on their ranks" in seen.GetProperty("Grid").GetData()
            expected = is_rank0() and on_several() and not limit and stays
            assert stays is None or isInPieces == expected, (kind, isInPieces)
            # The others have none, so that nothing is counted or drawn twice.
            assert seen.GetDataInformation().GetNumberOfPoints() == 60 * 60, kind
            if name in ("hexahedra", "cell data", "amr"):
                seen.Input = Calculator(Input=seen.Input, ResultArrayName="dense", Function="rho - 0.78",
                                        AttributeType="Cell Data" if density[0] == "CELLS" else "Point Data")
                seen.Mask = [density[0], "dense"]
                found[f"{kind}, masked: Deflection"] = image_array(seen, "Deflection")
    # Time-sliced: the same number of steps on all ranks, whoever knows that the image is finished.
    seen = Schlieren(Input=ball("tetrahedra"), Density=["POINTS", "rho"], ImageSize=[60, 60], GatherLimit=0, TimeLimit=0.05)
    seen.UpdatePipeline()
    for _ in range(40):
        seen.InvokeCommand("Refine")
        seen.UpdatePipeline()
    seen.UpdatePropertyInformation()
    assert not is_rank0() or seen.GetProperty("Finished").GetData() == 1
    found["time-sliced: Deflection"] = image_array(seen, "Deflection")
    # The settings that a target error chooses.
    seen = Schlieren(Input=ball("hexahedra"), Density=["POINTS", "rho"], ImageSize=[60, 60], Cutoff="Shadowgraph",
                     ViewDirection=[0.2, -0.6, -0.8], TargetError=-1)
    found["automatic: Intensity"] = image_array(seen, "Intensity")
    facts = seen.GetClientSideObject().GetOutputDataObject(0).GetFieldData()
    found["automatic: settings"] = np.array([facts.GetArray(name).GetValue(0) for name in
                                             ("StepSize", "SamplesPerPixel", "ErrorReached")] if is_rank0() else [0.0])
    # Exposures, of pieces, too.
    for kind, output, limits in (("image", "vtkImageData", [10000000]), ("tetrahedra", "vtkUnstructuredGrid", [10000000, 0])):
        for limit in limits:
            instants = TemporalInterpolator(Input=moving_ball(kind, output, [0, 0.5, 1]), DiscreteTimeStepInterval=0.25)
            seen = Schlieren(Input=instants, Density=["POINTS", "rho"], ImageSize=[40, 40], GatherLimit=limit,
                             MediumTolerance=1e-2)
            found[f"exposed {kind}, {limit}: Deflection"] = image_array(TemporalStatistics(Input=seen), "Deflection_average")
    # Two filters use the medium that one of them has made, in turns.
    settings = {"Input": ball("tetrahedra"), "Density": ["POINTS", "rho"], "GatherLimit": 0, "ImageSize": [40, 40]}
    first, second = Schlieren(**settings), Schlieren(Cutoff="Shadowgraph", PathModel="Straight", **settings)
    for turn, direction in enumerate(([0, 0, -1], [0.2, 0.1, -1])):
        for name, bench in (("first", first), ("second", second)):
            bench.ViewDirection = direction
            found[f"shared {turn}, {name}: Deflection"] = image_array(bench, "Deflection")
    builds = [bench.GetClientSideObject().GetMediumBuilds() for bench in (first, second)]
    assert builds == [is_rank0(), 0], builds
    return found


# 16 x 16 x 16 cells, of which each rank has a slab.
DATA = """
from vtkmodules.vtkFiltersCore import vtkAppendFilter
from vtkmodules.vtkImagingCore import vtkRTAnalyticSource
from vtkmodules.vtkParallelCore import vtkMultiProcessController
ranks = vtkMultiProcessController.GetGlobalController()
rank, number = ranks.GetLocalProcessId(), ranks.GetNumberOfProcesses()
wavelet = vtkRTAnalyticSource()
wavelet.SetWholeExtent(-8, 8, -8, 8, -8, 8)
wavelet.UpdateExtent([-8, 8, -8, 8, -8 + 16 * rank // number, -8 + 16 * (rank + 1) // number])
cells = vtkAppendFilter()
cells.SetInputData(wavelet.GetOutput())
cells.Update()
output = self.GetUnstructuredGridOutput()
output.ShallowCopy(cells.GetOutput())
"""


def slabs(more=""):
    from paraview.simple import ProgrammableSource
    return ProgrammableSource(OutputDataSetType="vtkUnstructuredGrid", Script=DATA + more,
                              ScriptRequestInformation="self.GetExecutive().GetOutputInformation(0).Set(self.CAN_HANDLE_PIECE_REQUEST(), 1)")


def say(words):
    if is_rank0():
        print(words, file=sys.stderr, flush=True)  # where error messages go


def expect(words, bench, isMade, seconds=15):
    """An update, and whether it makes something. `words`: of the only error message where there is one."""
    say("Expected: " + words)
    start = time_of_day()
    bench.UpdatePipeline()
    bench.UpdatePipeline()  # no second error, and nobody waits for ranks that have nothing to do
    assert time_of_day() - start < seconds, (words, time_of_day() - start)
    points = bench.GetDataInformation().GetNumberOfPoints()
    assert (points > 0) == (isMade and is_rank0()), f"{words}: {points} points"


def failures():
    """What fails on one rank: a file that it cannot read, an array that it has not; and a rank that is slow."""
    from paraview.simple import ProgrammableSource, XMLImageDataReader
    from plugin_testing import Schlieren
    from vtkmodules.vtkImagingCore import vtkRTAnalyticSource
    from vtkmodules.vtkIOXML import vtkXMLImageDataWriter
    wavelet = vtkRTAnalyticSource()
    writer = vtkXMLImageDataWriter()
    writer.SetFileName("small.vti")
    writer.SetDataModeToBinary()
    writer.SetInputConnection(wavelet.GetOutputPort())
    writer.Write()
    mover = ProgrammableSource()

    def move(rank, folder):
        mover.Script = f"""
import os
from vtkmodules.vtkParallelCore import vtkMultiProcessController
if vtkMultiProcessController.GetGlobalController().GetLocalProcessId() == {rank}:
    os.chdir({folder!r})
"""
        mover.UpdatePipeline()

    reader = XMLImageDataReader(FileName=["small.vti"])
    seen = Schlieren(Input=reader, **BENCH)
    expect("nothing", seen, True)
    for rank in (0, 2):
        here = os.getcwd()
        move(rank, "/")
        reader.FileName = ["./small.vti"]
        expect(f"Rank {rank} of 3 has no input", seen, False)
        move(rank, here)
        reader.FileName = ["small.vti"]
        expect("nothing", seen, True)
    lacking = slabs("if rank == 2: output.GetPointData().RemoveArray('RTData')")
    for limit in (0, 10000000):
        expect("have not the same arrays", Schlieren(Input=lacking, GatherLimit=limit, **BENCH), False)
    slow = slabs("import time; time.sleep(1 if rank == 2 else 0)")
    for limit in (0, 10000000):
        expect("nothing", Schlieren(Input=slow, GatherLimit=limit, **BENCH), True, seconds=40)
    # Aborted, and then made.
    seen = Schlieren(Input=slabs(), GatherLimit=0, **(BENCH | {"ImageSize": [400, 400]}))
    bench = seen.GetClientSideObject()

    def stop(*_):
        if bench.GetProgress() > 0.5:
            bench.SetAbortExecute(1)
    if is_rank0():
        observer = bench.AddObserver("ProgressEvent", stop)
    seen.UpdatePipeline()
    assert seen.GetDataInformation().GetNumberOfPoints() == 0
    if is_rank0():
        bench.RemoveObserver(observer)
    seen.ImageSize = [40, 40]
    expect("nothing", seen, True)


def killed():
    """A rank that ends while the others work."""
    from plugin_testing import Schlieren
    Schlieren(Input=slabs("""
if rank == 2:
    import os
    os.kill(os.getpid(), 9)
"""), **BENCH).UpdatePipeline()


if sys.argv[1:2] == ["images"]:
    import plugin_testing  # noqa: F401, loads the plugin
    np.savez(sys.argv[2], **images())
    if sys.argv[3:] == ["failures"]:
        say("Expected: failures")
        failures()
        say("Expected: the end")
elif sys.argv[1:]:
    killed()
else:
    skip_without_mpi()

    def results(ranks, file, *more):
        """The arrays, and what is said afterwards."""
        before, _, after = run(on(ranks), "images", file, *more).partition("Expected: failures")
        assert "ERR|" not in before, ranks
        with np.load(file) as arrays:
            return dict(arrays), after

    one, _ = results(1, "one.npz")
    several, said = results(3, "several.npz", "failures")
    assert several.keys() == one.keys()
    for name, values in several.items():
        assert values.size > 0, name
        difference = float(np.abs(one[name] - values).max()) / max(float(np.abs(one[name]).max()), 1e-300)
        print(f"{name}: {difference:.1e}")
        # Slabs of few cells do not reach all that values of cells, and splines, depend on. Filters divide pieces into
        # other cells than all.
        limit = 1e-3 if "cell data" in name else 1e-2 if "image, in pieces" in name else 1e-6
        limit = 0.2 if name.startswith("requested tetrahedra") else limit
        assert difference <= limit, (name, difference)
    assert said.count("Rank 0 of 3 has no input") == 2 and said.count("Rank 2 of 3 has no input") == 2, said
    assert said.count("have not the same arrays") == 4 and said.count("ERR| vtkSchlierenFilter") == 4
    assert "Expected: the end" in said
    started = time_of_day()
    said = run(on(3), "killed", ends=False)
    assert time_of_day() - started < 20 and re.search(r"exited on\s+signal 9", said)
