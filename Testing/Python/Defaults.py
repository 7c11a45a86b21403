# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""What scripts get that choose nothing: the arrays and units of flows that solvers write, without an input, too."""

import numpy as np
from paraview import simple
from plugin_testing import RefractiveIndex, Schlieren, image_array, is_empty, output
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonDataModel import vtkImageData

SIDE = 9


def flow(*arrays):
    """An image with bumps: (name, low, high) of points, (name, low, high, "CELLS") of cells."""
    image = vtkImageData()
    image.SetDimensions(SIDE, SIDE, SIDE)
    image.SetSpacing(3 * [1 / (SIDE - 1)])
    for name, low, high, *association in arrays:
        x = np.linspace(-1, 1, SIDE - 1 if association else SIDE)
        z, y, x = np.meshgrid(x, x, x, indexing="ij")
        array = numpy_to_vtk((low + (high - low) * np.exp(-3 * (x**2 + y**2 + z**2))).ravel(), deep=True)
        array.SetName(name)
        (image.GetCellData() if association else image.GetPointData()).AddArray(array)
    producer = simple.TrivialProducer()
    producer.GetClientSideObject().SetOutput(image)
    producer.UpdatePipeline()
    return producer


def used(proxy):
    proxy.UpdatePropertyInformation()
    return proxy.GetProperty("ArraysUsed").GetData()


# Without an input nothing is chosen, and nothing breaks.
for kind in (Schlieren, RefractiveIndex):
    alone = kind()
    assert not alone.Density[1], list(alone.Density)
    alone.Density = None
    simple.Delete(alone)
bench = Schlieren(Input=flow(("rho", 1, 1.2)))
bench.UpdatePipeline()
bench.Input = None
bench.Density = None
simple.ResetProperty("Density", bench)
simple.Delete(bench)

for arrays, density in (
        ((("Material Id", 2, 3), ("rho", 6, 13)), ["POINTS", "rho"]),
        ((("RhoRT", 101324.9, 101325.1), ("density", .2, 1.1), ("temp", 298, 1580)), ["POINTS", "density"]),
        ((("density", .2, .5, "CELLS"), ("node_value", 0, 3)), ["CELLS", "density"]),
        ((("cellID", 0, 4095, "CELLS"), ("p", 9e4, 1.2e5, "CELLS"), ("rho", 1, 1.4, "CELLS")), ["CELLS", "rho"]),
        ((("Avg_Density_Grad", -1, 1), ("Density", .5, 1.3), ("Mach", 0, 2)), ["POINTS", "Density"]),
        ((("alpha1", 0, 1), ("alpha_rho1", 0, 1), ("pres", 9e4, 2e5), ("rho", .1, 1.2)), ["POINTS", "rho"])):
    for kind in (Schlieren, RefractiveIndex):
        proxy = kind(Input=flow(*arrays))
        assert list(proxy.Density) == density, (arrays, list(proxy.Density))
        assert not is_empty(proxy)
        assert used(proxy) == f"Density: '{density[1]}'.", used(proxy)

# A mask by its name, of points or cells, where it marks anything.
for arrays, mask in ((("solid", 0, 1),), ["POINTS", "solid"]), ((("vfrac", 0, 1, "CELLS"),), ["CELLS", "vfrac"]), \
        ((("solid", 0, 0),), ["POINTS", "None"]):
    for kind in (Schlieren, RefractiveIndex):
        proxy = kind(Input=flow(("rho", 1, 1.2), *arrays))
        assert list(proxy.Mask) == mask, (arrays, list(proxy.Mask))
        proxy.UpdatePipeline()
        assert used(proxy) == "Density: 'rho'" + (f"; Mask: '{mask[1]}'." if mask[1] != "None" else "."), used(proxy)
gas, body = flow(("rho", 1, 1.2)), flow(("rho", 1, 1.2), ("solid", 0, 1))
changed = Schlieren(Input=gas)
changed.Input = body
assert list(changed.Mask) == ["POINTS", "solid"], list(changed.Mask)
changed.Mask = ["POINTS", "None"]
assert image_array(changed, "BlockedFraction").max() == 0

# Not those of the active source, of which ParaView thinks first; of a second filter, too.
one, other = flow(("rho", 1, 1.2)), flow(("dens", 1, 1.2))
for _ in range(2):
    simple.SetActiveSource(one)
    assert list(Schlieren(Input=other).Density) == ["POINTS", "dens"]
changed = Schlieren(Input=one)
changed.Input = other
assert list(changed.Density) == ["POINTS", "dens"]
changed.Input = flow(("f", 1, 1.2))
assert not changed.Density[1], list(changed.Density)

# None is chosen where none is known.
for arrays in ((("ids", 1, 1249),), (("Y(H)", 0, 1e-5), ("Y(O2)", .1, .23)), (("scalars", -1, 1),)):
    bench = Schlieren(Input=flow(*arrays))
    assert not bench.Density[1] and is_empty(bench), (arrays, list(bench.Density))

# The unit in a name, unless a factor is given.
cgs = flow(("Density [g/cm3]", 1.2e-3, 1.3e-3))
settings = {"Input": cgs, "ImageSize": [16, 16]}
plain = image_array(Schlieren(Input=flow(("rho", 1.2, 1.3)), ImageSize=[16, 16]), "OpticalPathDifference")
for more in ({}, {"Density": ["POINTS", "Density [g/cm3]"]},
             {"Density": ["POINTS", "Density [g/cm3]"], "DensityScale": 1000}):
    seen = image_array(Schlieren(**settings, **more), "OpticalPathDifference")
    assert np.abs(seen - plain).max() < 1e-5 * np.abs(plain).max(), more

# Moist air, with no choice and with that of the model alone.
air = flow(("p", 9e4, 1e5), ("T", 280, 300))
medium = RefractiveIndex(Input=air)
medium.UpdatePipeline()
assert used(medium) == "Temperature: 'T'; Pressure: 'p'.", used(medium)
given = RefractiveIndex(Input=air, IndexModel="Ciddor")
assert [list(array) for array in (given.Temperature, given.Pressure)] == [["POINTS", "T"], ["POINTS", "p"]], (
    list(given.Temperature), list(given.Pressure))
ranges = [output(proxy).GetPointData().GetArray("Refractivity").GetRange() for proxy in (medium, given)]
assert ranges[0] == ranges[1] and 2e-4 < ranges[0][0] < ranges[0][1] < 3e-4, ranges
