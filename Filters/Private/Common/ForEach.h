// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Schlieren.h"

#include <cstddef>
#include <cstdint>

namespace filters
{

/// Calls work(i) for i < count in so many threads; 0: one per core. Several threads may call it at
/// once, unlike vtkSMPTools, whose list of threads such calls corrupt.
template <class Work>
void forEach(std::size_t count, int threads, const Work& work)
{
  schlieren::parallelFor(static_cast<std::int64_t>(count), 1, threads,
    [&](std::int64_t begin, std::int64_t end)
    {
      for (std::int64_t i = begin; i < end; ++i)
      {
        work(static_cast<std::size_t>(i));
      }
    });
}

} // namespace filters
