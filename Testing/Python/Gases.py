# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The index models that take several arrays, as scripts use them."""

import numpy as np
from plugin_testing import (RefractiveIndex, Schlieren, gaussian_column, is_empty, output, image_array)
from paraview.simple import Calculator
from vtkmodules.util.numpy_support import vtk_to_numpy

HELIUM, AIR = 1.95e-4, 2.26e-4  # Gladstone-Dale constants, m^3/kg

source = gaussian_column(32)
flow = source
for name, formula in (("Y_He", "rho/3"), ("T", "280+rho"), ("p", "90000+1000*rho"),
                      ("RH", "0.1*rho")):
    flow = Calculator(flow, ResultArrayName=name, Function=formula)
    flow.UpdatePipeline()
arrays = {name: vtk_to_numpy(output(flow).GetPointData().GetArray(name))
          for name in ("rho", "Y_He", "T", "p", "RH")}


def refractivity(proxy):
    return vtk_to_numpy(output(proxy).GetPointData().GetArray("Refractivity")).astype(float)


def is_near(a, b):
    return np.abs(a / b - 1).max() < 2e-7  # single precision


# Helium in air, by mass and by volume.
s = RefractiveIndex(flow)
s.IndexModel = "Gladstone-Dale Mixture"
s.Density = ["POINTS", "rho"]
s.MixtureArrays = ["Y_He"]
s.MixtureGases = [str(HELIUM)]
assert s.BackgroundGas == "air"
s.BackgroundGas = f"{AIR} 0.0289647"
assert list(s.MixtureArrays) == ["Y_He"] and list(s.MixtureGases) == [str(HELIUM)]
rho, y = arrays["rho"], arrays["Y_He"]
positive = rho > 1e-30  # elsewhere nothing is left in single precision
by_mass = rho * (HELIUM * y + AIR * (1 - y))
assert is_near(refractivity(s)[positive], by_mass[positive])
s.FractionType = "Volume"
s.MixtureGases = [f"{HELIUM} 0.0040026"]
light, heavy = 0.0040026 * y, 0.0289647 * (1 - y)
by_volume = rho * (HELIUM * light + AIR * heavy) / (light + heavy)
assert is_near(refractivity(s)[positive], by_volume[positive])
s.FractionType = "Mass"
s.MixtureArrays = []
s.MixtureGases = []
assert refractivity(s).max() > 0, "The fraction is known by its name"
s.UpdatePropertyInformation()
assert s.GetProperty("ArraysUsed").GetData() == "Density: 'rho'; fractions: 'Y_He'.", s.GetProperty("ArraysUsed").GetData()
s.MixtureGases = ["nothing"]
assert is_empty(s)
s.MixtureArrays = ["Y_He", "RH"]
s.MixtureGases = [str(HELIUM), "2e-4"]
s.BackgroundGas = "1e-4"
mixed = rho * (HELIUM * y + 2e-4 * arrays["RH"] + 1e-4 * (1 - y - arrays["RH"]))
assert is_near(refractivity(s)[positive], mixed[positive])

# Moist air. Dry at 20 C and 1 atm: NIST's calculator, 633 nm.
s = RefractiveIndex(flow)
s.IndexModel = "Ciddor"
assert [list(array) for array in (s.Temperature, s.Pressure, s.Humidity)] == [
    ["POINTS", "T"], ["POINTS", "p"], ["POINTS", "RH"]]
s.Humidity = ["POINTS", "None"]
dry = refractivity(s)
assert np.abs(dry / (2.718e-4 * 293.15 / 101325 * arrays["p"] / arrays["T"]) - 1).max() < 1e-3
s.RelativeHumidity = 1
assert (refractivity(s) < dry).all(), "Vapour refracts less than the air whose place it takes"
s.Humidity = ["POINTS", "RH"]
assert np.abs(refractivity(s) - dry).max() > 0
s.Humidity = ["POINTS", "None"]
s.RelativeHumidity = 0
assert np.array_equal(refractivity(s), dry)
for name, value in (("Wavelength", 400), ("PressureScale", 1.01)):
    default = s.GetProperty(name).GetData()
    setattr(s, name, value)
    assert not np.array_equal(refractivity(s), dry), name
    setattr(s, name, default)
assert np.array_equal(refractivity(s), dry)

# The bench sees the same.
for model, choices in (
        ("Gladstone-Dale Mixture", {"Density": ["POINTS", "rho"], "MixtureArrays": ["Y_He"],
                                    "MixtureGases": [str(HELIUM)]}),
        ("Ciddor", {"Humidity": ["POINTS", "None"]})):
    images = []
    for proxy in (RefractiveIndex(flow), Schlieren(flow)):
        proxy.IndexModel = model
        for name, value in choices.items():
            setattr(proxy, name, value)
        proxy.UpdatePipeline()
        bench = proxy if proxy.GetXMLName() == "Schlieren" else Schlieren(proxy)
        bench.ImageSize = [32, 32]
        images.append(image_array(bench, "OpticalPathDifference"))
    # Of the former's output, the digits of single precision.
    assert np.abs(images[0] - images[1]).max() < 1e-4 * np.ptp(images[0]), model
