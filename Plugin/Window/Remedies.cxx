// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Remedies.h"

#include "FlowArrays.h"
#include "FlowOfPort.h"
#include "InputOfFilter.h"

#include "vtkSchlierenFilter.h"

#include <cmath>

namespace
{

using Filter = vtkSchlierenFilter;

double numberOf(vtkSMProxy* filter, const char* property)
{
  return vtkSMPropertyHelper(filter, property).GetAsDouble();
}

Remedy water() { return { inWords(Completion::Water), { { "IndexModel", Filter::WATER } } }; }

/// Returns whether a density is that of a liquid.
bool isLiquid(vtkSMProxy* filter, const std::vector<FlowArray>& arrays)
{
  const std::string chosen = vtkSMPropertyHelper(filter, "Density").GetInputArrayNameToProcess();
  const std::string density = chosen.empty() ? flowDefaults(arrays).arrayOf("Density") : chosen;
  const auto found = std::find_if(
    arrays.begin(), arrays.end(), [&](const FlowArray& array) { return array.name == density; });
  if (found == arrays.end())
  {
    return false;
  }
  FlowInUse use;
  use.arrays = { *found };
  const double given = numberOf(filter, "DensityScale");
  const double unit = scaleByUnit("Density", density);
  use.scales = { given > 0 ? given : unit > 0 ? unit : 1 };
  return implausible(use).kind == "dense";
}

/// Returns whether data in a plane lie on one side of a coordinate axis that they touch.
bool isBesideAxis(vtkPVDataInformation* data)
{
  constexpr double tolerance = 1e-6; // of the size, as of the filter
  const std::array<double, 3> sides = sidesOf(data);
  const double size = *std::max_element(sides.begin(), sides.end());
  const auto isFlat = [&](double side) { return side <= tolerance * size; };
  if (std::count_if(sides.begin(), sides.end(), isFlat) != 1)
  {
    return false;
  }
  const double* bounds = data->GetBounds();
  for (int axis = 0; axis < 3; ++axis)
  {
    const double nearest = std::min(std::abs(bounds[2 * axis]), std::abs(bounds[2 * axis + 1]));
    if (!isFlat(sides[axis]) && isFlat(nearest))
    {
      return true;
    }
  }
  return false;
}

} // namespace

QVector<Remedy> remediesFor(vtkSMProxy* filter)
{
  vtkPVDataInformation* data = inputOf(filter);
  if (!data)
  {
    return {};
  }
  const std::vector<FlowArray> arrays = arraysOf(data);
  const double model = numberOf(filter, "IndexModel");
  const bool isByName = model == MediumSettings::AUTO && flowDefaults(arrays).arrays.empty() &&
    *vtkSMPropertyHelper(filter, "Density").GetInputArrayNameToProcess() == '\0';
  if (isByName && !(numberOf(filter, "UniformPressure") > 0))
  {
    return offerFor(arrays).kind == Completion::UniformPressure
      ? QVector<Remedy>{ { inWords(Completion::UniformPressure),
                           { { "UniformPressure", pressureOfRoom } } },
          water() }
      : QVector<Remedy>();
  }
  QVector<Remedy> remedies;
  if ((model == MediumSettings::AUTO || model == MediumSettings::GLADSTONE_DALE) &&
    !completed(arrays, { Completion::Water }).arrays.empty() && isLiquid(filter, arrays))
  {
    remedies << water();
  }
  if (numberOf(filter, "Symmetry") == Filter::SYMMETRY_AUTO && !(numberOf(filter, "Depth") > 0) &&
    isBesideAxis(data))
  {
    remedies << Remedy{ "Revolve it", { { "Symmetry", Filter::SYMMETRY_AXISYMMETRIC } } };
  }
  return remedies;
}
