# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Gases by name: the lists of the panel and Documentation/gases.md are those of the table itself.

Where gases.md differs, the test prints the rows that belong there.
"""

import os

from plugin_testing import RefractiveIndex, Schlieren, gaussian_column
from schlieren.vtkSchlierenFilters import vtkGasTable

names = [vtkGasTable.GetName(i) for i in range(vtkGasTable.GetNumberOfGases())]
assert "helium" in names and len(set(names)) == len(names)
column = gaussian_column(16)

# The list that users choose from.
for proxy in (RefractiveIndex(column), Schlieren(column)):
    offered = list(proxy.Gas.Available)
    assert offered == ["air", "water"] + names[1:], f"Gas offers {offered}, the table {names}"


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
