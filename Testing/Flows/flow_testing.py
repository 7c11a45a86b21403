# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""What the tests on real flows share: the files, images against baselines, and sums along rays that
VTK's probe takes through the data as they were read."""

import os
import sys

import numpy as np
from paraview import servermanager
from paraview.simple import MergeBlocks
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellLocatorStrategy, vtkImageData, vtkPolyData
from vtkmodules.vtkFiltersCore import vtkProbeFilter
from vtkmodules.vtkIOImage import vtkPNGReader, vtkPNGWriter

SOURCE = os.environ["SCHLIEREN_SOURCE_DIR"]
DATA = os.path.join(SOURCE, "Testing", "Data")
sys.path.insert(0, os.path.join(SOURCE, "Testing", "Python"))

from plugin_testing import (EVERY_VOXEL, RefractiveIndex, Schlieren, output,  # noqa: E402, F401
                            image_array)


def coordinates(bench):
    """The pixels' centres along the image's right and along its up, data units."""
    image = output(bench)
    return [image.GetOrigin()[i] + image.GetSpacing()[i] * np.arange(image.GetDimensions()[i])
            for i in (0, 1)]


def levels(bench, white, array):
    """An array as the levels 0 to 255 of an image: its own bytes, or grey, in which `white` is 255."""
    values = image_array(bench, array)
    if values.dtype == np.uint8:
        return values
    return np.clip(np.rint(values * (255 / white)), 0, 255).astype(np.uint8)


def write_image(name, pixels):
    """A PNG of rows x columns (x 3) bytes, lowest row first; its full name."""
    image = vtkImageData()
    image.SetDimensions(pixels.shape[1], pixels.shape[0], 1)
    image.GetPointData().SetScalars(
        numpy_to_vtk(pixels.reshape(pixels.shape[0] * pixels.shape[1], -1), deep=True))
    writer = vtkPNGWriter()
    writer.SetFileName(os.path.abspath(name))
    writer.SetInputData(image)
    writer.Write()
    return writer.GetFileName()


def check_baseline(bench, name, white=1, array="Intensity"):
    """Compares the image with Testing/Baseline/<name>.png, level by level, and leaves its own."""
    made = levels(bench, white, array)
    file = write_image(name + ".png", made)
    path = os.path.join(SOURCE, "Testing", "Baseline", name + ".png")
    assert os.path.exists(path), f"There is no baseline {path} for {file}"
    reader = vtkPNGReader()
    reader.SetFileName(path)
    reader.Update()
    columns, rows, _ = reader.GetOutput().GetDimensions()
    assert (rows, columns) == made.shape[:2], (rows, columns, made.shape)
    kept = vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars()).reshape(made.shape)
    difference = np.abs(kept.astype(int) - made)
    print(f"{name}: differs from its baseline by {difference.mean():.4f} levels on average, "
          f"{difference.max()} at most")
    # Another compiler may round a level up where this one rounds it down.
    assert difference.mean() < 0.05 and difference.max() <= 8, file


def one_dataset(proxy):
    """What a source or filter gives, its blocks as one dataset of this process."""
    blocks = MergeBlocks(proxy, MergePoints=0)
    blocks.UpdatePipeline()
    return servermanager.Fetch(blocks)


def sums_along(data, array, starts, ends, samples=1000):
    """(integral of a point array, length inside the data) of each of the straight ways from starts to
    ends (rays x 3). vtkProbeFilter at the middles of `samples` pieces: nothing of ours is in it.
    """
    starts, ends = np.array(starts, float), np.array(ends, float)
    fraction = (np.arange(samples) + 0.5) / samples
    places = starts[:, None] + fraction[:, None] * (ends - starts)[:, None]
    points = vtkPoints()
    points.SetDataTypeToDouble()
    points.SetData(numpy_to_vtk(places.reshape(-1, 3), deep=True))
    lines = vtkPolyData()
    lines.SetPoints(points)
    probe = vtkProbeFilter()
    probe.SetInputData(lines)
    probe.SetSourceData(data)
    probe.SetFindCellStrategy(vtkCellLocatorStrategy())  # others miss points of large cells
    probe.ComputeToleranceOff()  # what it computes from points without cells finds nothing
    probe.SetTolerance(1e-7 * data.GetLength())
    probe.Update()
    found = probe.GetOutput().GetPointData()
    inside = vtk_to_numpy(found.GetArray("vtkValidPointMask")).reshape(-1, samples) != 0
    values = vtk_to_numpy(found.GetArray(array)).reshape(-1, samples).astype(float)
    step = np.linalg.norm(ends - starts, axis=1) / samples
    return np.where(inside, values, 0).sum(axis=1) * step, inside.sum(axis=1) * step
