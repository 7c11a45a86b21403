# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Documentation/density.md: every snippet runs as it stands, and its numbers are right."""

import os
import re

import numpy as np
from flow_testing import DATA, SOURCE, one_dataset, image_array
from paraview.simple import PLOT3DReader, SaveData, XMLStructuredGridReader
from vtkmodules.util.numpy_support import vtk_to_numpy

# A folder that looks like the one that the snippets are run in.
os.makedirs("run/build/release", exist_ok=True)
os.chdir("run")
if not os.path.lexists("Testing"):
    os.symlink(os.path.join(SOURCE, "Testing"), "Testing")
with open("build/release/plugin-file.txt", "w") as file:
    file.write(os.environ["SCHLIEREN_PLUGIN"] + "\n")
original = XMLStructuredGridReader(FileName=[os.path.join(DATA, "deltawing.vts")])
original.UpdatePipeline()
SaveData("wing.cgns", proxy=original)

with open(os.path.join(SOURCE, "Documentation", "density.md"), encoding="utf-8") as file:
    snippets = re.findall(r"^```python\n(.*?)^```", file.read(), re.DOTALL | re.MULTILINE)
assert len(snippets) == 11, f"There are {len(snippets)} snippets: check the new ones below, too"
names, benches = {}, []
for snippet in snippets:
    names.pop("schlieren", None)
    exec(compile(snippet, "density.md", "exec"), names)
    if "schlieren" in names:
        benches.append(names["schlieren"])
assert len(benches) == 8


def arrays(proxy, *wanted, of="POINTS"):
    data = one_dataset(proxy)
    attributes = data.GetCellData() if of == "CELLS" else data.GetPointData()
    return [vtk_to_numpy(attributes.GetArray(name)).astype(float) for name in wanted]


def check_near(values, expected, tolerance):
    error = np.abs(values - expected).max() / np.abs(expected).max()
    assert error < tolerance, error


p, T, rho = arrays(names["wedge"], "p", "T", "rho", of="CELLS")
check_near(rho, p / (8.314463 / 28.96e-3) / T, 1e-4)  # 28.96 g/mol is what the case says
cells = names["jet"].GetDataInformation().GetNumberOfCells()
assert cells == 72 * 19200, cells

reader = PLOT3DReader(FileName=names["fin"].FileName, QFileName=names["fin"].QFileName,
                      FunctionFileName="")
reader.Functions = [110, 120]
reader.UpdatePipeline()
for made, given in zip(arrays(names["temperature"], "p", "T"),
                      arrays(reader, "Pressure", "Temperature")):
    check_near(made, given, 1e-6)

ranges = [proxy.PointData["Density"].GetRange() for proxy in (names["wing"], original)]
check_near(np.array(ranges[0]), np.array(ranges[1]), 0.005)  # ParaView's writer joined some points

# The mixture's molar mass is the mean one, weighted by moles.
Y = dict(zip(("AsH3", "CH4", "GaMe3", "H2"), arrays(names["gas"], "AsH3", "CH4", "GaMe3", "H2")))
mass = {"AsH3": 74.9216 + 3 * 1.00794, "CH4": 12.0107 + 4 * 1.00794,
        "GaMe3": 69.723 + 3 * (12.0107 + 3 * 1.00794), "H2": 2 * 1.00794}
moles = {name: Y[name] / mass[name] for name in mass}
mean = sum(moles[name] * mass[name] for name in mass) / sum(moles.values())
T, rho = arrays(names["gas"], "Temp", "rho")
check_near(rho, 101325 * mean * 1e-3 / (8.314463 * T), 5e-4)


def index_of_water(kelvin, micrometres=0.6328):
    """IAPWS R9-97, with the density of water at 101325 Pa after Kell 1975."""
    t = kelvin - 273.15
    density = np.polyval([-280.54253e-12, 105.56302e-9, -46.170461e-6, -7.9870401e-3, 16.945176,
                          999.83952], t) / (1 + 16.879850e-3 * t) / 1000
    T, square = kelvin / 273.15, (micrometres / 0.589)**2
    a = (0.244257733, 9.74634476e-3, -3.73234996e-3, 2.68678472e-4, 1.58920570e-3, 2.45934259e-3,
         0.900704920, -1.66626219e-2)
    lorentz = density * (a[0] + a[1] * density + a[2] * T + a[3] * square * T + a[4] / square
                         + a[5] / (square - 0.2292020**2) + a[6] / (square - 5.432937**2)
                         + a[7] * density**2)
    return np.sqrt((2 * lorentz + 1) / (1 - lorentz))


assert abs(index_of_water(293.15, 0.5893) - 1.33335) < 1e-5, "Water at 20 C, sodium light"
T, N = arrays(names["water"], "Temperature", "N")
assert np.abs(N - (index_of_water(T) - 1)).max() < 2e-6

# Sea water without salt is water, in air; what 35 g/kg of salt add is near to what the density of it says (UNESCO 1981).
sea = names["sea"].Function.replace("^", "**")
assert abs(1.00027 * eval(sea, {"S": 0, "T": 20}) - index_of_water(293.15)) < 3e-5
salt = eval(sea, {"S": 35, "T": 20}) - eval(sea, {"S": 0, "T": 20})
assert abs(salt / (1024.763 - 998.206) / 2.457e-4 - 1) < 0.03, salt
n, S, T = arrays(names["sea"], "n", "S", "T")
check_near(n, eval(sea, {"S": S, "T": T}), 1e-7)

# Each bench gives an image, here a small one.
for bench in benches:
    bench.Quality = "Interactive"
    bench.ImageSize = [32, 32]
    bench.Outside = "Passes"
    assert np.ptp(image_array(bench, "OpticalPathDifference")) > 0

# A plasma of 1e19 cm^-3 and a width of 0.5 mm: the closed form of the integral of N along the axis.
plasma = next(bench for bench in benches if bench.Input == names["plasma"])
plasma.ImageSize = [33, 33]
phase = 2 * np.pi * image_array(plasma, "OpticalPathDifference") / 532e-9
assert abs(phase.min() / -13.29185 - 1) < 2e-3, phase.min()

# Water by its temperature is water by its index.
by_name = next(bench for bench in benches if bench.Gas == "water")
by_index = next(bench for bench in benches if bench.Input == names["water"])
paths = [image_array(bench, "OpticalPathDifference") for bench in (by_name, by_index)]
assert np.abs(paths[0] - paths[1]).max() < 0.01 * np.ptp(paths[1])
