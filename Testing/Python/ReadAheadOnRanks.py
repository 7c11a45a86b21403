# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The next time step is read while several ranks trace the image of this one: images are those of one process that reads
each step when it is requested, and all ranks read together. Skipped without mpiexec and pvbatch.

With arguments, a part of the work that one or more ranks do: "images", whether they read ahead, and the file for their
results; or some of PARTS.
"""

import itertools
import sys
from time import monotonic as time_of_day

import numpy as np
from ranks_testing import is_rank0, moving_ball, on, on_several, run, skip_without_mpi

TIMES = [0, 0.25, 0.5, 0.75, 1]
IN_ANY_ORDER = [0, 0.25, 0.5, 0.75, 0.5, 1, 1, 0.1, 0.25, 0]
BENCH = {"ImageSize": [24, 24], "ViewDirection": [0.2, -0.6, -0.8], "MediumTolerance": 1e-3}
NOTE = """
import builtins
vars(builtins).setdefault("read", []).append(time)
"""
# Ranks wait for each other while they read, and must read the same steps.
TOGETHER = NOTE + """
from vtkmodules.vtkCommonCore import vtkDoubleArray
from vtkmodules.vtkParallelCore import vtkMultiProcessController as Controller
mine, least = vtkDoubleArray(), vtkDoubleArray()
mine.InsertNextValue(time)
Controller.GetGlobalController().AllReduce(mine, least, 1)
if least.GetValue(0) != time:
    raise RuntimeError("ranks read different steps")
