// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// Marks functions that compile for the host and, under nvcc, for the device.
#ifdef __CUDACC__
#define SCHLIEREN_HD __host__ __device__
#else
#define SCHLIEREN_HD
#endif
