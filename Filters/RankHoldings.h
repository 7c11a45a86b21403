// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <vector>

class vtkDataObject;

namespace filters
{

namespace ranks
{

/// What a rank has of an input: numbers of points and cells, bounds, and a number that is the same only if the meshes are.
using Holdings = std::array<double, 9>;
Holdings holdingsOf(vtkDataObject* input); // may be null

/// The ranks that have data which rank 0 and those before them have not.
std::vector<std::size_t> ranksWithMore(const std::vector<Holdings>& ofRanks);

} // namespace ranks

} // namespace filters
