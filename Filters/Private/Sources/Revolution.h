// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Input/Flow.h"

#include "Schlieren.h"

#include <array>
#include <string>

/// Plane sections of axisymmetric flows.
namespace filters
{

/// The position of a plane relative to its axis of symmetry, with coordinate axes by number.
struct Revolution
{
  int axis, radial, flat;       // along the axis, along the radius, across the plane
  std::array<double, 3> origin; // a point of the axis
  double low, high;             // of the data, along the axis
  double radius;                // maximum of the data
  double tolerance;             // distance of points from the axis that count as on it
  bool isMirrored;              // whether the data are on one side of the axis
  std::string note;             // for the user

  schlieren::Box box() const;
};

/// Returns the chosen or best axis. Throws for data that are not flat or have no such axis.
Revolution revolutionOf(const Flow& flow);

} // namespace filters
