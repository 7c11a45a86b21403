// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Common/Threads.h"

#include <algorithm>
#include <cstdlib>

namespace filters
{

int threadsFrom(int given)
{
  const char* const limit = std::getenv("VTK_SMP_MAX_THREADS");
  return given > 0 || !limit ? given : std::max(0, std::atoi(limit));
}

vtkSMPTools::Config loopsWith(int threads)
{
  return vtkSMPTools::Config(threads, "STDThread", false);
}

} // namespace filters
