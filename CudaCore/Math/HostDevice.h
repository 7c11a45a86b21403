// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// Marks functions that compile for the host and, under nvcc, for the device.
#ifdef __CUDACC__
#define SCHLIEREN_HD inline __host__ __device__
#elif defined(SCHLIEREN_INLINE_ALL)
// In files that are compiled for instructions which not every processor has: a function that is also in
// others must leave no copy behind that the linker could choose for all.
#define SCHLIEREN_HD inline __attribute__((always_inline))
#else
#define SCHLIEREN_HD inline
#endif

/// Marks function templates that are not to be compiled into their callers; on the device, where a call
/// would keep the medium's view in memory, they are.
#ifdef __CUDACC__
#define SCHLIEREN_NOINLINE inline __host__ __device__
#else
#define SCHLIEREN_NOINLINE __attribute__((noinline))
#endif
