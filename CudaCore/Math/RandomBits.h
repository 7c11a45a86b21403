// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Math/HostDevice.h"

#include <cstdint>

namespace schlieren
{

/// Random bits that follow from others: the mixing of splitmix64 (Steele, Lea & Flood 2014).
SCHLIEREN_HD std::uint64_t mixed(std::uint64_t bits)
{
  bits += 0x9e3779b97f4a7c15u;
  bits = (bits ^ (bits >> 30)) * 0xbf58476d1ce4e5b9u;
  bits = (bits ^ (bits >> 27)) * 0x94d049bb133111ebu;
  return bits ^ (bits >> 31);
}

} // namespace schlieren
