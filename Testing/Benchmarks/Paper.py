# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The tables of Brownlee, Pegoraro, Shankar, McCormick and Hansen, "Physically-based interactive flow visualization based on
schlieren and interferometry experimental techniques", IEEE Trans. Vis. Comput. Graph. 17 (2011), on this machine.

    SCHLIEREN_PLUGIN=…/Schlieren.so Utilities/with-display pvpython Testing/Benchmarks/Paper.py

The Ladenburg jet, sampled on grids of the paper's sizes, as none of its data are public; 512 x 512 pixels. Prints rates by
cutoff (figures 11 and 12), memory and preparation (table 1), and how images of 256 x 256 pixels converge (figure 15). Takes
some minutes; the machine should be idle.
"""

import os
import statistics
import time

import ErrorTolerance as cases
import numpy as np
from paraview import simple
from Tradeoff import jet
from vtkmodules.util.numpy_support import vtk_to_numpy

PIXELS = 512
ALONG_Z = {"ImageSize": [PIXELS, PIXELS], "LengthScale": 0.001}
ASLANT = {"ImageSize": [PIXELS // 2, PIXELS // 2], "LengthScale": 0.001, "ViewDirection": [0.3, -0.4, -1]}
CUTOFFS = ("Shadowgraph", "Knife Edge", "Circular Complement")
VIEWS = 7


def sampled(dimensions):
    source, _ = jet([0, 0, -1])
    image = simple.ResampleToImage(Input=source, SamplingDimensions=list(dimensions))
    image.UpdatePipeline()
    return image


def value(bench, name):
    return bench.GetClientSideObject().GetOutputDataObject(0).GetFieldData().GetArray(name).GetValue(0)


def megabytes_in_use():
    with open("/proc/self/statm") as file:
        return 1e-6 * os.sysconf("SC_PAGE_SIZE") * int(file.read().split()[1])


def seconds_of(update):
    start = time.perf_counter()
    update()
    return time.perf_counter() - start


def views(bench):
    """Seconds of images of other cameras."""
    for view in range(VIEWS):
        bench.ViewDirection = [0.02 * view, 0.01 * view, -1]
        yield seconds_of(bench.UpdatePipeline)


def rates(name, dimensions, rays):
    source = sampled(dimensions)
    for cutoff in CUTOFFS:
        bench = cases.Schlieren(source, Cutoff=cutoff, **ALONG_Z)
        bench.SamplesPerPixel = rays
        before = megabytes_in_use()
        first = seconds_of(bench.UpdatePipeline)
        memory = megabytes_in_use() - before
        seconds = statistics.median(views(bench))
        traced = value(bench, "RaysTraced")
        print(f"| {name}, {rays} rays per pixel | {cutoff} | {1 / seconds:.2f} | {traced / seconds:.3g} | "
              f"{traced / value(bench, 'TraceSeconds'):.3g} |", flush=True)
        if cutoff == CUTOFFS[0]:
            preparation = f"| {name} | {4e-6 * np.prod(dimensions):.0f} | {memory:.0f} | {max(0, first - seconds):.2f} |"
        simple.Delete(bench)
    simple.Delete(source)
    return preparation


def intensity(source, **settings):
    bench = cases.Schlieren(source, **{**ASLANT, **settings})
    bench.UpdatePipeline()
    image = bench.GetClientSideObject().GetOutputDataObject(0)
    light = vtk_to_numpy(image.GetPointData().GetArray("Intensity")).astype(float)
    k = value(bench, "KScale")
    simple.Delete(bench)
    return light, k


def convergence(source, rays, **settings):
    """Root mean square differences of successive numbers of rays per pixel, by full scale."""
    images = [intensity(source, SamplesPerPixel=n, **settings)[0] for n in rays]
    return [np.sqrt(np.mean((a - b)**2)) for a, b in zip(images, images[1:])]


def main():
    print("| data | cutoff | images/s | rays/s | of tracing alone |\n|---|---|---|---|---|")
    preparations = [rates("480 x 720 x 100", (480, 720, 100), 10), rates("256 x 256 x 256", (256, 256, 256), 5),
                    rates("293 x 293 x 293", (293, 293, 293), 1), rates("227 x 302 x 302", (227, 302, 302), 1)]
    print("\n| data | their size, MB | memory beside them, MB | preparation, s |\n|---|---|---|---|", *preparations, sep="\n")
    source, _ = jet([0, 0, -1])
    source.UpdatePipeline()
    _, k = intensity(source)
    rays = (1, 10, 100, 1000)
    print("\n| film | " + " | ".join(f"{a} and {b}" for a, b in zip(rays, rays[1:])) + " |\n|---|---|---|---|")
    for film in ("Photon", "Sheet"):
        for noise in ("None", "Cone"):
            steps = convergence(source, rays, FilmEstimator=film, NoiseFilter=noise, AutoKScale=0, KScale=k)
            print(f"| {film}, filter {noise} | " + " | ".join(f"{100 * step:.3f} %" for step in steps) + " |", flush=True)
    straight = intensity(source, PathModel="Straight", AutoKScale=0, KScale=k)[0]
    bent = intensity(source, PathModel="Refracted", AutoKScale=0, KScale=k)[0]
    print(f"\nStraight against bent rays, rms: {100 * np.sqrt(np.mean((straight - bent)**2)):.3f} % of full scale")


if __name__ == "__main__":
    main()
