// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Device/UninitialisedAllocator.h"

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace schlieren
{

void requestHugePages([[maybe_unused]] void* memory, [[maybe_unused]] std::size_t bytes)
{
#ifdef MADV_HUGEPAGE
  constexpr std::size_t page = std::size_t{ 1 } << 21;
  if (std::align(page, page, memory, bytes) != nullptr)
  {
    madvise(memory, bytes / page * page, MADV_HUGEPAGE); // in vain where the system has none
  }
#endif
}

} // namespace schlieren