"""
# What is requested: all on rank 0 where there are few cells.
REQUESTED = """
rank = info.Get(self.GetExecutive().UPDATE_PIECE_NUMBER())
number = info.Get(self.GetExecutive().UPDATE_NUMBER_OF_PIECES())
"""
SPREAD_BY_RANK = "rank, number = ranks.GetLocalProcessId(), ranks.GetNumberOfProcesses()\n"


def read():
    """The steps that rank 0 has read since the last call."""
    import builtins
    done = vars(builtins).get("read", [])
    builtins.read = []
    return done


def source_of(kind, before=TOGETHER):
    output = {"image": "vtkImageData", "amr": "vtkMultiblockDataSet"}.get(kind, "vtkUnstructuredGrid")
    # Rank 0 runs such an image, which has less than is requested, once more by itself.
    before = NOTE if kind == "image" else before
    source = moving_ball("tetrahedra" if kind == "requested" else kind, output, TIMES, before=before)
    if kind == "requested":
        source.Script = source.Script.replace(SPREAD_BY_RANK, REQUESTED)
    return source


# What is read for IN_ANY_ORDER: each step ahead of its time, but where the direction changes.
AHEAD = [0, 0.25, 0.5, 0.75, 1, 0.5, 0.25, 1, 0.1, 0.25, 0.5, 0]


def images(isAhead):
    from paraview.simple import Sphere
    from plugin_testing import Schlieren, image_array
    import schlieren.vtkSchlierenFilters  # noqa: F401, for GetMediumBuilds
    found = {}
    body = Sphere(Radius=0.2, Center=[0.5, 0.2, 0])
    for name, kind, settings in (
            ("requested", "requested", {"Bodies": body}),
            ("gathered", "tetrahedra", {}),
            ("gathered with bodies", "tetrahedra", {"Bodies": body}),
            ("image", "image", {}),
            ("image that stays", "image", {"Bodies": body, "GatherLimit": 0}),
            ("tetrahedra that stay", "tetrahedra", {"GatherLimit": 0}),
            ("amr that stays", "amr", {"GatherLimit": 0}),
            ("distributed", "tetrahedra", {"DistributedMedium": "On", "Device": "CPU"})):
        seen = Schlieren(Input=source_of(kind), Density=["CELLS" if kind == "amr" else "POINTS", "rho"],
                         ReadAheadMemory=100 if isAhead else 0, **BENCH, **settings)
        read()
        builds = []
        for n, time in enumerate(IN_ANY_ORDER):
            if n == 6:
                seen.KnifeEdgeAngle = 90
            seen.UpdatePipeline(time)
            for array in ("Intensity", "Deflection"):
                found[f"{name}: {n}, {array}"] = image_array(seen, array)
            builds.append(seen.GetClientSideObject().GetMediumBuilds())
        steps = read()
        if isAhead:
            if kind == "image":
                steps = [step for step, _ in itertools.groupby(steps)]
            # Of these ranks first request pieces, which are too few.
            twice = on_several() and kind != "image" and "GatherLimit" not in settings
            assert steps == [0] * twice + AHEAD, (name, steps)
            # What was made of steps that were read ahead is used; of the second the ambient refractivity was not known yet.
            isMadeAhead = name == "requested" or on_several() and ("stay" in name or "gathered" in name or name == "image")
            assert not isMadeAhead or builds[:4] == [1, 2, 2, 2], (name, builds)
        seen.UpdatePropertyInformation()
        assert not on_several() or ("on their ranks" in seen.GetProperty("Grid").GetData()) == ("GatherLimit" in settings), name
    for name, kind, settings in (("exposed", "requested", {}), ("exposed image that stays", "image", {"Bodies": body, "GatherLimit": 0}),
                                 ("exposed tetrahedra that stay", "tetrahedra", {"GatherLimit": 0})):
        seen = Schlieren(Input=source_of(kind), Density=["POINTS", "rho"], ReadAheadMemory=100 if isAhead else 0,
                         ExposureTime=2.4, ExposureSamples=4, **BENCH, **settings)
        read()
        for time in (0.5, 0.75):
            seen.UpdatePipeline(time)
            found[f"{name}: {time}, Deflection"] = image_array(seen, "Deflection")
        steps = [step for step, _ in itertools.groupby(read())]
        assert steps[-10:] == TIMES * 2, (name, steps)
    return found


def expect_same(one, several):
    assert one.keys() == several.keys() and len(one) == 8 * 2 * len(IN_ANY_ORDER) + 6
    for name, values in several.items():
        assert values.size > 0 and np.ptp(values) > 0, name
        difference = np.abs(one[name] - values) / np.abs(one[name]).max()
        # As without reading ahead, see SeveralProcesses.py.
        most, mean = (1e-2, 2e-5) if name.startswith("distributed") else (1e-6, 1e-6) if "stay" in name else (0, 0)
        assert difference.max() <= most and difference.mean() <= mean, (name, difference.max(), difference.mean())


def say(words):
    print(words, file=sys.stderr, flush=True)  # where error messages go


def warned():
    """MPI for one thread: nothing is read ahead, which is said once."""
    from plugin_testing import Schlieren, image_array
    seen = Schlieren(Input=source_of("tetrahedra"), Density=["POINTS", "rho"], ReadAheadMemory=100, **BENCH)
    for time in TIMES[:3]:
        seen.UpdatePipeline(time)
        assert np.ptp(image_array(seen, "Intensity")) > 0
    assert read() == [0, *TIMES[:3]]


def aborted():
    """An image that is aborted while all read."""
    from plugin_testing import Schlieren, image_array
    settings = {"Density": ["POINTS", "rho"], "LockAmbient": 0, **BENCH}
    seen = Schlieren(Input=source_of("tetrahedra"), ReadAheadMemory=100, **settings)
    plain = Schlieren(Input=source_of("tetrahedra"), **settings)
    seen.UpdatePipeline(0)
    image = seen.GetClientSideObject()
    # While rays are traced: the medium takes the first fifth.
    tag = image.AddObserver("ProgressEvent", lambda *_: image.SetAbortExecute(int(image.GetProgress() > 0.2)))
    seen.ImageSize = [300, 300]
    seen.SamplesPerPixel = 10000
    seen.UpdatePipeline(0.25)
    assert seen.GetDataInformation().GetNumberOfPoints() == 0
    image.RemoveObserver(tag)
    seen.ImageSize = BENCH["ImageSize"]
    seen.SamplesPerPixel = plain.SamplesPerPixel
    read()
    for time in TIMES[1:]:
        seen.UpdatePipeline(time)
        ahead = read()
        assert time not in ahead, (time, ahead)  # it is there
        plain.UpdatePipeline(time)
        assert np.array_equal(image_array(seen, "Deflection"), image_array(plain, "Deflection")), time
        read()


def missing(rank):
    """A file of the next step that a rank cannot read."""
    import os
    import shutil
    from paraview.simple import ProgrammableSource, XMLImageDataReader
    from plugin_testing import Schlieren, image_array
    from series_testing import write_series
    folder = os.path.abspath(f"all{rank}")
    shutil.rmtree(folder, ignore_errors=True)
    os.makedirs(folder)
    write_series(folder + "/step.pvd", [0, 1, 2, 3], 8, lambda x, y, z, time: 1 + np.exp(-(x - time / 4)**2 - y**2 - z**2))
    shutil.copytree(folder, folder + "/some")
    os.remove(folder + "/some/step2.vti")
    ProgrammableSource(Script=f"""
