// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Image/ImageOutput.h"

#include "Image/FieldData.h"
#include "Image/ImageStatus.h"

#include "Common/AvailableMemory.h"

#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationStringKey.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkSmartPointer.h"
#include "vtkStringArray.h"
#include "vtkTypeInt64Array.h"
#include "vtkUnsignedCharArray.h"

#include "Schlieren.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace filters
{

namespace
{

constexpr const char* dataUnits = "data units";

/// Makes an array that takes over the memory of the values.
template <class Array, class Value>
vtkSmartPointer<Array> newArray(
  const char* name, schlieren::PixelArray<Value>& values, int components, const char* unit)
{
  auto array = vtkSmartPointer<Array>::New();
  array->SetName(name);
  array->SetNumberOfComponents(components);
  const auto size = static_cast<vtkIdType>(values.size());
  array->SetArray(values.release(), size, 0, Array::VTK_DATA_ARRAY_DELETE);
  setUnit(array, unit);
  return array;
}

/// Makes an array of two values for each pixel and a 0, as ParaView's vectors have three.
vtkSmartPointer<vtkFloatArray> newVectors(
  const char* name, schlieren::PixelArray<float>& values, const char* unit)
{
  const schlieren::PixelArray<float> pairs = std::move(values);
  schlieren::PixelArray<float> vectors(pairs.size() / 2 * 3);
  for (std::size_t pixel = 0; pixel < pairs.size() / 2; ++pixel)
  {
    vectors[3 * pixel] = pairs[2 * pixel];
    vectors[3 * pixel + 1] = pairs[2 * pixel + 1];
    vectors[3 * pixel + 2] = 0;
  }
  auto array = newArray<vtkFloatArray>(name, vectors, 3, unit);
  array->SetComponentName(0, "u");
  array->SetComponentName(1, "v");
  array->SetComponentName(2, "w");
  return array;
}

void addWithUnit(vtkImageData* output, const char* name, double value, const char* unit)
{
  addFieldValue<vtkDoubleArray>(output, name, value);
  setUnit(output->GetFieldData()->GetArray(name), unit);
}

/// Adds what is known of waves, where LightModel is not Rays.
void addWaves(vtkImageData* output, const schlieren::Image& image)
{
  const std::string words = wavesInWords(image);
  if (words.empty())
  {
    return;
  }
  const schlieren::WaveReport& waves = image.waves;
  addFieldValue<vtkStringArray>(output, "WavesMatter", words);
  addWithUnit(output, "FresnelWidth", waves.fresnelWidth, "m");
  addWithUnit(output, "WavePlane", waves.plane, "m");
  addFieldValue<vtkDoubleArray>(output, "LeastTubeRatio", waves.leastTubeRatio);
  addFieldValue<vtkTypeInt64Array>(output, "PointsPerPixel", waves.pointsPerPixel);
  addFieldValues<vtkTypeInt64Array>(
    output, "WavePoints", std::array<std::int64_t, 2>{ waves.columns, waves.rows });
}

/// Places an image in the plane z = 0. Resets the direction, which VTK copies since 9.3.
void place(vtkImageData* output, double x, double y, double spacing)
{
  output->SetOrigin(x, y, 0);
  output->SetSpacing(spacing, spacing, spacing);
  output->SetDirectionMatrix(1, 0, 0, 0, 1, 0, 0, 0, 1);
}

/// Applies the sRGB curve, IEC 61966-2-1.
float srgbFromLinear(float light)
{
  return light <= 0.0031308f ? 12.92f * light : 1.055f * std::pow(light, 1 / 2.4f) - 0.055f;
}

} // namespace

double largestLength(const schlieren::PixelArray<float>& pairs)
{
  double largestSquare = 0;
  for (std::size_t i = 0; i + 1 < pairs.size(); i += 2)
  {
    const double u = pairs[i], v = pairs[i + 1];
    largestSquare = std::max(largestSquare, u * u + v * v);
  }
  return std::sqrt(largestSquare);
}

void setOutput(vtkImageData* output, schlieren::Image& image)
{
  output->SetExtent(0, image.width - 1, 0, image.height - 1, 0, 0);
  place(output, image.frame.origin[0], image.frame.origin[1], image.frame.pixelSize);
  addFieldValues<vtkDoubleArray>(output, "AxisRight", image.frame.u);
  addFieldValues<vtkDoubleArray>(output, "AxisUp", image.frame.v);

  vtkPointData* arrays = output->GetPointData();
  arrays->SetScalars(newArray<vtkFloatArray>("Intensity", image.intensity, 1, "1"));
  arrays->AddArray(newVectors("Deflection", image.deflection, "rad"));
  arrays->AddArray(
    newArray<vtkDoubleArray>("OpticalPathDifference", image.opticalPathDifference, 1, "m"));
  arrays->AddArray(newVectors("Displacement", image.displacement, dataUnits));
  arrays->AddArray(newArray<vtkFloatArray>("BlockedFraction", image.blockedFraction, 1, "1"));
  if (!image.background.empty())
  {
    arrays->AddArray(newArray<vtkFloatArray>("Background", image.background, 1, "1"));
  }
  if (!image.backgroundDisplacement.empty())
  {
    arrays->AddArray(newVectors("BackgroundDisplacement", image.backgroundDisplacement, dataUnits));
    addWithUnit(output, "PatternPixel", image.patternPixel, dataUnits);
  }

  addFieldValue<vtkStringArray>(output, "SchlierenVersion", schlieren::version());
  addFieldValue<vtkStringArray>(
    output, "Device", image.device == schlieren::Device::Cuda ? "CUDA" : "CPU");
  addFieldValue<vtkStringArray>(output, "PathModel",
    image.pathModel == schlieren::PathModel::Straight ? "Straight" : "Refracted");
  addFieldValue<vtkDoubleArray>(output, "KScale", image.kScale);
  addFieldValue<vtkDoubleArray>(output, "ScreenDistance", image.screenDistance);
  addFieldValue<vtkDoubleArray>(output, "UndisturbedLevel", image.undisturbedLevel);
  addFieldValue<vtkDoubleArray>(output, "SaturatedShare", image.saturatedFraction);
  addFieldValue<vtkDoubleArray>(output, "LightEmitted", image.light.emitted);
  addFieldValue<vtkDoubleArray>(output, "LightOnFilm", image.light.onFilm);
  addFieldValue<vtkDoubleArray>(output, "LightOutside", image.light.outside);
  addFieldValue<vtkDoubleArray>(output, "AmbientRefractivity", image.ambient);
  addFieldValue<vtkDoubleArray>(output, "ExitRefractivity", image.exitRefractivity);
  addFieldValue<vtkTypeInt64Array>(output, "RaysTraced", image.raysTraced);
  addFieldValue<vtkTypeInt64Array>(output, "RaysLost", image.raysLost);
  addFieldValue<vtkTypeInt64Array>(output, "StepsTaken", image.stepsTaken);
  addWithUnit(output, "TraceSeconds", image.traceSeconds, "s");
  addFieldValue<vtkDoubleArray>(output, "MomentumDrift", image.momentumDrift);
  addWaves(output, image);
  if (image.accuracy.target > 0)
  {
    addFieldValue<vtkDoubleArray>(output, "TargetError", image.accuracy.target);
    addFieldValue<vtkDoubleArray>(output, "ErrorReached", image.accuracy.reached);
    addFieldValue<vtkDoubleArray>(output, "ErrorLargest", image.accuracy.largest);
    addFieldValue<vtkStringArray>(output, "ErrorLimit", limitInWords(image.accuracy));
    addFieldValue<vtkDoubleArray>(output, "StepSize", image.stepSize);
    addFieldValue<vtkIntArray>(output, "SamplesPerPixel", image.samplesPerPixel);
  }
}

unsigned char byteOf(float light, ColorScale scale)
{
  const float white = scale == ColorScale::LinearToTwice ? 2 : 1;
  const float fraction = std::clamp(light / white, 0.f, 1.f);
  return static_cast<unsigned char>(
    (scale == ColorScale::Srgb ? srgbFromLinear(fraction) : fraction) * 255.f + 0.5f);
}

void addColor(vtkImageData* output, const schlieren::Image& image)
{
  vtkNew<vtkUnsignedCharArray> array;
  array->SetName("Color");
  array->SetNumberOfComponents(3);
  setTuples(array, static_cast<vtkIdType>(image.color.size()) / 3);
  std::transform(image.color.begin(), image.color.end(), array->GetPointer(0),
    [](float light) { return byteOf(light, ColorScale::Srgb); });
  output->GetPointData()->AddArray(array); // SetScalars would remove the intensity
  output->GetPointData()->SetActiveScalars("Color");
}

void addFringes(vtkImageData* output, const schlieren::Scene& scene)
{
  addWithUnit(output, "Wavelength", scene.wavelength, "m");
  if (scene.fringes.finite)
  {
    addWithUnit(output, "FringeSpacing", scene.fringes.spacing, dataUnits);
    addWithUnit(output, "FringeAngle", scene.fringes.angle, "degrees");
  }
}

void addMedium(vtkImageData* output, const schlieren::MediumStatistics& medium)
{
  addFieldValues<vtkIntArray>(
    output, "MediumLevels", std::array<int, 2>{ medium.coarsestLevel, medium.finestLevel });
  addFieldValue<vtkTypeInt64Array>(
    output, "MediumBricks", static_cast<vtkTypeInt64>(medium.bricks));
  addFieldValue<vtkTypeInt64Array>(
    output, "MediumVoxels", static_cast<vtkTypeInt64>(medium.voxels));
  addFieldValue<vtkTypeInt64Array>(output, "MediumBytes", static_cast<vtkTypeInt64>(medium.bytes));
  addFieldValue<vtkDoubleArray>(output, "SmallestVoxel", medium.smallestVoxel);
}

std::string mediumInWords(const schlieren::MediumStatistics& medium)
{
  std::ostringstream text;
  text.precision(2);
  text << medium.bricks << " bricks on levels " << medium.coarsestLevel << " to "
       << medium.finestLevel << ", " << 1e-6 * static_cast<double>(medium.voxels)
       << " million voxels of " << medium.smallestVoxel << " and more, "
       << std::lround(1e-6 * static_cast<double>(medium.bytes)) << " MB"
       << (medium.isMemoryShort ? ", coarser than MediumTolerance, for lack of MediumMemory" : "");
  return text.str();
}

void addGrid(vtkImageData* output, const char* grid)
{
  addFieldValue<vtkStringArray>(output, "Grid", std::string(grid));
}

void setHistogram(vtkImageData* output, const schlieren::Histogram& histogram)
{
  if (histogram.rays.empty())
  {
    return;
  }
  const double width = 2 * histogram.range / histogram.size;
  const double first = -histogram.range + width / 2;
  output->SetDimensions(histogram.size, histogram.size, 1);
  place(output, first, first, width);
  vtkNew<vtkTypeInt64Array> rays;
  rays->SetName("Rays");
  rays->SetNumberOfValues(static_cast<vtkIdType>(histogram.rays.size()));
  std::copy(histogram.rays.begin(), histogram.rays.end(), rays->GetPointer(0));
  setUnit(rays, "1");
  output->GetPointData()->SetScalars(rays);
}

} // namespace filters
