// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace schlieren
{

/// The cores that a Linux control group may use, by what its file cpu.max says ("<quota> <period>", or "max
/// <period>"), or cpu.cfs_quota_us (-1: no limit) and cpu.cfs_period_us one after the other. Infinite where there is
/// no limit.
double coresOfQuota(const std::string& quotaAndPeriod);

/// The cores that this process may use: not the whole machine's where it is bound to some (taskset, a batch system)
/// or has a quota (a container).
int coresOfProcess();

} // namespace schlieren
