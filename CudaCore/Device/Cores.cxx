// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Device/Cores.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>
#include <thread>

#ifdef __linux__
#include <sched.h>
#endif

namespace schlieren
{

namespace
{

constexpr double unlimited = std::numeric_limits<double>::infinity();

/// What the file holds, on one line; empty where there is none.
std::string textOf(const std::string& file)
{
  std::ifstream stream(file);
  std::string text, line;
  while (std::getline(stream, line))
  {
    text += line + " ";
  }
  return text;
}

/// The least quota of a control group and those that hold it.
double quotaOf(const std::string& hierarchy, std::string group)
{
  double cores = unlimited;
  while (true)
  {
    const std::string folder = hierarchy + group + "/";
    cores = std::min({ cores, coresOfQuota(textOf(folder + "cpu.max")),
      coresOfQuota(textOf(folder + "cpu.cfs_quota_us") + textOf(folder + "cpu.cfs_period_us")) });
    if (group.empty())
    {
      return cores;
    }
    group.resize(group.find_last_of('/'));
  }
}

/// Finds the least quota of the control groups that this process is in. A container sees its own one as the outermost.
double quotaOfProcess()
{
  double cores = unlimited;
  std::ifstream groups(
    "/proc/self/cgroup"); // lines like 4:cpu,cpuacct:/user.slice or, version 2, 0::/user.slice
  std::string number, controllers, group;
  while (std::getline(groups, number, ':') && std::getline(groups, controllers, ':') &&
    std::getline(groups, group))
  {
    const std::string hierarchy = controllers.empty() ? "/sys/fs/cgroup" : "/sys/fs/cgroup/cpu";
    if (controllers.empty() || ("," + controllers + ",").find(",cpu,") != std::string::npos)
    {
      cores = std::min(cores, quotaOf(hierarchy, group == "/" ? "" : group));
    }
  }
  return cores;
}

} // namespace

double coresOfQuota(const std::string& quotaAndPeriod)
{
  double quota = 0, period = 0;
  std::istringstream numbers(quotaAndPeriod);
  return numbers >> quota >> period && quota > 0 && period > 0 ? quota / period : unlimited;
}

int coresOfProcess()
{
  int cores = static_cast<int>(std::thread::hardware_concurrency());
#ifdef __linux__
  cpu_set_t allowed;
  if (sched_getaffinity(0, sizeof allowed, &allowed) == 0)
  {
    cores = CPU_COUNT(&allowed);
  }
  static const double quota = std::ceil(quotaOfProcess());
  cores = static_cast<int>(std::min(static_cast<double>(cores), quota));
#endif
  return std::max(1, cores);
}

} // namespace schlieren
