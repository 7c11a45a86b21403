// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCompareWithPhotograph.h"

#include "Common/Sentences.h"
#include "Guarded.h"
#include "Image/FieldData.h"
#include "Image/PixelInWords.h"
#include "Photograph/Compared.h"
#include "Photograph/ComparisonViews.h"
#include "Ranks/Ranks.h"

#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationStringKey.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkStringArray.h"

#include <cmath>
#include <cstring>
#include <optional>
#include <stdexcept>
#include <type_traits>
#include <vector>

using namespace filters;

vtkStandardNewMacro(vtkCompareWithPhotograph);

using Pipeline = vtkStreamingDemandDrivenPipeline;

/// `From`: the times of the inputs and the values of the properties. `Found`: nothing where that has failed.
struct vtkCompareWithPhotograph::Last
{
  std::vector<double> From;
  std::optional<Compared> Found;
};

namespace
{

static_assert(static_cast<int>(View::Photograph) == vtkCompareWithPhotograph::SHOW_PHOTOGRAPH &&
  static_cast<int>(View::Simulated) == vtkCompareWithPhotograph::SHOW_SIMULATED &&
  static_cast<int>(View::Over) == vtkCompareWithPhotograph::SHOW_OVER &&
  static_cast<int>(View::Swipe) == vtkCompareWithPhotograph::SHOW_SWIPE &&
  static_cast<int>(View::Chequerboard) == vtkCompareWithPhotograph::SHOW_CHEQUERBOARD &&
  static_cast<int>(View::RedCyan) == vtkCompareWithPhotograph::SHOW_RED_CYAN &&
  static_cast<int>(View::Difference) == vtkCompareWithPhotograph::SHOW_DIFFERENCE);

/// Calls a function with each number of a property.
template <class Value, class Use>
void forNumbers(const Value& value, const Use& use)
{
  if constexpr (std::is_arithmetic_v<Value>)
  {
    use(static_cast<double>(value));
  }
  else
  {
    for (const auto& number : value)
    {
      use(static_cast<double>(number));
    }
  }
}

void addArray(vtkImageData* output, const char* name, const Plane& plane, const char* unit)
{
  vtkNew<vtkFloatArray> array;
  array->SetName(name);
  array->SetNumberOfValues(static_cast<vtkIdType>(plane.size()));
  std::copy(plane.values.begin(), plane.values.end(), array->GetPointer(0));
  setUnit(array, unit);
  output->GetPointData()->AddArray(array);
}

void addShift(vtkImageData* output, const FeatureShift& shift)
{
  vtkNew<vtkFloatArray> array;
  array->SetName("FeatureShift");
  array->SetNumberOfComponents(3);
  const char* const components[] = { "u", "v", "w" };
  for (int component = 0; component < 3; ++component)
  {
    array->SetComponentName(component, components[component]);
  }
  array->SetNumberOfTuples(static_cast<vtkIdType>(shift.acrossRight.size()));
  setUnit(array, "data units");
  const double* spacing = output->GetSpacing();
  for (std::size_t i = 0; i < shift.acrossRight.size(); ++i)
  {
    array->SetTuple3(static_cast<vtkIdType>(i), shift.acrossRight.values[i] * spacing[0],
      shift.acrossUp.values[i] * spacing[1], 0);
  }
  output->GetPointData()->AddArray(array);
}

void addReport(vtkImageData* output, const Compared& found)
{
  addFieldValues<vtkStringArray>(output, "PhotographReport", found.sentences);
  addFieldValues<vtkDoubleArray>(output, "PhotographPlace", found.middle);
  const auto add = [&](const char* name, double value)
  {
    if (std::isfinite(value))
    {
      addFieldValue<vtkDoubleArray>(output, name, value);
    }
  };
  add("PhotographScale", found.scale);
  add("PhotographRotation", found.rotation);
  add("PhotographContrast", found.cutoff.contrast);
  add("PhotographContrastUncertainty", found.cutoff.contrast * found.contrastUncertainty);
  if (found.isKKnown)
  {
    add("PhotographK", found.cutoff.k);
    add("PhotographKUncertainty", found.cutoff.k * found.kUncertainty);
    add("PhotographOffset", found.cutoff.offset);
  }
  if (!found.cutoff.isAngleHidden)
  {
    add("PhotographAngle", found.cutoff.angle);
    add("PhotographAngleUncertainty", found.angleUncertainty);
  }
  add("PhotographFringeContrast", found.cutoff.fringeContrast);
  if (std::isfinite(found.cutoff.fringeContrast))
  {
    add("PhotographFringePhase", found.cutoff.fringePhase);
    add("PhotographFringeSpacing", found.cutoff.fringeSpacing);
    if (found.cutoff.fringeSpacing > 0)
    {
      add("PhotographFringeAngle", found.cutoff.fringeAngle);
    }
  }
  add("PhotographFullFraction", found.fullFraction);
  add("PhotographBlackLevel", found.black);
  add("PhotographResidual", found.residual);
  add("PhotographCorrelation", found.correlation);
  if (found.shift)
  {
    add("FeatureShiftMedian", found.shiftMedian);
    add("FeatureShift95", found.shiftLarge);
  }

  std::vector<std::string> notes;
  if (auto* given =
        vtkStringArray::SafeDownCast(output->GetFieldData()->GetAbstractArray("LegendNotes")))
  {
    for (vtkIdType i = 0; i < given->GetNumberOfValues(); ++i)
    {
      notes.push_back(given->GetValue(i));
    }
  }
  notes.insert(notes.end(), found.notes.begin(), found.notes.end());
  if (!notes.empty())
  {
    addFieldValues<vtkStringArray>(output, "LegendNotes", notes);
  }
}

} // namespace

