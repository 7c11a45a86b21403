// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

namespace schlieren
{

/// A difference between two images at a pixel whose light has crossed the data, in the unit of Scene::targetError.
struct Difference
{
  double value;
  double pixels; ///< of the whole image that it stands for
};
using Differences = std::vector<Difference>;

/// What 99 % of the pixels keep may be exceeded in this part of them.
constexpr double mayExceed = 0.01;
/// The value that no more than a part of the pixels exceeds; 0 if there are none.
double exceededBy(double part, Differences differences);
double largestOf(const Differences& differences);

} // namespace schlieren
