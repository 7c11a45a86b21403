// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Device/CudaBuffer.h" // with the emulated device

#include <gtest/gtest.h>

namespace schlieren
{

TEST(CudaBuffer, SaysWhatCouldNotBeCopied)
{
  try
  {
    const CudaBuffer<float> buffer(nullptr, 2, "Copying the cutoff");
    FAIL() << "no error";
  }
  catch (const DeviceError& failure)
  {
    EXPECT_EQ(failure.what(),
      std::string("Copying the cutoff on the CUDA device failed: invalid argument. Set Device to "
                  "Auto or CPU."));
  }
}

} // namespace schlieren
