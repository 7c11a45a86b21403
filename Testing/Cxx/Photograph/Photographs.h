// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Photographs of a bench as a camera makes them of light that is known: with all that a comparison does not model.
#pragma once

#include "Fixtures.h"

#include "Photograph/Placing.h"
#include "Photograph/Plane.h"

#include "vtkDoubleArray.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnsignedShortArray.h"
#include "vtkXMLImageDataReader.h"

#include <random>

namespace photographs
{

using filters::Grid;
using filters::Place;
using filters::Plane;

constexpr int columns = 200, rows = 150;
constexpr double halfHeight = 0.01125; // m
constexpr double pixel = 2 * halfHeight / rows;

/// The bench before the jet of Ladenburg's experiment; the edge lies across the flow.
inline vtkSmartPointer<vtkSchlierenFilter> jetBench(double finer = 1)
{
  vtkNew<vtkXMLImageDataReader> reader;
  reader->SetFileName(SCHLIEREN_TEST_DATA "/ladenburg_jet_3d.vti");
  reader->Update();
  auto filter = vtkSmartPointer<vtkSchlierenFilter>::New();
  filter->SetInputDataObject(reader->GetOutput());
  filter->SetInputArrayToProcess(
    vtkRefractiveIndex::DENSITY, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "rho");
  filter->SetFocalPoint(0.015, 0, 0);
  filter->SetParallelScale(halfHeight);
  filter->SetImageSize(static_cast<int>(columns * finer), static_cast<int>(rows * finer));
  filter->SetKnifeEdgeAngle(90);
  return filter;
}

inline Plane planeOf(vtkAlgorithm* filter, const char* name, int component = 0)
{
  auto* image = vtkImageData::SafeDownCast(filter->GetOutputDataObject(0));
  Plane plane(image->GetDimensions()[0], image->GetDimensions()[1]);
  vtkDataArray* array = image->GetPointData()->GetArray(name);
  EXPECT_NE(array, nullptr) << name;
  for (std::size_t i = 0; array && i < plane.size(); ++i)
  {
    plane.values[i] = static_cast<float>(array->GetComponent(static_cast<vtkIdType>(i), component));
  }
  return plane;
}

/// What a camera makes of light.
struct Film
{
  double gamma = 0.45; // value = black + (1 - black) light^gamma
  double black = 0.03;
  double exposure = 0.92;
  double striae = 0.03;
  int dust = 10;
  double vignette = 0.35;
  double blur = 0.5;                      // pixels
  double fullWell = 12000, readNoise = 0; // electrons
  int bits = 8;
  double mirror = 0.47; // radius, in parts of the width
  int width = columns, height = rows;
};

constexpr double mirrorX = 2.5, mirrorY = 1.25; // of its middle, pixels from the photograph's

/// The photograph with flow and without; its mirror.
struct Taken
{
  vtkSmartPointer<vtkImageData> withFlow, withoutFlow;
};

/// Takes both photographs of light on a grid in the image's coordinates, of which `undisturbed` is that without flow.
inline Taken take(const Plane& light, const Grid& ofLight, const Place& place, double undisturbed,
  const Film& film = {})
{
  std::mt19937 random(1);
  std::normal_distribution<float> normal;
  std::uniform_real_distribution<double> uniform;
  const int w = film.width, h = film.height;
  const auto noise = [&](double sigma)
  {
    Plane plane(w, h);
    std::generate(plane.values.begin(), plane.values.end(), [&] { return normal(random); });
    plane = filters::blurred(plane, sigma);
    double squares = 0;
    for (const float value : plane.values)
    {
      squares += value * value;
    }
    const auto scale = static_cast<float>(std::sqrt(static_cast<double>(plane.size()) / squares));
    for (float& value : plane.values)
    {
      value *= scale;
    }
    return plane;
  };
  const Plane wide = noise(0.03 * w), narrow = noise(0.0075 * w);
  Plane brightness(w, h), seen(w, h);
  const filters::Lookup lightAt(light);
  const auto inLight = [&](double x, int axis)
  {
    const auto a = static_cast<std::size_t>(axis);
    return (x - ofLight.origin[a]) / ofLight.spacing[a];
  };
  for (int row = 0; row < h; ++row)
  {
    for (int column = 0; column < w; ++column)
    {
      const double x = column - 0.5 * (w - 1), y = row - 0.5 * (h - 1);
      const double r = std::hypot(x - mirrorX, y - mirrorY);
      const double inside = 1 / (1 + std::exp((r - film.mirror * w) / (0.002 * w)));
      const double middle = (x - 30) * (x - 30) + (y + 20) * (y + 20);
      brightness(column, row) =
        static_cast<float>(inside * (1 - film.vignette * middle / (0.25 * w * w)) *
          (1 + film.striae * (wide(column, row) + 0.5 * narrow(column, row))));
      const auto at = place.inImage({ static_cast<double>(column), static_cast<double>(row) });
      seen(column, row) =
        lightAt(inLight(at[0], 0), inLight(at[1], 1), static_cast<float>(undisturbed));
    }
  }
  for (int grain = 0; grain < film.dust; ++grain)
  {
    const double x = uniform(random) * w, y = uniform(random) * h;
    const double size = 0.5 + 2 * uniform(random), depth = 0.1 + 0.5 * uniform(random);
    for (int row = 0; row < h; ++row)
    {
      for (int column = 0; column < w; ++column)
      {
        const double square = (column - x) * (column - x) + (row - y) * (row - y);
        brightness(column, row) *=
          static_cast<float>(1 - depth * std::exp(-square / (2 * size * size)));
      }
    }
  }
  const auto expose = [&](const std::function<double(std::size_t)>& lightOf)
  {
    Plane exposed(w, h);
    for (std::size_t i = 0; i < exposed.size(); ++i)
    {
      exposed.values[i] = static_cast<float>(film.exposure * brightness.values[i] * lightOf(i));
    }
    exposed = film.blur > 0 ? filters::blurred(exposed, film.blur) : exposed;
    auto image = vtkSmartPointer<vtkImageData>::New();
    image->SetDimensions(w, h, 1);
    vtkSmartPointer<vtkDataArray> array;
    if (film.bits > 8)
    {
      array = vtkSmartPointer<vtkUnsignedShortArray>::New();
    }
    else
    {
      array = vtkSmartPointer<vtkUnsignedCharArray>::New();
    }
    array->SetNumberOfTuples(w * vtkIdType{ h });
    const double white = std::exp2(film.bits) - 1;
    for (std::size_t i = 0; i < exposed.size(); ++i)
    {
      const double electrons = std::max(0.f, exposed.values[i]) * film.fullWell;
      const double counted =
        electrons + std::sqrt(electrons) * normal(random) + film.readNoise * normal(random);
      const double value = film.black +
        (1 - film.black) * std::pow(std::clamp(counted / film.fullWell, 0., 1.), film.gamma);
      array->SetTuple1(static_cast<vtkIdType>(i), std::round(std::clamp(value, 0., 1.) * white));
    }
    image->GetPointData()->SetScalars(array);
    return image;
  };
  return { expose([&](std::size_t i) { return seen.values[i]; }),
    expose([&](std::size_t) { return undisturbed; }) };
}

} // namespace photographs
