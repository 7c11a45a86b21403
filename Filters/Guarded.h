// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <exception>
#include <new>
#include <string>

namespace filters
{

/// Keeps exceptions from VTK or Qt, which would end the program. Passes their text to `fail`,
/// `noMemory` for std::bad_alloc, and returns false.
template <class Work, class Fail>
bool guarded(const Work& work, const char* noMemory, const Fail& fail)
{
  try
  {
    work();
    return true;
  }
  catch (const std::bad_alloc&)
  {
    fail(std::string(noMemory));
  }
  catch (const std::exception& problem)
  {
    fail(std::string(problem.what()));
  }
  return false;
}

} // namespace filters
