# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Two processes give what one process gives, bit for bit. Skipped without mpiexec and pvbatch.

With an argument, the part of the work that one or two processes do: their results go to that file.
"""

import os
import re
import shutil
import subprocess
import sys

import numpy as np

RESULTS = sys.argv[1:]


def results():
    """Arrays that the first process has, by their names."""
    # Only the one who does the work: MPI does not let a process that uses it start others that do.
    # pylint: disable=import-outside-toplevel
    from paraview.servermanager import Fetch
    from paraview.simple import AppendDatasets, Sphere, Tetrahedralize, Wavelet
    from plugin_testing import RefractiveIndex, Schlieren, picture
    from vtkmodules.util.numpy_support import vtk_to_numpy

    wavelet = Wavelet(WholeExtent=3 * [-8, 8])
    ball = Sphere(Radius=3)
    found = {}
    for name, source in (("image", wavelet), ("mesh", AppendDatasets(Input=[wavelet])),
                         ("tetrahedra", Tetrahedralize(Input=wavelet))):
        for bodies in (None, ball):
            medium = RefractiveIndex(Input=source, Bodies=bodies, Density=["POINTS", "RTData"],
                                     GladstoneDaleConstant=1e-6, SamplingDimensions=[20, 21, 22])
            medium.UpdatePipeline()
            seen = Schlieren(Input=source, Bodies=bodies, Density=["POINTS", "RTData"],
                             GladstoneDaleConstant=1e-6, SamplingDimensions=[20, 21, 22],
                             ImageSize=[32, 32])
            again = Schlieren(Input=medium, Density=["POINTS", "Refractivity"], ImageSize=[32, 32])
            label = name + (" with a ball" if bodies else "")
            for kind, bench in (("direct", seen), ("in two steps", again)):
                for array in ("Intensity", "OpticalPathDifference", "BlockedFraction"):
                    found[f"{label}: {array}, {kind}"] = picture(bench, array)
                # The others have none, so that nothing is counted or drawn twice.
                assert bench.GetDataInformation().GetNumberOfPoints() == 32 * 32, label
            grid = Fetch(medium)
            assert medium.GetDataInformation().GetNumberOfPoints() == grid.GetNumberOfPoints(), label
            for array in ("Refractivity", "vtkValidPointMask"):
                found[f"{label}: {array}"] = vtk_to_numpy(grid.GetPointData().GetArray(array))
    return found


def run(command, file):
    # What tells MPI that a process belongs to others.
    environment = {name: value for name, value in os.environ.items()
                   if not name.startswith(("OMPI_", "PMIX_", "PRTE_"))}
    done = subprocess.run(command + ["--force-offscreen-rendering", __file__, file], env=environment,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=100,
                          check=False)
    print(done.stdout)
    assert done.returncode == 0 and not re.search(r"ERR\||Traceback", done.stdout), command
    with np.load(file) as arrays:
        return done.stdout, dict(arrays)


if RESULTS:
    np.savez(RESULTS[0], **results())
else:
    mpiexec, pvbatch = shutil.which("mpiexec"), shutil.which("pvbatch")
    if not mpiexec or not pvbatch:
        print("Skipped: there is no mpiexec (Debian: openmpi-bin) or no pvbatch.")
        sys.exit(77)
    words, one = run([pvbatch], "one.npz")
    assert "several processes" not in words
    words, two = run([mpiexec, "--allow-run-as-root", "--oversubscribe", "-np", "2", pvbatch], "two.npz")
    assert "several processes makes the picture" in words
    assert "several processes makes the refractivity" in words
    assert one.keys() == two.keys() and len(one) == 48, len(one)
    for name in one:
        assert one[name].size > 0, name
        assert np.array_equal(one[name], two[name]), name
    assert np.ptp(one["mesh: Intensity, direct"]) > 0.5
    assert one["mesh with a ball: BlockedFraction, direct"].max() == 1
