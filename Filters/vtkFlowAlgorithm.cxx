// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkFlowAlgorithm.h"

#include "Common/Sentences.h"
#include "Gas/GasChoices.h"
#include "Sources/MediumMaker.h"
#include "Walls/GasBoundary.h"
#include "vtkGasTable.h"

#include "vtkDataObject.h"
#include "vtkInformation.h"
#include "vtkPiecewiseFunction.h"

#include <algorithm>
#include <cstddef>
#include <sstream>
#include <string>

using namespace filters;

static_assert(vtkFlowAlgorithm::DENSITY == static_cast<int>(MediumSettings::DensityArray) &&
  vtkFlowAlgorithm::INDEX_ARRAY == static_cast<int>(MediumSettings::IndexArray) &&
  vtkFlowAlgorithm::TEMPERATURE == static_cast<int>(MediumSettings::TemperatureArray) &&
  vtkFlowAlgorithm::PRESSURE == static_cast<int>(MediumSettings::PressureArray) &&
  vtkFlowAlgorithm::HUMIDITY == static_cast<int>(MediumSettings::HumidityArray) &&
  vtkFlowAlgorithm::MASK == static_cast<int>(MediumSettings::MaskArray));
static_assert(vtkFlowAlgorithm::OUTSIDE_AUTO == static_cast<int>(Outside::Auto) &&
  vtkFlowAlgorithm::OUTSIDE_BLOCKS == static_cast<int>(Outside::Blocks) &&
  vtkFlowAlgorithm::OUTSIDE_PASSES == static_cast<int>(Outside::Passes));

namespace
{

/// Returns the selection that SetInputArrayToProcess() has stored.
ArraySelection selectionFrom(vtkInformation* info)
{
  ArraySelection selection;
  if (const char* name = info->Get(vtkDataObject::FIELD_NAME()))
  {
    selection.name = name;
  }
  else if (info->Has(vtkDataObject::FIELD_ATTRIBUTE_TYPE()))
  {
    selection.attribute = info->Get(vtkDataObject::FIELD_ATTRIBUTE_TYPE());
  }
  selection.cellsFirst =
    info->Get(vtkDataObject::FIELD_ASSOCIATION()) == vtkDataObject::FIELD_ASSOCIATION_CELLS;
  return selection;
}

} // namespace

vtkFlowAlgorithm::vtkFlowAlgorithm()
  : Maker(std::make_shared<MediumMaker>([this](double done) { return this->ReportMedium(done); }))
{
}

vtkFlowAlgorithm::~vtkFlowAlgorithm() = default;

bool vtkFlowAlgorithm::ReportMedium(double done)
{
  this->UpdateProgress(done);
  return !this->GetAbortExecute();
}

MediumMaker& vtkFlowAlgorithm::GetMaker()
{
  this->Maker->settings = this->GetMediumSettings();
  return *this->Maker;
}

vtkTypeInt64 vtkFlowAlgorithm::GetMeshBuilds() { return this->Maker->mesh()->builds; }

const char* vtkFlowAlgorithm::GetArraysUsed()
{
  const MediumMaker& maker = this->GetMaker();
  const MediumChoice choice = maker.choice();
  this->ArraysUsed = choice.message;
  addText(this->ArraysUsed, noteOnGases(choice.settings));
  addText(this->ArraysUsed,
    maker.said().IndexModel == choice.settings.IndexModel ? maker.said().Continued : "");
  return this->ArraysUsed.c_str();
}

vtkMTimeType vtkFlowAlgorithm::GetMTime()
{
  vtkMTimeType time = this->Superclass::GetMTime();
  for (vtkPiecewiseFunction* function : this->Functions)
  {
    time = std::max(time, function ? function->GetMTime() : 0);
  }
  return time;
}

int vtkFlowAlgorithm::FillInputPortInformation(int port, vtkInformation* info)
{
  // Any, so that one message says what is wrong with tables and others: VTK says it several times.
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkDataObject");
  if (port == BODIES)
  {
    info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  }
  return 1;
}

int vtkFlowAlgorithm::RequestDataObject(
  vtkInformation*, vtkInformationVector**, vtkInformationVector*)
{
  return 1; // VTK makes what FillOutputPortInformation() names
}

void vtkFlowAlgorithm::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  std::ostringstream settings;
  print(settings, 0, this->GetMediumSettings());
  std::istringstream lines(settings.str());
  for (std::string line; std::getline(lines, line);)
  {
    os << indent << line << "\n";
  }
  os << indent << "ArraysUsed: " << this->GetArraysUsed() << "\n";
}

MediumSettings vtkFlowAlgorithm::GetMediumSettings()
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

void vtkFlowAlgorithm::AddTransferFunction(vtkPiecewiseFunction* function)
{
  this->Functions.emplace_back(function);
  this->Modified();
}

void vtkFlowAlgorithm::ClearTransferFunctions()
{
  this->Functions.clear();
  this->Modified();
}
