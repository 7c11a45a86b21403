// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Common/AvailableMemory.h"

#include "vtkAbstractArray.h"

#include <algorithm>
#include <cstddef>
#include <fstream>
#include <limits>
#include <new>
#include <sstream>
#include <stdexcept>

namespace filters
{

namespace
{

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

bool canAllocate(double bytes)
{
  if (bytes >= static_cast<double>(std::numeric_limits<std::ptrdiff_t>::max()))
  {
    return false;
  }
  // Called as functions: of new and delete expressions, compilers may leave out both (GCC 16 does).
  void* memory = ::operator new(static_cast<std::size_t>(bytes), std::nothrow);
  ::operator delete(memory);
  return memory != nullptr;
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

double availableMemory()
{
  constexpr double kibibyte = 1024;
  const double free = numberIn("/proc/meminfo", "MemAvailable:");
  double available = free > 0 ? kibibyte * (free + numberIn("/proc/meminfo", "SwapFree:"))
                              : std::numeric_limits<double>::infinity();
  double limit = 0; // of a container; cached files count as free
  if (std::ifstream("/sys/fs/cgroup/memory.max") >> limit)
  {
    const double inUse = numberIn("/sys/fs/cgroup/memory.stat", "anon");
    available = std::min(available, std::max(0., limit - inUse));
  }
  return available;
}

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
