# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Both filters, end to end, against the closed form of a Gaussian column."""

import numpy as np
from paraview.simple import AppendDatasets
from plugin_testing import (CONSTANT, RefractiveIndex, Schlieren, column_errors, gaussian_column,
                            one_ray_per_pixel, output, image_array)
from vtkmodules.util.numpy_support import vtk_to_numpy

source = gaussian_column(64)

# From the density, from the index, from the refractivity at points and at cells.
choices = ({"IndexModel": "Gladstone-Dale", "Density": ["POINTS", "rho"]},
           {"IndexModel": "Refractive Index", "IndexArray": ["POINTS", "n"]},
           {"IndexModel": "Refractivity", "IndexArray": ["POINTS", "N"]},
           {"IndexModel": "Refractivity", "IndexArray": ["CELLS", "cells"]})
images = []
for choice in choices:
    bench = Schlieren(source)
    for name, value in choice.items():
        setattr(bench, name, value)
    one_ray_per_pixel(bench)
    errors = column_errors(bench)
    print(choice, "relative errors: deflection %.2e, optical path %.2e" % errors)
    assert max(errors) < 4e-3
    images.append(image_array(bench, "Intensity"))
assert np.ptp(images[0]) > 0.5, "The automatic k should use the range of grey"
assert np.abs(images[1] - images[0]).max() < 1e-3

# In two steps the image is the same, value by value.
refractivity = RefractiveIndex(source)
refractivity.Density = ["POINTS", "rho"]
refractivity.UpdatePipeline()
image = output(refractivity)
n = vtk_to_numpy(image.GetPointData().GetArray("Refractivity"))
rho = vtk_to_numpy(output(source).GetPointData().GetArray("rho"))
assert n.dtype == rho.dtype and np.allclose(n, CONSTANT * rho, rtol=1e-6, atol=0)
chained = Schlieren(refractivity)
one_ray_per_pixel(chained)
direct = Schlieren(source)
direct.Density = ["POINTS", "rho"]
one_ray_per_pixel(direct)
for name in ("Intensity", "Deflection", "OpticalPathDifference", "Displacement", "BlockedFraction"):
    of_chain, of_one = image_array(chained, name), image_array(direct, name)
    assert np.abs(of_chain - of_one).max() <= 2e-5 * np.abs(of_one).max(), name

# The same cells, when the source is not an image.
points = AppendDatasets(source)
points.UpdatePipeline()
of_mesh = Schlieren(points)
of_mesh.Density = ["POINTS", "rho"]
one_ray_per_pixel(of_mesh)
errors = column_errors(of_mesh)
print("mesh: relative errors: deflection %.2e, optical path %.2e" % errors)
assert max(errors) < 8e-3
