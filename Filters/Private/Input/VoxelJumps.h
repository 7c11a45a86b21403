// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Common/Leaf.h"
#include "Gas/RefractivityModels.h"

#include <array>
#include <vector>

namespace filters
{

/// Returns by how much n jumps, as at glass, in images whose samples are all near one end of their range or the other, and
/// which have faces across several axes; else 0.
double jumpOfVoxels(
  const std::vector<Leaf>& leaves, const Model& model, const std::array<double, 2>& range);

} // namespace filters
