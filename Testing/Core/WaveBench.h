// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Images of waves of rays that are given.
#pragma once

#include "WaveForms.h"
#include "Waves/FourierPlane.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <optional>

namespace schlieren::waveforms
{

/// What a ray carries that starts at x; nothing changes along y.
struct Ray
{
  double path = 0, deflection = 0, displacement = 0;
  bool isBlocked = false;
};
using RayAt = std::function<Ray(double x)>;

/// A screen of width x height pixels, whose middle row is the image.
struct Bench1d
{
  double pixel;
  std::int64_t width;
  double distance;
  double wavelength = green;
  double largestDeflection = 0; ///< for the margin
  int raysPerPixel = 1;
  double planeOtherwise = 0, largestPlane = 1;
  LightSource source{};
  std::optional<Imaging> imaging{}; ///< instead of a screen
  std::int64_t leastMargin = 4;     ///< pixels
  std::int64_t height = 2; ///< a mask that is not even along y sees the ends of light there
  std::size_t memoryBudget = std::size_t{ 1 } << 30;

  Screen screen() const
  {
    Screen screen;
    screen.wavelength = wavelength;
    screen.distance = distance;
    screen.width = width;
    screen.height = height;
    screen.raysPerPixel = raysPerPixel;
    screen.source = source;
    screen.planeOtherwise = planeOtherwise;
    screen.largestPlane = largestPlane;
    screen.memoryBudget = memoryBudget;
    screen.threads = 2;
    return screen;
  }
  std::int64_t margin() const
  {
    return leastMargin +
      static_cast<std::int64_t>(
        std::ceil(marginOnScreen(screen(), wavelength, distance, largestDeflection) / pixel));
  }
  LightAtExit rays(const RayAt& rayAt) const
  {
    LightAtExit light;
    light.spacing = pixel / raysPerPixel;
    light.resize((width + 2 * margin()) * raysPerPixel, (height + 2 * margin()) * raysPerPixel);
    const Numbers x = places(light.columns, light.spacing);
    for (std::size_t i = 0; i < light.size(); ++i)
    {
      const Ray ray = rayAt(x[i % x.size()]);
      light.path[i] = ray.path;
      light.deflection[0][i] = ray.deflection;
      light.displacement[0][i] = ray.displacement;
      light.isBlocked[i] = ray.isBlocked ? 1 : 0;
      light.passing[i] = ray.isBlocked ? 0 : 1;
    }
    return light;
  }
  Numbers image(const RayAt& rayAt, WaveReport* found = nullptr) const
  {
    WaveReport report;
    LightAtExit exits = rays(rayAt);
    continueBehindBodies(exits);
    const std::vector<float> light = imaging ? lightInFocus(exits, screen(), *imaging, {}, report)
                                             : lightOnScreen(exits, screen(), {}, report);
    if (found != nullptr)
    {
      *found = report;
    }
    const auto middle = light.begin() + height / 2 * width;
    for (std::int64_t i = 0; i < width; ++i)
    {
      EXPECT_NEAR(middle[i], (middle - width)[i], 1e-4 * static_cast<double>(middle[i]) + 1e-6);
    }
    return { middle, middle + width };
  }
  Numbers pixels() const { return places(width, pixel); }
};

/// A Gaussian column that bends light on the exit plane.
inline RayAt column(double path, double size)
{
  return [=](double x)
  {
    const double all = path * std::exp(-x * x / (size * size));
    return Ray{ all, -2 * x / (size * size) * all, 0 };
  };
}
inline double steepestOfColumn(double path, double size)
{
  return path / size * std::sqrt(2 / std::exp(1.));
}

/// Means of so many values each.
inline Numbers meansOf(const Numbers& values, std::size_t count)
{
  Numbers means;
  for (std::size_t i = 0; i < values.size(); i += count)
  {
    double sum = 0;
    for (std::size_t j = 0; j < count; ++j)
    {
      sum += values[i + j] / static_cast<double>(count);
    }
    means.push_back(sum);
  }
  return means;
}

} // namespace schlieren::waveforms
