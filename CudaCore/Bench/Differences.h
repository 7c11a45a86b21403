// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

namespace schlieren
{

/// A difference between two images at a pixel whose light has crossed the data, in the unit of Scene::targetError.
struct Difference
{
  double value;
  double pixels;         ///< of the whole image that it stands for
  std::size_t pixel = 0; ///< of its patch
};
using Differences = std::vector<Difference>;

/// The value that 99 % of the pixels do not exceed; 0 if there are none.
double percentile99(Differences differences);
double largestOf(const Differences& differences);

} // namespace schlieren
