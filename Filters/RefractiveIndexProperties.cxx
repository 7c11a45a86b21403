// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "GasChoices.h"
#include "vtkGasTable.h"
#include "vtkRefractiveIndex.h"

#include "vtkPiecewiseFunction.h"

using namespace filters;

namespace
{

void printList(
  ostream& os, vtkIndent indent, const char* name, const std::vector<std::string>& texts)
{
  os << indent << name << ":";
  for (const std::string& text : texts)
  {
    os << " '" << text << "'";
  }
  os << "\n";
}

void printList(ostream& os, vtkIndent indent, const char* name, const std::vector<double>& values)
{
  os << indent << name << ":";
  for (const double value : values)
  {
    os << " " << value;
  }
  os << "\n";
}

void printFunction(ostream& os, vtkIndent indent, vtkPiecewiseFunction* function)
{
  os << indent << "TransferFunction:";
  for (int i = 0; function && i < function->GetSize(); ++i)
  {
    double node[4]; // place, value, midpoint, sharpness
    function->GetNodeValue(i, node);
    os << " (" << node[0] << " " << node[1] << " " << node[2] << " " << node[3] << ")";
  }
  if (function)
  {
    os << " clamping " << function->GetClamping();
  }
  os << "\n";
}

} // namespace

//------------------------------------------------------------------------------
void vtkRefractiveIndex::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  this->PrintSettings(os, indent);
  os << indent << "ArraysUsed: " << this->GetArraysUsed() << "\n";
  os << indent << "Grid: " << this->Grid << "\n";
  os << indent << "NumberOfThreads: " << this->NumberOfThreads << "\n";
}

//------------------------------------------------------------------------------
void vtkRefractiveIndex::PrintSettings(ostream& os, vtkIndent indent)
{
  os << indent << "IndexModel: " << this->IndexModel << "\n";
  os << indent << "Gas: " << this->Gas << "\n";
  os << indent << "GladstoneDaleConstant: " << this->GladstoneDaleConstant << "\n";
  os << indent << "DensityScale: " << this->DensityScale << "\n";
  printList(os, indent, "MixtureArrays", this->MixtureArrays);
  printList(os, indent, "MixtureGases", this->MixtureGases);
  printList(os, indent, "MixtureConstants", this->MixtureConstants);
  printList(os, indent, "MixtureMolarMasses", this->MixtureMolarMasses);
  os << indent << "BackgroundGas: " << this->BackgroundGas << "\n";
  os << indent << "BackgroundConstant: " << this->BackgroundConstant << "\n";
  os << indent << "BackgroundMolarMass: " << this->BackgroundMolarMass << "\n";
  os << indent << "FractionType: " << this->FractionType << "\n";
  os << indent << "TemperatureScale: " << this->TemperatureScale << "\n";
  os << indent << "PressureScale: " << this->PressureScale << "\n";
  os << indent << "RelativeHumidity: " << this->RelativeHumidity << "\n";
  os << indent << "CO2: " << this->CO2 << "\n";
  os << indent << "Wavelength: " << this->Wavelength << "\n";
  printList(os, indent, "Fields", this->Fields);
  os << indent << "TransferFunctions: " << this->TransferFunctions.size() << "\n";
  for (vtkPiecewiseFunction* function : this->TransferFunctions)
  {
    printFunction(os, indent, function);
  }
  printList(os, indent, "FieldRanges", this->FieldRanges);
  os << indent << "RefractivityScale: " << this->RefractivityScale << "\n";
  os << indent << "SamplingDimensions: " << this->SamplingDimensions[0] << " "
     << this->SamplingDimensions[1] << " " << this->SamplingDimensions[2] << "\n";
  printList(os, indent, "SamplingBounds",
    std::vector<double>(this->SamplingBounds, this->SamplingBounds + 6));
  os << indent << "MaskThreshold: " << this->MaskThreshold << "\n";
  os << indent << "MaskedSide: " << this->MaskedSide << "\n";
  os << indent << "Depth: " << this->Depth << "\n";
  os << indent << "Symmetry: " << this->Symmetry << "\n";
  os << indent << "SymmetryAxis: " << this->SymmetryAxis << "\n";
  printList(os, indent, "SymmetryOrigin",
    std::vector<double>(this->SymmetryOrigin, this->SymmetryOrigin + 3));
  os << indent << "Outside: " << this->Outside << "\n";
  os << indent << "Reconstruction: " << this->Reconstruction << "\n";
  os << indent << "DoublePrecision: " << this->DoublePrecision << "\n";
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
  this->TransferFunctions.emplace_back(function);
  this->Modified();
}

//------------------------------------------------------------------------------
void vtkRefractiveIndex::ClearTransferFunctions()
{
  this->TransferFunctions.clear();
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
