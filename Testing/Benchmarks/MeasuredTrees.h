// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Trees that rays are measured in, and where from.
#pragma once

#include "AnalyticSources.h"
#include "Medium/Medium.h"

#include <cmath>
#include <memory>

namespace schlieren
{

/// Varies everywhere, smoothly.
class WavesSource : public AnalyticSource
{
public:
  double refractivity(double x, double y, double z) const override
  {
    return 1e-4 * (1 + 0.3 * std::sin(3 * x + y) * std::cos(4 * y - 2 * z) + 0.1 * std::sin(5 * z));
  }
  Range rangeOver(const Box&) const override { return { 5e-5, 1.5e-4 }; }
  double cellSizeOver(const Box&) const override { return 1. / 1024; }
};

struct Direction
{
  const char* name;
  Vector view;
};
inline constexpr Direction directions[] = { { "along z", { 0, 0, -1 } },
  { "along x", { -1, 0, 0 } }, { "oblique", { -0.8, 0.3, -0.6 } }, { "diagonal", { -1, -1, -1 } } };

inline Medium<float> treeOf(
  const std::shared_ptr<const AnalyticSource>& source, double tolerance, const Column& column)
{
  Field field;
  field.source = source;
  field.grid = coarsestGrid(*source);
  TreeSettings settings;
  settings.tolerance = tolerance;
  Medium<float> medium = buildTree<float>(field, settings);
  refine(medium, column, {});
  return medium;
}

} // namespace schlieren
