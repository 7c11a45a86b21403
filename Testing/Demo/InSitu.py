# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The example that makes images of a simulation while it runs: the same on two ranks and on one, with the shock where it
must be. Skipped without mpiexec, pvbatch and mpi4py."""

import importlib.util
import os
import shutil
import subprocess
import sys

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader

EXAMPLE = os.path.join(os.environ["SCHLIEREN_SOURCE_DIR"], "Examples", "in_situ", "shock_and_bubble.py")
SIZE = ["--cells", "48", "--steps", "40", "--every", "20"]
STEPS = [0, 20, 40]

mpiexec, pvbatch = shutil.which("mpiexec"), shutil.which("pvbatch")
if not mpiexec or not pvbatch or not importlib.util.find_spec("mpi4py"):
    print("Skipped: there is no mpiexec (Debian: openmpi-bin), no pvbatch or no mpi4py (python3-mpi4py).")
    sys.exit(77)


def read(name):
    reader = vtkPNGReader()
    reader.SetFileName(name)
    reader.Update()
    columns, rows, _ = reader.GetOutput().GetDimensions()
    return vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars()).reshape(rows, columns).astype(int)


def images(folder, command):
    os.makedirs(folder, exist_ok=True)
    for name in os.listdir(folder):
        os.remove(os.path.join(folder, name))
    environment = {name: value for name, value in os.environ.items() if not name.startswith(("OMPI_", "PMIX_", "PRTE_"))}
    done = subprocess.run([*command, pvbatch, "--sym", "--force-offscreen-rendering", EXAMPLE, *SIZE], cwd=folder,
                          env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=150,
                          check=False)
    print(done.stdout)
    assert done.returncode == 0 and "Traceback" not in done.stdout and "ERR|" not in done.stdout
    assert sorted(os.listdir(folder)) == [f"schlieren_{step:04d}.png" for step in STEPS]
    # When each image was made, as the example says.
    times = [float(line.split(", ")[1].split()[0]) for line in done.stdout.splitlines() if line.startswith("step ")]
    return times, [read(os.path.join(folder, f"schlieren_{step:04d}.png")) for step in STEPS]


times, alone = images("one", [])
again, together = images("two", [mpiexec, "--allow-run-as-root", "--oversubscribe", "--mca", "mpi_yield_when_idle", "1",
                                "-np", "2"])
assert again == times and times[0] == 0 and len(times) == 3
for one, two in zip(alone, together):
    assert one.shape == (240, 480) and np.array_equal(one, two)
for one in alone:
    assert np.all(abs(one[:, 300:470] - 128) <= 2)  # the gas ahead is at rest
# The shock runs at 1.5 times the speed of sound, and is dark: light is bent back into the dense gas. Beside the bubble:
for time, image in zip(times, alone):
    darkest = np.argmin(image[20]) * 0.12 / 480
    at = 0.012 + 1.5 * np.sqrt(1.4 * 101325 / 1.2) * 1e-6 * time
    assert abs(darkest - at) < 0.12 / 48, (time, darkest, at)
# Hot gas has a smaller refractive index: light is bent out of the bubble, to both sides.
row = alone[0][120]
assert row[135] < 128 - 16 and row[185] > 128 + 16, (row[135], row[185])
