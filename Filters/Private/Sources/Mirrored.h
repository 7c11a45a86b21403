// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Sources/Revolution.h"

namespace filters
{

/// Adds the other side of the axis to data on one side.
Flow mirrored(const Flow& flow, const Revolution& revolution);

} // namespace filters
