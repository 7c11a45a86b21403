// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <exception>
#include <new>
#include <string>

namespace filters
{

/// Returns a message for a user without its middle if it is very long, as with names or lists from a file.
inline std::string shortened(const std::string& message)
{
  constexpr std::size_t most = 2000, behind = 600;
  if (message.size() <= most)
  {
    return message;
  }
  std::size_t end = most - behind, begin = message.size() - behind;
  const auto isWithinLetter = [&](std::size_t at) { return (message[at] & 0xc0) == 0x80; }; // UTF-8
  for (; isWithinLetter(end); --end)
  {
  }
  for (; begin < message.size() && isWithinLetter(begin); ++begin)
  {
  }
  return message.substr(0, end) + " [...] " + message.substr(begin);
}

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
    fail(shortened(problem.what()));
  }
  return false;
}

} // namespace filters
