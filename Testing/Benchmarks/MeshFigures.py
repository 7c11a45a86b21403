# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Seconds on the clock of first and later images of two meshes with default settings, and how right they are.

    SCHLIEREN_PLUGIN=…/Schlieren.so Utilities/with-display pvpython Testing/Benchmarks/MeshFigures.py

A far field of 1.2 million points around a sphere, seen 6 wide, and 1.08 million tetrahedra, 512 x 512 pixels.
Times are medians of five (first images: each of a new filter). Use an idle machine.
"""

import math
import statistics
import time

import ErrorTolerance as cases
import numpy as np
from paraview import servermanager, simple
from vtkmodules.util.numpy_support import vtk_to_numpy

PIXELS = 512
TURNS = 5
FAR = {"ImageSize": [PIXELS, PIXELS], "Density": ["POINTS", "rho"], "FocalPoint": [0, 0, 0], "ParallelScale": 3}


def seconds_of(update):
    start = time.perf_counter()
    update()
    return time.perf_counter() - start


def first_images(source, **settings):
    """The last of the filters, and how long each took."""
    seconds, bench = [], None
    for _ in range(TURNS):
        if bench is not None:
            simple.Delete(bench)
        bench = cases.Schlieren(source, **settings)
        seconds.append(seconds_of(bench.UpdatePipeline))
    return bench, seconds


def later_images(change, bench):
    seconds = []
    for turn in range(TURNS + 1):
        change(turn)
        seconds.append(seconds_of(bench.UpdatePipeline))
    return seconds[1:]


def line(name, seconds):
    print(f"{name:52} {statistics.median(seconds):6.2f} s  ({min(seconds):.2f} to {max(seconds):.2f})", flush=True)


def with_density(data, refractivity):
    """The field as a density that has it with the filter's default constant."""
    for name in ("N", "rho"):
        data.GetPointData().RemoveArray(name)
    values = 1.2 + refractivity(vtk_to_numpy(data.GetPoints().GetData()).astype(float)) / cases.K
    cases.set_array(data.GetPointData(), values)
    data.GetPointData().GetArray("N").SetName("rho")
    return data


def far_field():
    source = cases.producer(with_density(cases.sphere_grid(cases.flow_around_sphere), cases.flow_around_sphere))
    bench, seconds = first_images(source, **FAR)
    line("far field, first image", seconds)
    made = servermanager.Fetch(bench)
    facts = made.GetFieldData()
    print(f"  medium {facts.GetArray('MediumBytes').GetValue(0) * 1e-6:.0f} MB, "
          f"ambient {facts.GetArray('AmbientRefractivity').GetValue(0) / cases.K:.6f}", flush=True)

    def array(name):
        return vtk_to_numpy(made.GetPointData().GetArray(name)).reshape(PIXELS, PIXELS, -1).squeeze()

    blocked = array("BlockedFraction")
    pixel = made.GetSpacing()[0]
    # Of the sphere that the mesh has: of quadrilaterals along parallels, 105 by 106.
    outline = math.pi * np.sinc(1 / 106) * np.sinc(1 / 105)
    print(f"  silhouette's area / the mesh's {blocked.sum() * pixel**2 / outline:.5f}")
    cases.PIXELS = PIXELS // 4
    bend, _ = cases.truth(FAR, cases.flow_around_sphere, 12)
    # The truth at the middles of 4 x 4 pixels: between them.
    deflection = array("Deflection").reshape(PIXELS // 4, 4, PIXELS // 4, 4, 3)[:, 1:3, :, 1:3, :2].mean(axis=(1, 3))
    counts = cases.away_from(blocked.reshape(PIXELS // 4, 4, PIXELS // 4, 4).max(axis=(1, 3)) > 0, 1)
    rms, worst = cases.errors(deflection, bend, counts)
    print(f"  deflection: rms error {rms:.2e}, worst {worst:.2e} of the largest", flush=True)

    def turn(number):
        angle = 0.02 * number
        bench.ViewDirection = [math.sin(angle), 0, -math.cos(angle)]

    line("far field, next camera (a degree further)", later_images(turn, bench))


def tetrahedra():
    data, places = cases.jittered(60, 0.2)
    cases.with_points(data, places, cases.ball(0, 0.35))
    source = cases.producer(with_density(data, cases.ball(0, 0.35)))
    bench, seconds = first_images(source, ImageSize=[PIXELS, PIXELS], Density=["POINTS", "rho"])
    line(f"{data.GetNumberOfCells()} tetrahedra, first image", seconds)

    def step(number):
        moved = data.NewInstance()
        moved.ShallowCopy(data)
        with_density(moved, cases.ball(np.array([0.02 * number, 0, 0]), 0.35))
        client = source.GetClientSideObject()
        client.SetOutput(moved)
        client.Modified()
        source.MarkModified(source)

    line("  its next time step", later_images(step, bench))


if __name__ == "__main__":
    far_field()
    tetrahedra()
