// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// Which device is used where there are several, as the emulated ones.
#include "Fields.h"

#include <cuda_runtime.h>

#include <cstdlib>
#include <string>

namespace schlieren
{

namespace
{

class CudaDevice : public testing::Test
{
protected:
  CudaDevice() { setenv("EMULATED_DEVICES", "3", 1); }
  ~CudaDevice() override
  {
    cudaSetDevice(0);
    unsetenv("EMULATED_DEVICES");
    unsetenv("SCHLIEREN_CUDA_DEVICE");
  }
  static int used()
  {
    EXPECT_TRUE(cudaAvailable());
    int device = -1;
    cudaGetDevice(&device);
    return device;
  }
  static std::string error()
  {
    try
    {
      cudaAvailable();
    }
    catch (const Error& error)
    {
      return error.what();
    }
    return "no error";
  }
};

TEST_F(CudaDevice, IsTheOneThatTheEnvironmentNumbers)
{
  EXPECT_EQ(used(), 0);
  setenv("SCHLIEREN_CUDA_DEVICE", "1", 1);
  EXPECT_EQ(used(), 1);
  setenv("SCHLIEREN_CUDA_DEVICE", "3", 1);
  EXPECT_EQ(
    error(), "SCHLIEREN_CUDA_DEVICE is 3. Give a number less than that of the CUDA devices, 3.");
  for (const char* wrong : { "first", "-1", "1.5", "99999999999" })
  {
    setenv("SCHLIEREN_CUDA_DEVICE", wrong, 1);
    EXPECT_EQ(error(),
      "SCHLIEREN_CUDA_DEVICE is \"" + std::string(wrong) + "\". Give a number, 0 or more.");
  }
}

/// The same image, and what was begun on a device is continued there.
TEST_F(CudaDevice, MakesTheSameImage)
{
  const SampledField<float> field(
    cube(12, 1), [](double x, double y, double) { return 1e-4 * x * y; });
  Scene scene;
  scene.device = Device::Cuda;
  scene.view.width = scene.view.height = 20;
  Bench first, second;
  const Image expected = first.render(field.field, scene);
  setenv("SCHLIEREN_CUDA_DEVICE", "2", 1);
  EXPECT_EQ(second.render(field.field, scene).intensity, expected.intensity);
  int device = -1;
  cudaGetDevice(&device);
  EXPECT_EQ(device, 2);
  ++scene.seed;
  scene.samplesPerPixel = 2;
  first.render(field.field, scene);
  cudaGetDevice(&device);
  EXPECT_EQ(device, 0);
}

} // namespace

} // namespace schlieren
