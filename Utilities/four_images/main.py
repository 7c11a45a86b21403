# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""One flow field, four images of the same view in one PNG: a volume rendering, what a schlieren
bench shows with a vertical and with a horizontal knife edge, and a shadowgraph.

Started by Utilities/demo, or by hand:

    Utilities/with-display pvpython Utilities/four_images/main.py --plugin .../Schlieren.so FILE --array rho
"""

import os
import sys
import tempfile
import time

from arguments import DemoError, options_or_exit, parse_arguments

OPTIONS = options_or_exit(parse_arguments)

# Only now: --help and mistakes in the arguments need no ParaView.
import numpy as np  # noqa: E402
import paraview.simple as pv  # noqa: E402
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy  # noqa: E402
from vtkmodules.vtkCommonDataModel import vtkImageData  # noqa: E402
from vtkmodules.vtkFiltersCore import vtkCellDataToPointData  # noqa: E402
from vtkmodules.vtkIOImage import vtkPNGReader  # noqa: E402

from bench import (bounds_of, check_light, load_plugin, new_bench, new_medium, open_flow,  # noqa: E402
                   output_of)
from frame import Frame  # noqa: E402
from messages import Messages, Progress, say  # noqa: E402
from sheet import FigureError, compose  # noqa: E402
from schlieren_figure import facts_of  # noqa: E402


def bench_images(reader, array, frame, options, messages):
    """Vertical knife edge, horizontal knife edge and shadowgraph, from one tracing of the rays."""
    schlieren = new_bench(reader, array, frame, options)
    progress = Progress(schlieren)
    images = []
    for name, cutoff, angle in (("vertical knife edge", "Knife Edge", 0),
                                ("horizontal knife edge", "Knife Edge", 90),
                                ("shadowgraph", "Shadowgraph", 0)):
        begin = time.monotonic()
        schlieren.Cutoff = cutoff
        schlieren.KnifeEdgeAngle = angle
        image = output_of(schlieren, name, messages)
        arrays = image.GetPointData()
        intensity = vtk_to_numpy(arrays.GetArray("Intensity"))
        images.append((intensity.reshape(frame.height, frame.width).copy(), facts_of(image)))
        say(f"{name.capitalize()}: {time.monotonic() - begin:.1f} s")
    check_light(vtk_to_numpy(arrays.GetArray("BlockedFraction")), frame)
    return images


def refractivity(medium, clear, frame, messages):
    """n - 1 on a regular grid, of data in a plane in it; what is not gas gets the value that will be clear."""
    if not output_of(medium, "computation of the refractive index", messages).IsA("vtkImageData"):
        bounds = np.array(medium.GetDataInformation().GetBounds())
        lengths = bounds[1::2] - bounds[0::2]
        most = min(256, max(frame.width, frame.height))  # more would not be seen
        medium = pv.ResampleToImage(Input=medium, SamplingDimensions=[
            max(32, round(most * length / lengths.max())) if length > 0 else 1 for length in lengths])
    fetched = output_of(medium, "computation of the refractive index", messages)
    image = vtkImageData()
    image.ShallowCopy(fetched)
    if not image.GetPointData().HasArray("Refractivity"):
        cells = vtkCellDataToPointData()
        cells.SetInputData(image)
        cells.Update()
        image.ShallowCopy(cells.GetOutput())
    values = vtk_to_numpy(image.GetPointData().GetArray("Refractivity")).astype(np.float32)
    mask = image.GetPointData().GetArray("vtkValidPointMask")
    solid = ~np.isfinite(values) | (vtk_to_numpy(mask) == 0 if mask else False)
    low, high = float(values[~solid].min()), float(values[~solid].max())
    values[solid] = clear
    clean = numpy_to_vtk(values, deep=True)
    clean.SetName("Refractivity")
    image.GetPointData().Initialize()
    image.GetPointData().SetScalars(clean)
    return image, low, clear, high


def volume_rendering(medium, frame):
    """Blue where the index is below that of the surroundings, orange to red where it is above."""
    image, low, clear, high = medium
    producer = pv.TrivialProducer()
    producer.GetClientSideObject().SetOutput(image)
    producer.UpdatePipeline()

    view = pv.CreateView("RenderView")
    view.ViewSize = [frame.width, frame.height]
    view.OrientationAxesVisibility = 0
    view.UseColorPaletteForBackground = 0
    view.Background = [0.05, 0.06, 0.08]
    view.CameraParallelProjection = 1
    view.CameraFocalPoint = list(frame.center)
    view.CameraPosition = list(frame.center - 4 * (frame.depth + frame.scale) * frame.direction)
    view.CameraViewUp = list(frame.up)
    view.CameraParallelScale = frame.scale

    representation = pv.Show(producer, view)
    representation.SetRepresentationType("Volume" if min(image.GetDimensions()) > 1 else "Slice")
    pv.ColorBy(representation, ("POINTS", "Refractivity"))
    representation.SetScalarBarVisibility(view, False)
    color = pv.GetColorTransferFunction("Refractivity")
    opacity = pv.GetOpacityTransferFunction("Refractivity")
    # Away from the clear value, as a fraction of the distance to the extreme: colour and opacity.
    below = ((1.0, (0.15, 0.40, 1.0), 0.90), (0.6, (0.40, 0.70, 1.0), 0.45),
             (0.15, (0.75, 0.90, 1.0), 0.06), (0.03, (0.9, 0.9, 0.9), 0))
    above = ((0.03, (0.9, 0.9, 0.9), 0), (0.12, (1.0, 0.85, 0.55), 0.08),
             (0.4, (1.0, 0.60, 0.20), 0.30), (1.0, (1.0, 0.12, 0.08), 0.80))
    reach = max(high - clear, clear - low, 1e-30)

    def side(extreme, steps):
        span = abs(extreme - clear)
        # A side that hardly departs from the clear value is noise: keep it transparent.
        visible = span > 0.02 * reach
        span = span if visible else reach
        sign = -1 if steps is below else 1
        return [(clear + sign * fraction * span, rgb, alpha if visible else 0)
                for fraction, rgb, alpha in steps]

    points = side(low, below) + side(high, above)
    color.ColorSpace = "RGB"
    color.RGBPoints = [number for value, rgb, _ in points for number in (value, *rgb)]
    opacity.Points = [number for value, _, alpha in points for number in (value, alpha, 0.5, 0.0)]
    representation.ScalarOpacityUnitDistance = frame.depth / 8

    with tempfile.NamedTemporaryFile(suffix=".png") as shot:
        pv.SaveScreenshot(shot.name, view, ImageResolution=[frame.width, frame.height])
        reader = vtkPNGReader()
        reader.SetFileName(shot.name)
        reader.Update()
        pixels = vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars())
        pixels = pixels.reshape(frame.height, frame.width, -1)[..., :3].copy()
    pv.Delete(view)
    pv.Delete(producer)
    return pixels


def main(options):
    messages = Messages()
    load_plugin(options, messages)
    with tempfile.TemporaryDirectory() as scratch:
        reader, array, used = open_flow(options, scratch, messages)
        medium = new_medium(reader, array, options)
        frame = Frame(bounds_of(reader, medium, options), options)
        say(f"Tracing rays, {frame.width} x {frame.height} pixels")
        images = bench_images(reader, array, frame, options, messages)
        begin = time.monotonic()
        clear = images[0][1]["AmbientRefractivity"][0]
        grid = refractivity(medium, clear, frame, messages)
        volume = volume_rendering(grid, frame)
        say(f"Volume rendering: {time.monotonic() - begin:.1f} s")
        compose(volume, grid, images, frame, used, options).write(options.output)
    say(f"The image: {os.path.abspath(options.output)}")


if __name__ == "__main__":
    try:
        main(OPTIONS)
    except (DemoError, FigureError) as problem:
        print(f"error: {' '.join(str(problem).split())}", file=sys.stderr)
        sys.exit(1)
