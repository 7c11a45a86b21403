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

/// The rank among the processes of this machine, as launchers of MPI give it; 0 where none does.
inline int localRank()
{
  for (const char* name : { "OMPI_COMM_WORLD_LOCAL_RANK", "MV2_COMM_WORLD_LOCAL_RANK",
         "MPI_LOCALRANKID", "PALS_LOCAL_RANKID", "SLURM_LOCALID" })
  {
    if (const std::optional<int> rank = numberInEnvironment(name))
    {
      return *rank;
    }
  }
  return 0;
}

/// Which of so many devices to use: the one that SCHLIEREN_CUDA_DEVICE in the environment numbers; where it is not set,
/// ranks on a machine take them in turn.
inline int chosenCudaDevice(int devices)
{
  constexpr const char* variable = "SCHLIEREN_CUDA_DEVICE";
  const std::optional<int> chosen = numberInEnvironment(variable);
  if (chosen && *chosen >= devices)
  {
    throw Error(std::string(variable) + " is " + std::to_string(*chosen) +
      ". Give a number less than that of the CUDA devices, " + std::to_string(devices) + ".");
  }
  return chosen.value_or(localRank() % devices);
}

/// Whether a CUDA device answers, which images are then made on in this thread: the one that SCHLIEREN_CUDA_DEVICE in the
/// environment numbers, else one for each rank of a machine in turn. When none does, `reason` (if given) says why. Throws
/// Error where there is no device of that number.
bool cudaAvailable(std::string* reason = nullptr);

/// The compute capability of the device that cudaAvailable chooses, 10 times the first number and the second one: the
/// same kernels give the same rays on devices of the same one. 0: there is no device.
int cudaCapability();

} // namespace schlieren
