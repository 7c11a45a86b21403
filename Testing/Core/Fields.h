// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Math/Units.h"
#include "Schlieren.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

namespace schlieren
{

/// A grid of n^3 points over the cube of half edge `half` around `centre`.
inline Grid cube(std::int64_t n, double half, const Vector& centre = { 0, 0, 0 })
{
  Grid grid;
  grid.dimensions = { n, n, n };
  const double spacing = 2 * half / static_cast<double>(n - 1);
  grid.spacing = { spacing, spacing, spacing };
  grid.origin = { centre[0] - half, centre[1] - half, centre[2] - half };
  return grid;
}

/// A medium sampled at the grid's points, and the memory for it.
template <class Value>
struct SampledField
{
  SampledField(const Grid& grid, const std::function<double(double, double, double)>& refractivity)
  {
    static std::uint64_t versions = 0;
    field.grid = grid;
    field.version = ++versions;
    samples.reserve(
      static_cast<std::size_t>(grid.dimensions[0] * grid.dimensions[1] * grid.dimensions[2]));
    const std::array<double, 9>& d = grid.direction;
    for (std::int64_t k = 0; k < grid.dimensions[2]; ++k)
    {
      for (std::int64_t j = 0; j < grid.dimensions[1]; ++j)
      {
        for (std::int64_t i = 0; i < grid.dimensions[0]; ++i)
        {
          const double x = static_cast<double>(i) * grid.spacing[0];
          const double y = static_cast<double>(j) * grid.spacing[1];
          const double z = static_cast<double>(k) * grid.spacing[2];
          samples.push_back(
            static_cast<Value>(refractivity(grid.origin[0] + d[0] * x + d[1] * y + d[2] * z,
              grid.origin[1] + d[3] * x + d[4] * y + d[5] * z,
              grid.origin[2] + d[6] * x + d[7] * y + d[8] * z)));
        }
      }
    }
    point();
  }

  SampledField(const SampledField&) = delete;
  SampledField& operator=(const SampledField&) = delete;

  std::vector<Value> samples;
  Field field;

private:
  void point()
  {
    if constexpr (std::is_same_v<Value, float>)
    {
      field.singles = samples.data();
    }
    else
    {
      field.doubles = samples.data();
    }
  }
};

/// Image coordinates of the centre of a pixel.
struct PixelCentre
{
  double u, v;
};
inline PixelCentre centreOf(const Image& image, int column, int row)
{
  return { image.frame.origin[0] + column * image.frame.pixelSize,
    image.frame.origin[1] + row * image.frame.pixelSize };
}

inline std::size_t pixelOf(const Image& image, int column, int row)
{
  return static_cast<std::size_t>(row) * static_cast<std::size_t>(image.width) +
    static_cast<std::size_t>(column);
}

inline const char* name(Device device) { return device == Device::Cuda ? "Cuda" : "Cpu"; }
inline void PrintTo(Device device, std::ostream* out) { *out << name(device); }
inline const char* name(Precision precision)
{
  return precision == Precision::Single ? "Single" : "Double";
}

inline constexpr Interpolation allInterpolations[] = { Interpolation::Quadratic,
  Interpolation::Cubic };
inline const char* name(Interpolation interpolation)
{
  constexpr const char* names[] = { "Quadratic", "Linear", "Central", "Cubic" };
  return names[static_cast<int>(interpolation)];
}
inline void PrintTo(Interpolation interpolation, std::ostream* out) { *out << name(interpolation); }

/// For tests that run on both: where there is no device, the CUDA half says that it was skipped.
class OnDevice : public testing::TestWithParam<Device>
{
protected:
  void SetUp() override
  {
    std::string reason;
    if (GetParam() == Device::Cuda && !cudaAvailable(&reason))
    {
      GTEST_SKIP() << "no CUDA device: " << reason;
    }
  }
};

/// For tests of the device alone.
class WithCuda : public testing::Test
{
protected:
  void SetUp() override
  {
    std::string reason;
    if (!cudaAvailable(&reason))
    {
      GTEST_SKIP() << "no CUDA device: " << reason;
    }
  }
};

inline auto bothDevices() { return testing::Values(Device::Cpu, Device::Cuda); }
inline std::string deviceName(const testing::TestParamInfo<Device>& info)
{
  return name(info.param);
}

/// A view of so many pixels, on the CPU.
inline Scene sceneOnCpu(int width, int height, const Vector& direction = { 0, 0, -1 })
{
  Scene scene;
  scene.device = Device::Cpu;
  scene.view.width = width;
  scene.view.height = height;
  scene.view.viewDirection = direction;
  return scene;
}

/// A blob whose axes are not those of the grid.
inline double blobAt(double x, double y, double z)
{
  return 3e-4 * std::exp(-(x * x + 2 * y * y + z * z + x * y) / 0.1);
}
inline SampledField<float> blobField(std::int64_t points = 24)
{
  return { cube(points, 1), blobAt };
}

/// A blob with a hole that blocks light.
struct BlobWithHole : SampledField<float>
{
  BlobWithHole()
    : SampledField<float>(cube(24, 1),
        [](double x, double y, double z)
        {
          return x * x + y * y + z * z < 0.03 ? std::numeric_limits<double>::quiet_NaN()
                                              : blobAt(x, y, z);
        })
  {
    field.ambient = 1e-5;
  }
};

/// The means over pixels of light that rays in their centres have, as the film has them: bilinear between rays that have a
/// twelfth of their second differences less, within 0 ... 1. Of pixels that have two others on each side.
inline std::vector<double> meansOver(const Image& image, const std::vector<double>& light)
{
  const auto width = static_cast<std::size_t>(image.width);
  const std::size_t steps[2] = { 1, width };
  std::vector<double> sharpened(light), means(light);
  for (std::size_t i = width; i + width < light.size(); ++i)
  {
    for (const std::size_t step : steps)
    {
      sharpened[i] -= (light[i - step] + light[i + step] - 2 * light[i]) / 12;
    }
    sharpened[i] = std::clamp(sharpened[i], 0., 1.);
  }
  for (std::size_t i = width + 1; i + width + 1 < light.size(); ++i)
  {
    const auto alongRow = [&](std::size_t at)
    { return (sharpened[at - 1] + 6 * sharpened[at] + sharpened[at + 1]) / 8; };
    means[i] = (alongRow(i - width) + 6 * alongRow(i) + alongRow(i + width)) / 8;
  }
  return means;
}

} // namespace schlieren
