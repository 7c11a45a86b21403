// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Types.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>

namespace schlieren
{

class MediumSource;

/// Marks in Field::valid what has no data but lets light pass.
constexpr unsigned char transparent = 2;

/// Refractivity N = n - 1. On a grid, x fastest: the arrays belong to the caller and are read during Bench::render
/// only; exactly one of the two sample pointers is set. Or of a source, which is queried as finely as the view and
/// Scene::mediumTolerance want it: then `grid` is coarsestGrid() of the source, and there are no arrays.
struct Field
{
  Grid grid;
  std::shared_ptr<const MediumSource> source;
  const float* singles = nullptr;
  const double* doubles = nullptr;
  /// Offset of the samples, which hold N less this. Near the surroundings' N it leaves single precision the digits of a
  /// weak flow. Not of a source.
  double offset = 0;
  /// 0: solid, blocks light. 1: gas (solid where the sample is not finite). 2 (transparent): no data, but
  /// light passes; the sample is not read, the gas around is continued. Null: 1 everywhere.
  const unsigned char* valid = nullptr;
  std::optional<double> ambient; ///< N outside; unset: see ambientOf(), at the domain's boundary
  double lengthScale = 1;        ///< metres per data unit
  /// Changes whenever anything that the arrays hold has changed: the same version, the same data.
  std::uint64_t version = 0;
};

/// Refuses a grid that no light can cross. Throws Error.
void validate(const Grid& grid);

/// Refuses a refractivity that no transparent medium has, or none at all (`lowest` > `highest`). Throws Error.
void validateAmbient(double ambient);
void validateRange(double lowest, double highest);

} // namespace schlieren
