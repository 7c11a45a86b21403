// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <exception>
#include <new>
#include <string>

namespace filters
{

/// Does work that VTK or Qt requests, neither of which an exception may reach: it would end the program. What is thrown
/// goes to `fail` as a text for users, which of std::bad_alloc is `noMemory`. False then.
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
