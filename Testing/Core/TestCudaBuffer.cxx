// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Device/CudaBuffer.h" // with FakeCuda/cuda_runtime.h

#include <gtest/gtest.h>

#include <stdexcept>

namespace schlieren
{

namespace
{

class FakeFailure : public std::runtime_error // nobody else's CudaBuffer throws it
{
public:
  using std::runtime_error::runtime_error;
};

} // namespace

TEST(CudaBuffer, SaysWhatCouldNotBeCopied)
{
  const float values[2] = { 1, 2 };
  try
  {
    const CudaBuffer<float, FakeFailure> buffer(values, 2, "Copying the cutoff");
    FAIL() << "no error";
  }
  catch (const FakeFailure& failure)
  {
    EXPECT_EQ(failure.what(),
      std::string("Copying the cutoff on the CUDA device failed: invalid argument. Set Device to "
                  "Auto or CPU."));
  }
}

} // namespace schlieren
