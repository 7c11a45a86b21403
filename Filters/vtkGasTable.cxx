// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkGasTable.h"

#include "vtkObjectFactory.h"

#include "Schlieren.h"

#include <limits>
#include <string_view>

vtkStandardNewMacro(vtkGasTable);

namespace
{

constexpr double notANumber = std::numeric_limits<double>::quiet_NaN();
constexpr double nanometresPerMetre = 1e9;

} // namespace

void vtkGasTable::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfGases: " << vtkGasTable::GetNumberOfGases() << "\n";
}

int vtkGasTable::GetNumberOfGases() { return static_cast<int>(schlieren::gases().size()); }

std::string vtkGasTable::GetName(int index)
{
  const bool exists = index >= 0 && index < vtkGasTable::GetNumberOfGases();
  return std::string(
    exists ? schlieren::gases()[static_cast<std::size_t>(index)].name : std::string_view());
}

bool vtkGasTable::Has(const std::string& gas) { return schlieren::findGas(gas) != nullptr; }

std::string vtkGasTable::GetFormula(const std::string& gas)
{
  const schlieren::Gas* found = schlieren::findGas(gas);
  return std::string(found ? found->formula : std::string_view());
}

double vtkGasTable::GetConstant(const std::string& gas, double wavelength)
{
  const schlieren::Gas* found = schlieren::findGas(gas);
  return found ? found->constantAt(wavelength / nanometresPerMetre) : notANumber;
}

double vtkGasTable::GetMolarMass(const std::string& gas)
{
  const schlieren::Gas* found = schlieren::findGas(gas);
  return found ? found->molarMass : notANumber;
}

double vtkGasTable::GetShortestWavelength(const std::string& gas)
{
  const schlieren::Gas* found = schlieren::findGas(gas);
  return found ? found->shortestWavelength * nanometresPerMetre : notANumber;
}

double vtkGasTable::GetLongestWavelength(const std::string& gas)
{
  const schlieren::Gas* found = schlieren::findGas(gas);
  return found ? found->longestWavelength * nanometresPerMetre : notANumber;
}

std::string vtkGasTable::GetSource(const std::string& gas)
{
  const schlieren::Gas* found = schlieren::findGas(gas);
  return std::string(found ? found->source : std::string_view());
}
