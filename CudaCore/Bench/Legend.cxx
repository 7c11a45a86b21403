// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Bench/CutoffMaker.h"
#include "Schlieren.h"

#include <array>
#include <cstddef>
#include <type_traits>
#include <variant>

namespace schlieren
{

namespace
{

constexpr int valuesOfScale = 256;
constexpr int valuesOfPlane = 65; // the middle is one of them

/// The range and the number of values that a scene's light is to be shown for.
Legend emptyLegendOf(const Scene& scene, double k)
{
  const Technique& technique = techniqueOf(scene.cutoff);
  Legend legend;
  legend.width = valuesOfScale;
  legend.height = 1;
  const auto range = [&](Legend::Quantity quantity, double lowest, double highest)
  {
    legend.quantity = quantity;
    legend.lowest = lowest;
    legend.highest = highest;
  };
  if (technique.hasEdge)
  {
    range(
      Legend::Quantity::Deflection, (scene.cutoffOffset - 0.5) / k, (scene.cutoffOffset + 0.5) / k);
  }
  else if (technique.coloring == Coloring::Always)
  {
    range(Legend::Quantity::DeflectionPlane, -1 / k, 1 / k);
    legend.width = legend.height = valuesOfPlane;
  }
  else if (technique.hasK())
  {
    range(Legend::Quantity::DeflectionSize, 0, 1 / k);
  }
  else if (technique.hasFringes)
  {
    range(Legend::Quantity::Path, -scene.wavelength, scene.wavelength);
  }
  else if (technique.plane != RecordedPlane::Background)
  {
    range(Legend::Quantity::Light, 0, 2);
  }
  return legend;
}

double valueAt(const Legend& legend, int place, int count)
{
  return legend.lowest + (place + 0.5) / count * (legend.highest - legend.lowest);
}

/// The ray that a value stands for.
RayAtFilm rayOf(const Legend& legend, double angle, int column, int row)
{
  RayAtFilm ray{ { 0, 0 }, 0, { 0, 0 }, { 0, 0 } };
  const double value = valueAt(legend, column, legend.width);
  switch (legend.quantity)
  {
    case Legend::Quantity::Deflection:
    {
      const CutoffAxis axis = CutoffAxis::at(angle, 1, 0);
      ray.deflection[0] = value * axis.normal[0];
      ray.deflection[1] = value * axis.normal[1];
      break;
    }
    case Legend::Quantity::DeflectionPlane:
      ray.deflection[1] = valueAt(legend, row, legend.height);
      ray.deflection[0] = value;
      break;
    case Legend::Quantity::DeflectionSize:
      ray.deflection[0] = value;
      break;
    case Legend::Quantity::Path:
      ray.path = value;
      break;
    case Legend::Quantity::Light:
    case Legend::Quantity::None:
      break;
  }
  return ray;
}

std::array<float, 3> grey(double light)
{
  const auto value = static_cast<float>(light);
  return { value, value, value };
}

std::array<float, 3> lightOf(const Cutoffs& cutoff, const RayAtFilm& ray)
{
  return std::visit(
    [&](const auto& kind)
    {
      constexpr int channels = std::decay_t<decltype(kind)>::channels;
      double light[channels];
      kind.shade(ray, light);
      return channels == 3 ? std::array<float, 3>{ static_cast<float>(light[0]),
        static_cast<float>(light[channels / 2]), static_cast<float>(light[channels - 1]) }
                           : grey(light[0]);
    },
    cutoff);
}

} // namespace

Legend legendOf(const Scene& scene, double k)
{
  const bool hasNoScale = techniqueOf(scene.cutoff).hasK() && !(k > 0);
  Legend legend = hasNoScale ? Legend{} : emptyLegendOf(scene, k);
  if (legend.quantity == Legend::Quantity::None)
  {
    return {};
  }
  Scene undisturbed = scene;
  undisturbed.fringes.finite = false;
  CutoffMaker maker;
  const Cutoffs cutoff = maker.cutoffOf(undisturbed, k, { 1 });
  legend.light.reserve(3 * static_cast<std::size_t>(legend.width) * legend.height);
  for (int row = 0; row < legend.height; ++row)
  {
    for (int column = 0; column < legend.width; ++column)
    {
      const auto light = legend.quantity == Legend::Quantity::Light
        ? grey(valueAt(legend, column, legend.width))
        : lightOf(cutoff, rayOf(legend, scene.knifeEdgeAngle, column, row));
      legend.light.insert(legend.light.end(), light.begin(), light.end());
    }
  }
  return legend;
}

} // namespace schlieren
