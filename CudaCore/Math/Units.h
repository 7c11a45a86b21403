// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace schlieren
{

constexpr double pi = 3.14159265358979323846;
constexpr double radiansPerDegree = pi / 180;

} // namespace schlieren
