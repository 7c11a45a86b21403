// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cuda_runtime.h"

namespace emulated
{

/// Ends the program: the device was used as it must not be. `line`: of the kernel, if known.
[[noreturn]] void fail(const char* what, int line = 0);

/// Runs all threads of a kernel, block after block. EMULATED_ORDER in the environment says in which order
/// blocks and the threads of a block begin and continue after a barrier: "forward" (as if it were not set),
/// "backward", or a number, the seed of a shuffle.
void run(const Launch& launch);

/// Of the device's memory. What is allocated stays, even if it is more.
void setCapacity(std::size_t bytes);
constexpr std::size_t defaultCapacity = std::size_t{ 4 } << 30;

} // namespace emulated
