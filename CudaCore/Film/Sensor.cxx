// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Film/Sensor.h"

#include "Device/Parallel.h"
#include "Math/RandomBits.h"
#include "Math/Units.h"

#include <algorithm>
#include <cmath>

namespace schlieren
{

namespace
{

/// Two independent normal numbers (Box & Muller 1958).
struct Normals
{
  double first, second;

  static Normals of(std::uint64_t key, std::uint64_t pixel)
  {
    const auto uniform = [&](std::uint64_t number)
    {
      constexpr double step = 0x1p-53;
      return (static_cast<double>(mixed(key ^ (2 * pixel + number)) >> 11) + 0.5) * step;
    };
    const double radius = std::sqrt(-2 * std::log(uniform(0)));
    const double angle = 2 * pi * uniform(1);
    return { radius * std::cos(angle), radius * std::sin(angle) };
  }
};

} // namespace

std::vector<std::uint16_t> record(
  const float* light, std::size_t pixels, const Sensor& sensor, std::uint32_t image, int threads)
{
  std::vector<std::uint16_t> values(pixels);
  const std::uint64_t key = mixed(mixed(sensor.seed) ^ image);
  const double largest = std::ldexp(1., sensor.bitDepth) - 1;
  constexpr std::int64_t pixelsPerPiece = 1 << 14;
  parallelFor(static_cast<std::int64_t>(pixels), pixelsPerPiece, threads,
    [&](std::int64_t begin, std::int64_t end)
    {
      for (auto pixel = static_cast<std::size_t>(begin); pixel < static_cast<std::size_t>(end);
           ++pixel)
      {
        const double electrons =
          sensor.exposure * sensor.fullWell * std::max(0., static_cast<double>(light[pixel]));
        const Normals noise = Normals::of(key, pixel);
        const double read =
          electrons + std::sqrt(electrons) * noise.first + sensor.readNoise * noise.second;
        const double filled = std::clamp(read / sensor.fullWell, 0., 1.);
        values[pixel] =
          static_cast<std::uint16_t>(std::pow(filled, 1 / sensor.gamma) * largest + 0.5);
      }
    });
  return values;
}

} // namespace schlieren