vtkCompareWithPhotograph::vtkCompareWithPhotograph()
  : Kept(new Last)
{
  this->SetNumberOfInputPorts(3);
}

vtkCompareWithPhotograph::~vtkCompareWithPhotograph() = default;

void vtkCompareWithPhotograph::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  PhotographSettings::visit(
    [&](const char* name, auto member)
    {
      os << indent << name << ":";
      forNumbers(this->*member, [&](double number) { os << " " << number; });
      os << "\n";
    });
  os << indent << "Report: " << this->Report << "\n";
}

void vtkCompareWithPhotograph::SetProbedPlace(double right, double up)
{
  this->ProbedPlace[0] = right;
  this->ProbedPlace[1] = up;
}

const char* vtkCompareWithPhotograph::GetProbedPlace()
{
  this->Probed = pixelInWords(this->GetOutput(), this->ProbedPlace[0], this->ProbedPlace[1]);
  return this->Probed.c_str();
}

int vtkCompareWithPhotograph::FillInputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
  if (port == WITHOUT_FLOW)
  {
    info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  }
  return 1;
}

int vtkCompareWithPhotograph::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  // VTK copies from the first input where the points are; what they have is another array.
  vtkDataObject::SetPointDataActiveScalarInfo(
    outputVector->GetInformationObject(0), VTK_UNSIGNED_CHAR, 3);
  return 1;
}

int vtkCompareWithPhotograph::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector*)
{
  for (int port = 0; port < this->GetNumberOfInputPorts(); ++port)
  {
    for (int i = 0; i < inputVector[port]->GetNumberOfInformationObjects(); ++i)
    {
      vtkInformation* info = inputVector[port]->GetInformationObject(i);
      info->Set(Pipeline::UPDATE_EXTENT(), info->Get(Pipeline::WHOLE_EXTENT()), 6);
      if (port !=
        IMAGE) // which rank 0 makes with the help of the others; files each rank reads whole
      {
        info->Set(Pipeline::UPDATE_PIECE_NUMBER(), 0);
        info->Set(Pipeline::UPDATE_NUMBER_OF_PIECES(), 1);
      }
    }
  }
  return 1;
}

int vtkCompareWithPhotograph::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkImageData* output = vtkImageData::GetData(outputVector);
  output->Initialize();
  this->Report.clear();
  this->SetAbortExecute(0); // it stays set after an abort
  vtkImageData* inputs[3];
  for (int port = 0; port < 3; ++port)
  {
    inputs[port] = inputVector[port]->GetNumberOfInformationObjects() > 0
      ? vtkImageData::GetData(inputVector[port])
      : nullptr;
  }
  if (!isRank0())
  {
    setComplete(outputVector);
    return 1;
  }
  const auto work = [&]
  {
    if (inputs[IMAGE]->GetNumberOfPoints() == 0)
    {
      return; // it has said why
    }
    std::vector<double> from;
    for (vtkImageData* input : inputs)
    {
      from.push_back(input ? static_cast<double>(input->GetMTime()) : 0);
    }
    PhotographSettings::visit(
      [&](const char* name, auto member)
      {
        const bool isOfView =
          !std::strcmp(name, "Comparison") || !std::strcmp(name, "SwipePosition");
        forNumbers(this->*member,
          [&](double number) // infinity equals itself
          {
            from.push_back(isOfView ? 0 : std::isnan(number) ? HUGE_VAL : number);
          });
      });
    if (this->Kept->From != from)
    {
      this->Kept->From = from;
      this->Kept->Found.reset();
      const WorkProgress progress(
        [&](double done)
        {
          this->UpdateProgress(done);
          return !this->GetAbortExecute();
        });
      if (inputs[PHOTOGRAPH]->GetNumberOfPoints() == 0)
      {
        throw std::runtime_error("The photograph is empty. Choose another file.");
      }
      this->Kept->Found =
        compare(inputs[IMAGE], inputs[PHOTOGRAPH], inputs[WITHOUT_FLOW], *this, progress);
    }
    if (!this->Kept->Found)
    {
      return; // one message is enough
    }
    const Compared& found = *this->Kept->Found;
    output->ShallowCopy(inputs[IMAGE]);
    vtkNew<vtkFieldData> own;
    own->ShallowCopy(inputs[IMAGE]->GetFieldData());
    output->SetFieldData(own);
    addArray(output, "Photograph", found.photograph, "1");
    addArray(output, "Simulated", found.simulated, "1");
    addArray(output, "Difference", found.difference, "1");
    if (found.shift)
    {
      addShift(output, *found.shift);
    }
    output->GetPointData()->AddArray(comparisonOf(
      found.photograph, found.simulated, static_cast<View>(this->Comparison), this->SwipePosition));
    output->GetPointData()->SetActiveScalars("Comparison");
    addReport(output, found);
    for (const std::string& sentence : found.sentences)
    {
      addText(this->Report, sentence);
    }
  };
  const auto fail = [&](const std::string& problem)
  {
    output->Initialize();
    vtkErrorMacro(<< problem);
  };
  try
  {
    guarded(work, "There is not enough memory to compare the photograph. Use a smaller one.", fail);
  }
  catch (const Stopped&)
  {
    this->Kept->From.clear();
    output->Initialize();
  }
  setComplete(outputVector);
  return 1;
}
