// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

/// What this process does where there may be several: the first one makes what there is one of, from all
/// that its source gives when asked for everything (see requestWhole); the others leave it empty.
enum class ProcessRole
{
  Alone,
  First,
  Other
};

ProcessRole roleOfProcess();

/// What the user should know once where this is the first of several processes, which make `product`.
std::string warningOfFirstProcess(const std::string& product);
