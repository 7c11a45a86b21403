// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Types.h"

namespace schlieren
{

/// The device is there but could not do the work (memory, driver); the CPU still can.
class DeviceError : public Error
{
public:
  using Error::Error;
};

/// The device's memory is used up: it may do with less.
class OutOfDeviceMemory : public DeviceError
{
public:
  using DeviceError::DeviceError;
};

/// Says why there is no device in builds in which files named NoCuda... replace the .cu files.
constexpr const char* builtWithoutCuda = "this build has no CUDA support";

} // namespace schlieren