import os
from vtkmodules.vtkParallelCore import vtkMultiProcessController
isThis = vtkMultiProcessController.GetGlobalController().GetLocalProcessId() == {rank}
os.chdir({folder!r} + ("/some" if isThis else ""))
""").UpdatePipeline()
    seen = Schlieren(Input=XMLImageDataReader(FileName=[f"step{n}.vti" for n in range(4)]), Density=["POINTS", "rho"],
                     ReadAheadMemory=100, LockAmbient=0, **BENCH)
    say("Expected: errors")
    for time in (0, 1, 2, 3, 0):
        start = time_of_day()
        seen.UpdatePipeline(time)
        assert time_of_day() - start < 10, time
        if time != 2 or rank > 0:  # rank 0 needs no file of others; without its own the filter does not run
            plain = Schlieren(Input=XMLImageDataReader(FileName=f"step{time}.vti"), Density=["POINTS", "rho"], LockAmbient=0, **BENCH)
            assert np.array_equal(image_array(seen, "Deflection"), image_array(plain, "Deflection")), time


def killed():
    """A rank that ends while all read."""
    from plugin_testing import Schlieren
    kill = """
if time == 0.5 and Controller.GetGlobalController().GetLocalProcessId() == 2:
    import os
    os.kill(os.getpid(), 9)
"""
    seen = Schlieren(Input=source_of("tetrahedra", TOGETHER + kill), Density=["POINTS", "rho"], ReadAheadMemory=100, **BENCH)
    for time in TIMES[:2]:
        seen.UpdatePipeline(time)
    say("Not expected: the end")


PARTS = {"warned": warned, "aborted": aborted, "killed": killed, "missing on 0": lambda: missing(0),
         "missing on 2": lambda: missing(2)}
if sys.argv[1:2] == ["images"]:
    np.savez(sys.argv[3], **images(sys.argv[2] == "ahead"))
elif sys.argv[1:]:
    for part in sys.argv[1:]:
        PARTS[part]()
    say("Expected: the end")
else:
    skip_without_mpi()
    THREADS = {"OMPI_MPI_THREAD_LEVEL": "3", "MPIR_CVAR_DEFAULT_THREAD_LEVEL": "MPI_THREAD_MULTIPLE"}

    def images_on(ranks, ahead):
        file = f"{ahead}.npz"
        assert "ERR|" not in run(on(ranks), "images", ahead, file, **THREADS)
        with np.load(file) as arrays:
            return dict(arrays)

    expect_same(images_on(1, "plain"), images_on(3, "ahead"))
    said = run(on(2), "warned")
    assert said.count("ReadAheadMemory has no effect") == 1 and "Expected: the end" in said
    said = run(on(3), "aborted", "missing on 0", "missing on 2", **THREADS)
    assert "ERR|" not in said[:said.index("Expected: errors")]
    assert "Error opening file" in said and "Expected: the end" in said
    begun = time_of_day()
    said = run(on(4), "killed", ends=False, **THREADS)
    assert "Not expected" not in said and time_of_day() - begun < 20
