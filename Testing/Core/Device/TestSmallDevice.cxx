// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// Images on a device with little memory, which the emulated one can have.
#include "AnalyticSources.h"
#include "Fields.h"
#include "Messages.h"
#include "Rays/RayExit.h"
#include "Threads.h"

namespace schlieren
{

namespace
{

constexpr std::size_t megabyte = std::size_t{ 1 } << 20;
constexpr int pixels = 200 * 150;

class SmallDevice : public testing::Test
{
protected:
  SmallDevice()
    : field_(cube(20, 1), gaussian)
  {
    scene_.device = Device::Cuda;
    scene_.pathModel = PathModel::Refracted;
    scene_.view.width = 200;
    scene_.view.height = 150;
    scene_.samplesPerPixel = 3;
    scene_.kScale = 300;
  }
  ~SmallDevice() override { emulated::setCapacity(emulated::defaultCapacity); }

  static double gaussian(double x, double y, double z)
  {
    return 3e-4 * std::exp(-(x * x + y * y + z * z) / 0.1);
  }
  Image render(Bench& bench) { return bench.render(field_.field, scene_); }
  /// With all the memory that it wants.
  Image rendered()
  {
    emulated::setCapacity(emulated::defaultCapacity);
    Bench bench;
    return render(bench);
  }

  SampledField<float> field_;
  Scene scene_;
};

TEST_F(SmallDevice, KeepsNoRaysThatFillIt)
{
  const Image expected = rendered();
  emulated::setCapacity(6 * megabyte);
  Bench bench;
  for (int image = 1; image <= 2; ++image)
  {
    const Image found = render(bench);
    EXPECT_EQ(found.device, Device::Cuda);
    EXPECT_EQ(found.deviceNote, "");
    EXPECT_EQ(found.intensity, expected.intensity);
    EXPECT_EQ(bench.work().raysTraced, image * expected.raysTraced);
  }
}

TEST_F(SmallDevice, LosesRaysRatherThanTheImage)
{
  Bench bench;
  const std::int64_t rays = render(bench).raysTraced;
  scene_.cutoff = Cutoff::Shadowgraph;
  const Image expected = rendered();

  // Three passes of rays are there, and less than a film's sums fits beside them.
  emulated::setCapacity(3 * pixels * sizeof(RayExit) + megabyte);
  ASSERT_EQ(bench.work().raysTraced, rays);
  for (int image = 1; image <= 2; ++image)
  {
    const Image found = render(bench);
    EXPECT_EQ(found.device, Device::Cuda);
    EXPECT_EQ(found.deviceNote, "");
    EXPECT_EQ(found.intensity, expected.intensity);
    EXPECT_EQ(bench.work().raysTraced, (1 + image) * rays);
  }
}

TEST_F(SmallDevice, LeavesToTheCpuWhatIsTooMuch)
{
  emulated::setCapacity(megabyte);
  Bench bench;
  expectError(messageOf([&] { render(bench); }), "of its 1 MB of memory free");
  scene_.device = Device::Auto;
  const Image found = render(bench);
  EXPECT_EQ(found.device, Device::Cpu);
  EXPECT_NE(found.deviceNote.find("of its 1 MB of memory free"), std::string::npos)
    << found.deviceNote;
  emulated::setCapacity(emulated::defaultCapacity);
  EXPECT_EQ(render(bench).device, Device::Cuda);
}

// What looks at a view before its image is traced on the same device.
TEST_F(SmallDevice, LooksAtAViewWithWhatThereIs)
{
  scene_.interpolation = Interpolation::Cubic; // as a target error has it
  Bench bench;
  render(bench);
  scene_.targetError = 1. / 64;
  scene_.view.viewDirection = { 0.1, 0.2, -1 };
  const Image expected = rendered();
  EXPECT_EQ(expected.device, Device::Cuda);

  // Full of the rays of another image.
  emulated::setCapacity(3 * pixels * sizeof(RayExit) + megabyte);
  const Image found = render(bench);
  EXPECT_EQ(found.device, Device::Cuda);
  EXPECT_EQ(found.deviceNote, "");
  EXPECT_EQ(found.intensity, expected.intensity);
  EXPECT_EQ(found.accuracy.reached, expected.accuracy.reached);

  emulated::setCapacity(1000); // less than the medium
  Bench another;
  EXPECT_THROW(render(another), Error);
  scene_.device = Device::Auto;
  const Image onCpu = render(another);
  EXPECT_EQ(onCpu.device, Device::Cpu);
  EXPECT_NE(onCpu.deviceNote.find("of memory free"), std::string::npos) << onCpu.deviceNote;
  EXPECT_EQ(onCpu.samplesPerPixel, expected.samplesPerPixel);
  EXPECT_EQ(onCpu.stepSize, expected.stepSize);
  emulated::setCapacity(emulated::defaultCapacity);
  EXPECT_EQ(render(another).device, Device::Cuda);
}

// All of a medium is there, or none of it.
TEST_F(SmallDevice, LeavesTreesToTheCpuThatAreTooLarge)
{
  Field field;
  field.source = std::make_shared<BallsSource>(threeBalls(1e-3));
  field.grid = coarsestGrid(*field.source);
  scene_.view.parallelScale = 0.3;
  scene_.mediumTolerance = 1e-3;
  scene_.view.width = 100;
  scene_.view.height = 75;
  const auto render = [&](Device device)
  {
    scene_.device = device;
    Bench bench;
    return bench.render(field, scene_);
  };
  ASSERT_GT(render(Device::Cuda).medium.bytes, static_cast<std::int64_t>(3 * megabyte));
  const Image onCpu = render(Device::Cpu);

  emulated::setCapacity(3 * megabyte);
  const Image found = render(Device::Auto);
  EXPECT_EQ(found.device, Device::Cpu);
  EXPECT_EQ(found.deflection, onCpu.deflection);
  EXPECT_NE(found.deviceNote.find("Medium Memory"), std::string::npos) << found.deviceNote;
  expectError(
    messageOf([&] { render(Device::Cuda); }), "more are needed. Set Device to Auto or CPU");
}

} // namespace

} // namespace schlieren
