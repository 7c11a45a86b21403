// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Waves/WavePixels.h"

#include "Device/Parallel.h"

#include <algorithm>

namespace schlieren
{

WavePixels::WavePixels(const LightAtExit& ofRays, std::int64_t raysInPixel)
  : raysPerPixel(raysInPixel)
  , columns(ofRays.columns / raysInPixel)
  , rows(ofRays.rows / raysInPixel)
  , light(static_cast<std::size_t>(columns * rows))
{
}

void WavePixels::add(const ComplexField& field, const WaveGrid& grid,
  std::complex<double> undisturbed, double weight, int threads)
{
  constexpr std::int64_t rowsInPiece = 16;
  const std::int64_t perPixel = grid.pointsPerRay * raysPerPixel;
  const double perPoint = weight / static_cast<double>(perPixel * perPixel);
  parallelFor(rows, rowsInPiece, threads,
    [&](std::int64_t begin, std::int64_t end)
    {
      for (std::int64_t row = begin * perPixel; row < end * perPixel; ++row)
      {
        const ComplexField::Value* point = field.row(grid.below + row) + grid.left;
        double* pixel = light.data() + row / perPixel * columns;
        for (std::int64_t column = 0; column < columns; ++column)
        {
          double sum = 0;
          for (std::int64_t i = 0; i < perPixel; ++i, ++point)
          {
            sum += std::norm(undisturbed + *point);
          }
          pixel[column] += perPoint * sum;
        }
      }
    });
}

std::vector<float> WavePixels::image(std::int64_t width, std::int64_t height) const
{
  std::vector<float> values(static_cast<std::size_t>(width * height));
  const std::int64_t left = (columns - width) / 2, below = (rows - height) / 2;
  for (std::int64_t row = 0; row < height; ++row)
  {
    const double* from = light.data() + (below + row) * columns + left;
    std::transform(from, from + width, values.begin() + row * width,
      [](double value) { return static_cast<float>(std::max(0., value)); });
  }
  return values;
}

} // namespace schlieren
