// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// What a comparison has found, in words.
#pragma once

#include "Photograph/Compared.h"

namespace filters
{

/// Fills the sentences and notes of a comparison from its numbers. `isFitted`: whether there was light to be fitted to.
void describe(
  Compared& result, const Grid& image, const PhotographSettings& settings, bool isFitted);

} // namespace filters
