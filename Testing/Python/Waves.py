# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Laser light: what the filter's output and the view's line say of waves."""

import math

import numpy as np
from paraview.simple import Sphere, TrivialProducer
from plugin_testing import Schlieren, gaussian_column, image_array, is_empty, output
from schlieren.vtkSchlierenFilters import vtkSchlierenFilter  # noqa: F401, members of client-side objects
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonDataModel import vtkImageData

WAVELENGTH, RADIUS, HALF = 532e-9, 1e-3, 4e-3


def status_of(bench):
    """The view's line."""
    bench.UpdatePropertyInformation()
    return bench.GetProperty("Status").GetData()


air = vtkImageData()
air.SetDimensions(21, 21, 9)
air.SetOrigin(-5e-3, -5e-3, -2e-3)
air.SetSpacing(3 * [5e-4])
density = numpy_to_vtk(np.full(21 * 21 * 9, 1.2), deep=True)
density.SetName("rho")
air.GetPointData().AddArray(density)
source = TrivialProducer()
source.GetClientSideObject().SetOutput(air)
source.UpdatePipeline()

shadow = Schlieren(Input=source, Bodies=Sphere(Radius=RADIUS, ThetaResolution=256, PhiResolution=128),
                   Density=["POINTS", "rho"], Cutoff="Shadowgraph", LightModel="Waves", Wavelength=1e9 * WAVELENGTH,
                   ParallelScale=HALF, ImageSize=[128, 128], Quality="Custom", SamplesPerPixel=16, StepSize=1,
                   Precision="Double", ScreenDistance=0.5 - 2e-3)  # 0.5 m from its rim
assert image_array(shadow, "Intensity").std() > 0
data = output(shadow).GetFieldData()
assert abs(data.GetArray("WavePlane").GetValue(0) - 2e-3) < 1e-9
assert abs(data.GetArray("FresnelWidth").GetValue(0) - math.sqrt(0.5 * WAVELENGTH)) < 1e-6
assert "waves, which matter" in status_of(shadow), status_of(shadow)

# Rays make the same image whatever has been made of waves before.
shadow.LightModel, shadow.Precision = "Rays", "Single"
rays = image_array(shadow, "Intensity")
assert "waves" not in status_of(shadow)
assert output(shadow).GetFieldData().GetArray("FresnelWidth") is None
plain = Schlieren(Input=source, Bodies=shadow.Bodies, Density=["POINTS", "rho"], Cutoff="Shadowgraph",
                  ParallelScale=HALF, ImageSize=[128, 128], Quality="Custom", SamplesPerPixel=16, StepSize=1,
                  ScreenDistance=0.5 - 2e-3)
assert np.array_equal(image_array(plain, "Intensity"), rays)
assert rays[63:65, 63:65].max() == 0, "There is no spot in the shadow of rays"

# What the view's line says of other techniques.
column = Schlieren(Input=gaussian_column(96), Density=["POINTS", "N"], IndexModel="Refractivity", IndexArray=["POINTS", "N"],
                   AmbientRefractivity=0, LengthScale=2e-3, Wavelength=1e9 * WAVELENGTH, ParallelScale=0.8,
                   ImageSize=[64, 64], LightModel="Waves", SamplesPerPixel=4)
for cutoff, words in (("Phase Contrast", "rays do not show phases"), ("Graded Filter", "waves"), ("Interferogram", "waves"),
                      ("Bright Field", "several wavelengths")):
    column.Cutoff = cutoff
    output(column)
    assert words in status_of(column), status_of(column)

column.Cutoff, column.Quality = "Phase Contrast", "Publication"
seen = image_array(column, "Intensity")

# It is of waves whatever LightModel says, as they alone have phases.
column.LightModel = "Rays"
assert np.array_equal(image_array(column, "Intensity"), seen)
assert "waves: " in status_of(column), status_of(column)

# A preview has no waves, and says so.
column.LightModel = "Waves"
column.GetClientSideObject().SetPreviewReduction(4)
output(column)
assert status_of(column).startswith("Preview: rays as yet, "), status_of(column)
column.Cutoff = "Interferogram"
column.GetClientSideObject().SetPreviewReduction(4)
output(column)
assert status_of(column).startswith("Preview: rays as yet, "), status_of(column)
column.GetClientSideObject().SetPreviewReduction(1)

# What waves cannot do is one message.
flow = Schlieren(Input=gaussian_column(16), Density=["POINTS", "rho"], ImageSize=[32, 32], LightModel="Waves",
                Cutoff="Color Filter")
for settings, words in (({}, "Cutoff to another technique"),
                        ({"Cutoff": "Phase Contrast", "LightModel": "Rays", "ViewAngle": 30},
                         "ViewAngle to less (0 is parallel light), or Cutoff"),
                        ({"Cutoff": "Shadowgraph", "LightModel": "Waves"}, "ViewAngle to less"),
                        ({"ViewAngle": 0, "PathModel": "Straight"}, "PathModel to Refracted"),
                        ({"PathModel": "Refracted", "LengthScale": 1e5}, "MiB may be used")):
    for key, value in settings.items():
        setattr(flow, key, value)
    assert is_empty(flow), settings
    status = status_of(flow)
    assert status.startswith("No image: ") and words in status, status
