// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Schlieren.h"

namespace schlieren
{

/// Throws Error where an image of the field cannot be made, before anything is built or traced.
void validate(const Field& field, const Scene& scene);

} // namespace schlieren
