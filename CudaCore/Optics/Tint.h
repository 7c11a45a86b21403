// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Rays/TracedRays.h"

#include <array>
#include <cstddef>
#include <vector>

namespace schlieren
{

/// The colour that a ray takes on (after Brownlee et al. 2011, sec. 8): white, plus as much of the mean
/// of the fields' colours, weighted by what the ray has gathered of each field's gradient, as all of it
/// together is of `reference`: 1 + min(1, G / reference) (sum g_i c_i / G - 1), where G = sum g_i.
struct Tint
{
  std::vector<std::array<float, 3>> colors; ///< red, green, blue of each field, 0...1
  double reference;                         ///< gathered by a ray of full colour; 0: no ray has any

  std::array<double, 3> of(const float* gathered) const;
};

/// What 99 % of the rays that crossed the medium within the image do not exceed; or, where less than
/// a hundredth of them has gathered anything, the most; 0 where none has.
double tintReference(
  const TracedRays& rays, std::size_t fields, int width, int height, int threads);

} // namespace schlieren
