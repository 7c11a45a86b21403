// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Common/AvailableMemory.h"

#include "vtkAbstractArray.h"

#include <algorithm>
#include <cstddef>
#include <fstream>
#include <limits>
#include <memory>
#include <new>
#include <sstream>
#include <stdexcept>

#ifdef __linux__
#include <sys/resource.h>
#include <unistd.h>
#endif

namespace filters
{

namespace
{

constexpr double unlimited = std::numeric_limits<double>::infinity();

#ifdef __linux__
/// Reads a number from a file of lines like "name: number"; 0 if missing.
double numberIn(const char* file, const std::string& name)
{
  std::ifstream stream(file);
  std::string line, word;
  double number = 0;
  while (std::getline(stream, line))
  {
    std::istringstream words(line);
    if (words >> word && word == name && words >> number)
    {
      return number;
    }
  }
  return 0;
}

/// Returns the machine's free memory and swap.
double ofMachine()
{
  constexpr double kibibyte = 1024;
  const double available = numberIn("/proc/meminfo", "MemAvailable:");
  return available > 0 ? kibibyte * (available + numberIn("/proc/meminfo", "SwapFree:"))
                       : unlimited;
}

/// Returns what a container's limit leaves; cached files count as free.
double ofControlGroup(const char* limitFile, const char* statisticsFile, const char* inUse)
{
  double limit = 0;
  return std::ifstream(limitFile) >> limit ? std::max(0., limit - numberIn(statisticsFile, inUse))
                                           : unlimited;
}

/// Returns what a limit of the process's address space leaves.
double ofProcess(int resource, double inUse)
{
  rlimit limit{};
  return getrlimit(static_cast<__rlimit_resource>(resource), &limit) == 0 &&
      limit.rlim_cur != RLIM_INFINITY
    ? std::max(0., static_cast<double>(limit.rlim_cur) - inUse)
    : unlimited;
}
#endif

bool canAllocate(double bytes)
{
  return bytes < static_cast<double>(std::numeric_limits<std::ptrdiff_t>::max()) &&
    std::unique_ptr<char[]>(new (std::nothrow) char[static_cast<std::size_t>(bytes)]);
}

/// Returns whether the bytes can be allocated; skips the check of small ones.
bool fits(double bytes)
{
  constexpr double small = 1 << 20;
  return bytes <= small || (bytes <= availableMemory() && canAllocate(bytes));
}

std::string inWords(double bytes)
{
  constexpr double gigabyte = 1e9, megabyte = 1e6;
  std::ostringstream text;
  text.precision(3);
  bytes >= gigabyte ? text << bytes / gigabyte << " GB" : text << bytes / megabyte << " MB";
  return text.str();
}

} // namespace

//------------------------------------------------------------------------------
double availableMemory()
{
#ifdef __linux__
  double pages = 0, data = 0, skipped = 0;
  std::ifstream statistics("/proc/self/statm"); // all, resident, shared, text, libraries, data
  statistics >> pages >> skipped >> skipped >> skipped >> skipped >> data;
  const auto page = static_cast<double>(sysconf(_SC_PAGESIZE));
  return std::min({ ofMachine(),
    ofControlGroup("/sys/fs/cgroup/memory.max", "/sys/fs/cgroup/memory.stat", "anon"),
    ofControlGroup("/sys/fs/cgroup/memory/memory.limit_in_bytes",
      "/sys/fs/cgroup/memory/memory.stat", "total_rss"),
    ofProcess(RLIMIT_AS, page * pages), ofProcess(RLIMIT_DATA, page * data) });
#else
  return unlimited;
#endif
}

//------------------------------------------------------------------------------
void requireMemory(double bytes, const std::string& what, const std::string& remedy)
{
  if (!fits(bytes))
  {
    const double available = availableMemory();
    throw std::runtime_error(what + " needs " + inWords(bytes) + " of memory, but " +
      (available < bytes ? "there are " + inWords(available) : "the system refuses them") + ". " +
      remedy);
  }
}

//------------------------------------------------------------------------------
void setTuples(vtkAbstractArray* array, vtkIdType tuples)
{
  if (!fits(
        static_cast<double>(tuples) * array->GetNumberOfComponents() * array->GetDataTypeSize()))
  {
    throw std::bad_alloc();
  }
  array->SetNumberOfTuples(tuples);
}

} // namespace filters
