// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Film/Exposure.h"
#include "Film/RowShader.h"

#include <cstdint>
#include <vector>

namespace schlieren
{

/// Adds to the films the light of the cells whose lower rays start in rows `begin` ... `end` - 1 of those that the shader
/// knows. Several threads may do so at once.
template <int planes>
RayCounts depositRows(std::int64_t begin, std::int64_t end, const std::vector<TracedRays>& passes,
  const RowShader<planes>& shader, Films& films);

} // namespace schlieren
