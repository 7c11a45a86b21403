// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Gas/GasChoices.h"
#include "Settings/SelectionFromInformation.h"
#include "vtkGasTable.h"
#include "vtkRefractiveIndex.h"

#include "vtkPiecewiseFunction.h"

#include <cstddef>
#include <sstream>
#include <string>

using namespace filters;

//------------------------------------------------------------------------------
void vtkRefractiveIndex::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  std::ostringstream settings;
  print(settings, 0, this->GetSettings());
  std::istringstream lines(settings.str());
  for (std::string line; std::getline(lines, line);)
  {
    os << indent << line << "\n";
  }
  os << indent << "ArraysUsed: " << this->GetArraysUsed() << "\n";
  os << indent << "Grid: " << this->GetGrid() << "\n";
  os << indent << "NumberOfThreads: " << this->NumberOfThreads << "\n";
}

//------------------------------------------------------------------------------
MediumSettings vtkRefractiveIndex::GetSettings()
{
  MediumSettings settings = *this;
  for (int index = DENSITY; index <= MASK; ++index)
  {
    settings.Arrays[static_cast<std::size_t>(index)] =
      selectionFrom(this->GetInputArrayInformation(index));
  }
  for (vtkPiecewiseFunction* function : this->Functions)
  {
    TransferCurve& curve = settings.TransferFunctions.emplace_back();
    for (int i = 0; function && i < function->GetSize(); ++i)
    {
      function->GetNodeValue(i, curve.nodes.emplace_back().data());
    }
    curve.isClamped = !function || function->GetClamping();
    curve.isLogarithmic = function && function->GetUseLogScale();
  }
  return settings;
}

//------------------------------------------------------------------------------
void vtkRefractiveIndex::AddMixtureArray(const char* name)
{
  this->MixtureArrays.emplace_back(name ? name : "");
  this->Modified();
}

//------------------------------------------------------------------------------
void vtkRefractiveIndex::ClearMixtureArrays()
{
  this->MixtureArrays.clear();
  this->Modified();
}

//------------------------------------------------------------------------------
void vtkRefractiveIndex::AddMixtureGas(const char* name)
{
  this->MixtureGases.emplace_back(name ? name : "");
  this->Modified();
}

//------------------------------------------------------------------------------
void vtkRefractiveIndex::ClearMixtureGases()
{
  this->MixtureGases.clear();
  this->Modified();
}

//------------------------------------------------------------------------------
double vtkRefractiveIndex::GetGladstoneDaleConstantUsed()
{
  return isCustom(this->Gas) ? this->GladstoneDaleConstant
                             : vtkGasTable::GetConstant(this->Gas, this->Wavelength);
}

//------------------------------------------------------------------------------
void vtkRefractiveIndex::AddMixtureConstant(double constant)
{
  this->MixtureConstants.push_back(constant);
  this->Modified();
}

//------------------------------------------------------------------------------
void vtkRefractiveIndex::ClearMixtureConstants()
{
  this->MixtureConstants.clear();
  this->Modified();
}

//------------------------------------------------------------------------------
void vtkRefractiveIndex::AddMixtureMolarMass(double molarMass)
{
  this->MixtureMolarMasses.push_back(molarMass);
  this->Modified();
}

//------------------------------------------------------------------------------
void vtkRefractiveIndex::ClearMixtureMolarMasses()
{
  this->MixtureMolarMasses.clear();
  this->Modified();
}

//------------------------------------------------------------------------------
void vtkRefractiveIndex::AddField(const char* name)
{
  this->Fields.emplace_back(name ? name : "");
  this->Modified();
}

//------------------------------------------------------------------------------
void vtkRefractiveIndex::ClearFields()
{
  this->Fields.clear();
  this->Modified();
}

//------------------------------------------------------------------------------
void vtkRefractiveIndex::AddTransferFunction(vtkPiecewiseFunction* function)
{
  this->Functions.emplace_back(function);
  this->Modified();
}

//------------------------------------------------------------------------------
void vtkRefractiveIndex::ClearTransferFunctions()
{
  this->Functions.clear();
  this->Modified();
}

//------------------------------------------------------------------------------
void vtkRefractiveIndex::AddFieldRange(double value)
{
  this->FieldRanges.push_back(value);
  this->Modified();
}

//------------------------------------------------------------------------------
void vtkRefractiveIndex::ClearFieldRanges()
{
  this->FieldRanges.clear();
  this->Modified();
}
