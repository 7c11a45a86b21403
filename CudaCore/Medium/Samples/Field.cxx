// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Medium/Samples/Field.h"

#include "Math/NumberText.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <string>

namespace schlieren
{

namespace
{

/// No transparent matter has an index near this; a larger |N| is a wrong array, unit or model.
constexpr double largestPlausibleN = 10;

} // namespace

void validateAmbient(double ambient)
{
  if (!(ambient > -1 && ambient <= largestPlausibleN))
  {
    throw Error("The ambient refractivity " + textOf(ambient) +
      " is that of no transparent medium (-1 < n - 1 <= 10 is accepted). Give n - 1 of the gas "
      "around the flow (air: 2.7e-4), or let it be found from the domain's boundary.");
  }
}

void validateRange(double lowest, double highest)
{
  if (!(lowest <= highest))
  {
    throw Error(
      "The refractivity is invalid everywhere (NaN, infinite or masked), so there is no gas "
      "for light to cross. Choose another array or check the data.");
  }
  if (std::max(std::abs(lowest), std::abs(highest)) > largestPlausibleN || lowest <= -1)
  {
    throw Error("The refractivity n - 1 reaches from " + textOf(lowest) + " to " + textOf(highest) +
      ", which no transparent medium has (-1 < n - 1 <= 10 is accepted). Check the index model, "
      "the "
      "chosen array and its unit (density in kg/m^3; use the density scale to convert).");
  }
}

namespace
{

/// Throws where places along an axis cannot be distinguished, or are beyond the floats that displacements are.
void validatePlaces(const Grid& grid, std::size_t axis)
{
  constexpr double largest = 1e30;
  const double spacing = grid.spacing[axis];
  const double size = spacing * static_cast<double>(grid.dimensions[axis] - 1);
  const double farthest = std::max(std::abs(grid.origin[axis]), std::abs(grid.origin[axis] + size));
  std::ostringstream text;
  if (!(size >= 1 / largest && size <= largest))
  {
    text << "The data are " << size << " long along their "
         << "xyz"[axis]
         << " axis; between 1e-30 and 1e30 is possible. Scale them with Transform, and set "
            "LengthScale.";
    throw Error(text.str());
  }
  constexpr double largestRounding = 0.05; // of a spacing
  const double rounding = std::numeric_limits<double>::epsilon() * farthest;
  if (rounding > largestRounding * spacing)
  {
    text << "The data lie up to " << farthest << " from the origin along their "
         << "xyz"[axis] << " axis, where numbers are rounded by " << rounding
         << ", but their points are only " << spacing
         << " apart. Move them to the origin with Transform.";
    throw Error(text.str());
  }
}

/// Throws where light would cross more points of one axis within a spacing of another than rays can count.
void validateShape(const Grid& grid)
{
  constexpr double most = 1e12;
  const auto finest = static_cast<std::size_t>(
    std::min_element(grid.spacing.begin(), grid.spacing.end()) - grid.spacing.begin());
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double length = grid.spacing[axis] * static_cast<double>(grid.dimensions[axis] - 1);
    if (length > most * grid.spacing[finest])
    {
      std::ostringstream text;
      text << "The data are " << length << " long along their "
           << "xyz"[axis] << " axis, but their points are only " << grid.spacing[finest]
           << " apart along "
           << "xyz"[finest]
           << ". Check the points' coordinates; of data that are flat in truth, take a Slice.";
      throw Error(text.str());
    }
  }
}

} // namespace

void validate(const Grid& grid)
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const std::string name(1, "xyz"[axis]);
    if (grid.dimensions[axis] < 2)
    {
      throw Error("The grid has " + std::to_string(grid.dimensions[axis]) + " point(s) along its " +
        name +
        " axis, so there is no depth for light to cross and no gradient to bend it. Give it at "
        "least 2 points (for 2-D data: extrude it).");
    }
    if (grid.dimensions[axis] > std::numeric_limits<std::int32_t>::max() / 2)
    {
      throw Error("The grid has more than 2^30 points along its " + name +
        " axis. Resample it to a coarser grid.");
    }
    if (!(grid.spacing[axis] > 0) || !std::isfinite(grid.spacing[axis]))
    {
      throw Error("The grid's spacing along its " + name + " axis is " +
        textOf(grid.spacing[axis]) + "; it must be positive and finite. Check the data's spacing.");
    }
    if (!std::isfinite(grid.origin[axis]))
    {
      throw Error("The grid's origin is not finite. Check the data's origin.");
    }
    validatePlaces(grid, axis);
  }
  validateShape(grid);
  const std::array<double, 9>& d = grid.direction;
  for (std::size_t a = 0; a < 3; ++a)
  {
    for (std::size_t b = a; b < 3; ++b)
    {
      const double product = d[a] * d[b] + d[3 + a] * d[3 + b] + d[6 + a] * d[6 + b];
      if (!(std::abs(product - (a == b ? 1 : 0)) < 1e-6))
      {
        throw Error(
          "The grid's direction matrix is no rotation: its columns must be unit vectors at "
          "right angles. Resample the data to a grid whose axes are.");
      }
    }
  }
}

} // namespace schlieren
