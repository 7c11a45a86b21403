# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Laser shadowgraphs: the light behind a sphere, with the bright spot in the middle of its shadow."""

import math

import numpy as np
from paraview.simple import Sphere, TrivialProducer
from plugin_testing import Schlieren, gaussian_column, image_array, is_empty, output
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonDataModel import vtkImageData

WAVELENGTH, RADIUS, HALF = 532e-9, 1e-3, 4e-3


def fresnel_disc(place, distance):
    """The light behind an opaque disc, by Fresnel's integral over it."""
    k = 2 * math.pi / WAVELENGTH
    q = (np.arange(4000) + 0.5) * RADIUS / 4000
    angle = (np.arange(400) + 0.5) * math.pi / 400
    bessel = np.cos(np.outer(k * q * place / distance, np.cos(angle))).mean(axis=1)
    behind = (k / (1j * distance) * np.exp(0.5j * k * (q**2 + place**2) / distance) * bessel * q).mean() * RADIUS
    return abs(1 - behind)**2


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
                   ParallelScale=HALF, ImageSize=[512, 512], Quality="Custom", SamplesPerPixel=16, StepSize=1,
                   Precision="Double", ScreenDistance=0.5 - 2e-3)  # 0.5 m from its rim
light = image_array(shadow, "Intensity")
data = output(shadow).GetFieldData()
assert abs(data.GetArray("WavePlane").GetValue(0) - 2e-3) < 1e-9
assert abs(data.GetArray("FresnelWidth").GetValue(0) - math.sqrt(0.5 * WAVELENGTH)) < 1e-6
x = (np.arange(512) - 255.5) * HALF / 256
row = light[255:257].mean(axis=0)
exact = np.array([fresnel_disc(abs(place), 0.5) for place in x])
spot = light[255:257, 255:257].mean()
inside = np.abs(x) < 3.5e-3
rms = math.sqrt(np.average((row - exact)[inside]**2, weights=np.abs(x[inside])))
print(f"spot {spot:.4f} (exact {fresnel_disc(math.hypot(x[255], x[255]), 0.5):.4f}), rms {rms:.1e}")
assert abs(spot - 0.966) < 0.015, spot
assert rms < 4e-3, rms
assert "waves, which matter" in status_of(shadow), status_of(shadow)

# Rays make the same image whatever has been made of waves before.
shadow.LightModel = "Rays"
rays = image_array(shadow, "Intensity")
assert "waves" not in status_of(shadow)
assert output(shadow).GetFieldData().GetArray("FresnelWidth") is None
plain = Schlieren(Input=source, Bodies=shadow.Bodies, Density=["POINTS", "rho"], Cutoff="Shadowgraph",
                  ParallelScale=HALF, ImageSize=[512, 512], Quality="Custom", SamplesPerPixel=16, StepSize=1,
                  Precision="Double", ScreenDistance=0.5 - 2e-3)
assert np.array_equal(image_array(plain, "Intensity"), rays)
assert rays[255:257, 255:257].max() == 0, "There is no spot in the shadow of rays"

# Auto: waves here, rays on pixels of 4 mm and where no waves can be made, with the reason in the view's line.
shadow.LightModel = "Auto"
assert np.array_equal(image_array(shadow, "Intensity"), light)
shadow.ImageSize, shadow.ParallelScale = [8, 8], 2e-2
output(shadow)
assert "rays, which suffice" in status_of(shadow), status_of(shadow)
shadow.Cutoff = "Circular"
output(shadow)
assert "waves are made of a Shadowgraph or a Knife Edge alone" in status_of(shadow)

# What waves cannot do is one message.
flow = Schlieren(Input=gaussian_column(16), Density=["POINTS", "rho"], ImageSize=[32, 32], LightModel="Waves",
                Cutoff="Circular")
for settings, words in (({}, "Cutoff to one of these"), ({"Cutoff": "Shadowgraph", "ViewAngle": 20}, "ViewAngle to 0"),
                        ({"ViewAngle": 0, "PathModel": "Difference"}, "PathModel to Auto"),
                        ({"PathModel": "Auto", "LengthScale": 10}, "MemoryBudget")):
    for key, value in settings.items():
        setattr(flow, key, value)
    assert is_empty(flow), settings
    status = status_of(flow)
    assert status.startswith("No image: ") and words in status, status
