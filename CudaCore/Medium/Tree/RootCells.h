// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Medium/Samples/MediumSource.h"
#include "Types.h"

#include <array>
#include <cstdint>

namespace schlieren
{

/// Divides the domain into nodes of level 0.
struct Division
{
  std::array<std::int32_t, 3> cells; ///< one along z where nothing depends on it
  int coarserLevels; ///< of roots, each of which has 2^coarserLevels of them along each axis
};

/// Divides the bounds of a source. Of data much longer than wide most may be empty (blocks far from each other), which
/// larger nodes hold. Throws Error where the bounds have no extent along an axis.
Division divisionOf(const MediumSource& source);

/// The root cells along each axis.
std::array<std::int32_t, 3> rootCellsOf(const Division& division);

/// The grid of level 0 in the source's own axes. Where nothing depends on z, two points, the depth apart, represent it.
/// Throws Error.
Grid gridOf(const MediumSource& source);

/// The grid that a source is divided into at first: it covers its bounds. Throws Error where these have no extent.
Grid coarsestGrid(const MediumSource& source);

} // namespace schlieren
