// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Schlieren.h"

namespace schlieren
{

const char* version() { return SCHLIEREN_VERSION; }

} // namespace schlieren
