// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "PictureOutput.h"

#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkSmartPointer.h"
#include "vtkStringArray.h"
#include "vtkTypeInt64Array.h"
#include "vtkUnsignedCharArray.h"

#include "Schlieren.h"

#include <algorithm>
#include <string>

namespace
{

/// An array that takes over the memory of `values`.
template <class Array, class Value>
vtkSmartPointer<Array> newArray(
  const char* name, schlieren::PixelArray<Value>& values, int components)
{
  auto array = vtkSmartPointer<Array>::New();
  array->SetName(name);
  array->SetNumberOfComponents(components);
  const auto size = static_cast<vtkIdType>(values.size());
  array->SetArray(values.release(), size, 0, Array::VTK_DATA_ARRAY_DELETE);
  if (components == 2)
  {
    array->SetComponentName(0, "u");
    array->SetComponentName(1, "v");
  }
  return array;
}

template <class Array, class Value>
void addFieldValue(vtkImageData* output, const char* name, const Value& value)
{
  vtkNew<Array> array;
  array->SetName(name);
  array->InsertNextValue(value);
  output->GetFieldData()->AddArray(array);
}

} // namespace

//------------------------------------------------------------------------------
void setOutput(vtkImageData* output, schlieren::Image& image)
{
  output->SetExtent(0, image.width - 1, 0, image.height - 1, 0, 0);
  output->SetOrigin(image.frame.origin[0], image.frame.origin[1], 0);
  output->SetSpacing(image.frame.pixelSize, image.frame.pixelSize, image.frame.pixelSize);

  vtkPointData* arrays = output->GetPointData();
  arrays->SetScalars(newArray<vtkFloatArray>("Intensity", image.intensity, 1));
  arrays->AddArray(newArray<vtkFloatArray>("Deflection", image.deflection, 2));
  arrays->AddArray(
    newArray<vtkDoubleArray>("OpticalPathDifference", image.opticalPathDifference, 1));
  arrays->AddArray(newArray<vtkFloatArray>("Displacement", image.displacement, 2));
  arrays->AddArray(newArray<vtkFloatArray>("BlockedFraction", image.blockedFraction, 1));

  addFieldValue<vtkStringArray>(
    output, "Device", image.device == schlieren::Device::Cuda ? "CUDA" : "CPU");
  addFieldValue<vtkStringArray>(output, "PathModel",
    image.pathModel == schlieren::PathModel::Straight ? "Straight" : "Refracted");
  addFieldValue<vtkDoubleArray>(output, "KScale", image.kScale);
  addFieldValue<vtkDoubleArray>(output, "AmbientRefractivity", image.ambient);
  addFieldValue<vtkTypeInt64Array>(output, "RaysTraced", image.raysTraced);
  addFieldValue<vtkTypeInt64Array>(output, "RaysLost", image.raysLost);
  addFieldValue<vtkTypeInt64Array>(output, "StepsTaken", image.stepsTaken);
  addFieldValue<vtkDoubleArray>(output, "TraceSeconds", image.traceSeconds);
  addFieldValue<vtkDoubleArray>(output, "DisplacementBound", image.displacementBound);
  addFieldValue<vtkDoubleArray>(output, "SkippingBound", image.skippingBound);
  addFieldValue<vtkDoubleArray>(output, "MomentumDrift", image.momentumDrift);
}

//------------------------------------------------------------------------------
void addColor(vtkImageData* output, const schlieren::Image& image, float white)
{
  vtkNew<vtkUnsignedCharArray> array;
  array->SetName("Color");
  array->SetNumberOfComponents(3);
  array->SetNumberOfTuples(static_cast<vtkIdType>(image.color.size()) / 3);
  std::transform(image.color.begin(), image.color.end(), array->GetPointer(0),
    [white](float light)
    { return static_cast<unsigned char>(std::clamp(light / white, 0.f, 1.f) * 255.f + 0.5f); });
  output->GetPointData()->AddArray(array); // SetScalars would throw out the intensity
  output->GetPointData()->SetActiveScalars("Color");
}

//------------------------------------------------------------------------------
void addGrid(vtkImageData* output, const char* grid, vtkImageData* refractivity)
{
  addFieldValue<vtkStringArray>(output, "Grid", std::string(grid));
  if (vtkDataArray* used = refractivity->GetFieldData()->GetArray("SamplingDimensions"))
  {
    vtkNew<vtkIntArray> dimensions;
    dimensions->DeepCopy(used);
    dimensions->SetName("MediumDimensions");
    output->GetFieldData()->AddArray(dimensions);
  }
}
