// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Types.h"

#include <charconv>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <string>

namespace schlieren
{

/// The number that an environment variable holds; nothing where it is not set. Throws Error where it is none.
inline std::optional<int> numberInEnvironment(const char* name)
{
  const char* text = std::getenv(name);
  if (text == nullptr || *text == '\0')
  {
    return {};
  }
  int number = 0;
  const char* end = text + std::strlen(text);
  const auto parsed = std::from_chars(text, end, number);
  if (parsed.ec != std::errc{} || parsed.ptr != end || number < 0)
  {
    throw Error(std::string(name) + " is \"" + text + "\". Give a number, 0 or more.");
  }
  return number;
}

/// Which of so many devices to use: the one that SCHLIEREN_CUDA_DEVICE in the environment numbers; where it is not set,
/// the first.
inline int chosenCudaDevice(int devices)
{
  constexpr const char* variable = "SCHLIEREN_CUDA_DEVICE";
  const std::optional<int> chosen = numberInEnvironment(variable);
  if (chosen && *chosen >= devices)
  {
    throw Error(std::string(variable) + " is " + std::to_string(*chosen) +
      ". Give a number less than that of the CUDA devices, " + std::to_string(devices) + ".");
  }
  return chosen.value_or(0);
}

/// Whether a CUDA device answers, which images are then made on in this thread: the one that SCHLIEREN_CUDA_DEVICE in the
/// environment numbers, else the first. When none does, `reason` (if given) says why. Throws
/// Error where there is no device of that number.
bool cudaAvailable(std::string* reason = nullptr);

} // namespace schlieren
