# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Gases by name: the lists of the panel and Documentation/gases.md are those of the table itself.

Where gases.md differs, the test prints the rows that belong there.
"""

import math
import os

from plugin_testing import CONSTANT, RefractiveIndex, Schlieren, gaussian_column, output
from schlieren.vtkSchlierenFilters import vtkGasTable

names = [vtkGasTable.GetName(i) for i in range(vtkGasTable.GetNumberOfGases())]
assert "helium" in names and len(set(names)) == len(names)
column = gaussian_column(16)

# The list that users choose from.
for proxy in (RefractiveIndex(column), Schlieren(column)):
    offered = list(proxy.Gas.Available)
    assert offered == ["air", "water"] + names[1:], f"Gas offers {offered}, the table {names}"


def largest(proxy):
    return output(proxy).GetPointData().GetArray("Refractivity").GetRange()[1]


# A gas, by name and by formula.
s = RefractiveIndex(column)
air = largest(s)
assert math.isclose(air, column.PointData["N"].GetRange()[1], rel_tol=1e-6)
s.Wavelength = 589.3
for gas in ("helium", "He"):
    s.Gas = gas
    assert math.isclose(largest(s), air * vtkGasTable.GetConstant("helium", 589.3) / CONSTANT, rel_tol=1e-6)
s.GladstoneDaleConstant = 2 * CONSTANT
assert math.isclose(largest(s), 2 * air, rel_tol=1e-6)
s.GladstoneDaleConstant, s.Gas, s.Wavelength = 0, "air", 632.8
assert largest(s) == air

# A mixture that is one gas, whatever the fractions.
s.IndexModel = "Gladstone-Dale Mixture"
s.MixtureArrays = ["N", "n"]
s.MixtureGases = ["SF6", "sulfur hexafluoride"]
s.BackgroundGas = "sulfur hexafluoride"
s.Wavelength = 700
assert math.isclose(largest(s), air * vtkGasTable.GetConstant("SF6", 700) / CONSTANT,
                    rel_tol=1e-6)
s.MixtureGases = ["1e-3", "2e-3"]
before = largest(s)
s.MixtureGases = ["1e-3", "3e-3"]
assert largest(s) > 1.3 * before


# The table in the documentation.
def row(name):
    shortest = vtkGasTable.GetShortestWavelength(name)
    longest = vtkGasTable.GetLongestWavelength(name)
    measured = f"{shortest:g}" if shortest == longest else f"{shortest:g} to {longest:g}"
    return (f"| {name} | {vtkGasTable.GetFormula(name)} "
            f"| {1e3 * vtkGasTable.GetMolarMass(name):.4f} "
            f"| {1e4 * vtkGasTable.GetConstant(name, 589.3):.4f} "
            f"| {1e4 * vtkGasTable.GetConstant(name, 632.8):.4f} "
            f"| {measured} | {vtkGasTable.GetSource(name)} |")


path = os.path.join(os.environ["SCHLIEREN_SOURCE_DIR"], "Documentation", "gases.md")
with open(path, encoding="utf-8") as file:
    written = [line.rstrip("\n") for line in file if line.startswith("|")][2:]
expected = [row(name) for name in names]
if written != expected:
    print("\n".join(expected))
    raise AssertionError(f"{path} differs from the table of gases: put these rows there")
