# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Images of a column that moves while light falls on the film, from time series of each kind that scripts meet."""

import math

import numpy as np
from paraview import simple
from plugin_testing import EVERY_VOXEL, Schlieren, output, image_array
from series_testing import write_series
from vtkmodules.util.numpy_support import vtk_to_numpy

STEPS = np.linspace(0, 2, 33).tolist()
CONSTANT, RADIUS = 2.26e-4, 0.3
EXPOSURE, SAMPLES = 0.5, 16
K = 500


def column(x, _, z, time):
    """It moves along x and is in the middle at the time 1."""
    return 1 + np.exp(-((x - time + 1)**2 + z**2) / RADIUS**2)


def truth(x, begin, end):
    """What a knife edge makes of it, integrated finely over time."""
    times = begin + (np.arange(1000) + 0.5) / 1000 * (end - begin)
    from_axis = (x[:, None] - times + 1) / RADIUS
    deflection = -2 * math.sqrt(math.pi) * CONSTANT * from_axis * np.exp(-from_axis**2)
    return (0.5 + K * deflection).mean(axis=1)


def error(bench, begin, end):
    image = output_of(bench)
    x = image.GetOrigin()[0] + np.arange(image.GetDimensions()[0]) * image.GetSpacing()[0]
    return np.abs(image_array(bench, "Intensity") - truth(x, begin, end)).max()


def output_of(bench):
    return bench.GetClientSideObject().GetOutputDataObject(0)


def numpy_of(reader):
    """The components of the pixels of a file, by rows from below."""
    image = reader.GetClientSideObject().GetOutputDataObject(0)
    return vtk_to_numpy(image.GetPointData().GetScalars()).reshape(image.GetDimensions()[1], image.GetDimensions()[0], -1)


def bench_of(source, **settings):
    return Schlieren(Input=source, Density=["POINTS", "rho"], ImageSize=[64, 8], ParallelScale=0.1, FocalPoint=[0, 0, 0],
                     **EVERY_VOXEL, **settings)


write_series("moving.pvd", STEPS, 48, column)
fixed = {"AutoKScale": 0, "KScale": K, "ExposureTime": EXPOSURE, "ExposureSamples": SAMPLES}

# A collection of files with times.
flow = simple.PVDReader(FileName="moving.pvd")
flow.UpdatePipeline()
bench = bench_of(flow, **fixed)
bench.UpdatePipeline(1)
assert error(bench, 0.75, 1.25) < 5e-3, error(bench, 0.75, 1.25)
interval = output_of(bench).GetFieldData().GetArray("ExposureInterval")
assert (interval.GetValue(0), interval.GetValue(1)) == (0.75, 1.25)
exposed = image_array(bench, "Intensity").copy()
bench.UpdatePipeline(2)
assert error(bench, 1.75, 2) < 5e-3, error(bench, 1.75, 2)
bench.ExposureTime = 0
bench.UpdatePipeline(1)
assert error(bench, 0.75, 1.25) > 0.05
assert not output_of(bench).GetFieldData().GetArray("ExposureInterval")

# The same files as a series, whose times are their numbers.
files = simple.XMLImageDataReader(FileName=[f"moving{step}.vti" for step in range(len(STEPS))])
files.UpdatePipeline()
series = bench_of(files, **{**fixed, "ExposureTime": EXPOSURE / (STEPS[1] - STEPS[0])})
series.UpdatePipeline(16)
assert np.abs(image_array(series, "Intensity") - exposed).max() < 1e-6

# A script that makes the data of a time.
made = simple.ProgrammableSource(OutputDataSetType="vtkImageData")
made.ScriptRequestInformation = f"""
executive = self.GetExecutive()
info = executive.GetOutputInformation(0)
steps = {STEPS}
info.Set(executive.TIME_STEPS(), steps, len(steps))
info.Set(executive.TIME_RANGE(), [steps[0], steps[-1]], 2)
info.Set(executive.WHOLE_EXTENT(), [0, 47, 0, 47, 0, 47], 6)
"""
made.Script = """
import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk
info = self.GetExecutive().GetOutputInformation(0)
time = info.Get(self.GetExecutive().UPDATE_TIME_STEP())
z, y, x = np.meshgrid(*3 * [np.linspace(-1, 1, 48)], indexing="ij")
values = numpy_to_vtk((1 + np.exp(-((x - time + 1)**2 + z**2) / 0.09)).ravel(), deep=True)
values.SetName("rho")
self.GetOutput().SetExtent(0, 47, 0, 47, 0, 47)
self.GetOutput().SetOrigin(-1, -1, -1)
self.GetOutput().SetSpacing(2 / 47, 2 / 47, 2 / 47)
self.GetOutput().GetPointData().AddArray(values)
self.GetOutput().GetInformation().Set(self.GetOutput().DATA_TIME_STEP(), time)
"""
made.UpdatePipeline(0)
scripted = bench_of(made, **fixed)
scripted.UpdatePipeline(1)
assert np.abs(image_array(scripted, "Intensity") - exposed).max() < 1e-6

# An animation: each of its frames is what the film has got around that time.
bench = bench_of(flow, **fixed)
view = simple.CreateRenderView(ViewSize=[256, 32], OrientationAxesVisibility=0, CameraParallelProjection=1)
shown = simple.Show(bench, view)
shown.SetRepresentationType("Slice")
simple.ColorBy(shown, ("POINTS", "Intensity"))
colors = simple.GetColorTransferFunction("Intensity")
colors.RGBPoints, colors.ColorSpace = [0, 0, 0, 0, 1, 1, 1, 1], "RGB"
shown.SetScalarBarVisibility(view, False)
view.CameraPosition, view.CameraFocalPoint, view.CameraParallelScale = [0, 0, 5], [0, 0, 0], 0.1
simple.GetAnimationScene().UpdateAnimationUsingDataTimeSteps()
frames = [12, 16, 20]
simple.SaveAnimation("exposed.png", view, FrameWindow=[frames[0], frames[-1]])
inside = slice(4, -4)  # the slice goes from the middle of the first pixel to that of the last
across = ((np.arange(256) - 127.5) / 32 * 0.2)[inside]
for frame in frames:
    grey = simple.PNGSeriesReader(FileNames=[f"exposed.{frame:04d}.png"])
    grey.UpdatePipeline()
    found = numpy_of(grey)[16, inside, 0] / 255
    time = STEPS[frame]
    assert np.abs(found - truth(across, time - EXPOSURE / 2, time + EXPOSURE / 2)).max() < 1.5e-2, frame
    assert np.abs(found - truth(across, time - 1e-3, time + 1e-3)).max() > 0.05, frame  # which is not that instant
