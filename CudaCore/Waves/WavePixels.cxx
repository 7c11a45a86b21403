// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Waves/WavePixels.h"

#include "Device/Parallel.h"
#include "Math/Units.h"

#include <algorithm>

namespace schlieren
{

WavePixels::WavePixels(
  const LightAtExit& ofRays, std::int64_t raysInPixel, std::int64_t leftOutOfRays)
  : raysPerPixel(raysInPixel)
  , leftOut(leftOutOfRays)
  , columns(ofRays.columns / raysInPixel - 2 * leftOutOfRays)
  , rows(ofRays.rows / raysInPixel - 2 * leftOutOfRays)
  , light(static_cast<std::size_t>(columns * rows))
{
}

/// `lightOf` is called with a point's column and row, from the first ray's first point, and its value.
template <class LightOfPoint>
void WavePixels::addMeans(const ComplexField& field, const WaveGrid& grid, double weight,
  int threads, const LightOfPoint& lightOf)
{
  constexpr std::int64_t rowsInPiece = 16;
  const std::int64_t perPixel = grid.pointsPerRay * raysPerPixel, first = leftOut * perPixel;
  const double perPoint = weight / static_cast<double>(perPixel * perPixel);
  parallelFor(rows, rowsInPiece, threads,
    [&](std::int64_t begin, std::int64_t end)
    {
      for (std::int64_t row = first + begin * perPixel; row < first + end * perPixel; ++row)
      {
        const ComplexField::Value* point = field.row(grid.below + row) + grid.left + first;
        double* pixel = light.data() + (row - first) / perPixel * columns;
        for (std::int64_t column = 0; column < columns; ++column)
        {
          double sum = 0;
          for (std::int64_t i = 0; i < perPixel; ++i, ++point)
          {
            sum += lightOf(first + column * perPixel + i, row, *point);
          }
          pixel[column] += perPoint * sum;
        }
      }
    });
}

void WavePixels::add(const ComplexField& field, const WaveGrid& grid,
  std::complex<double> undisturbed, double weight, int threads)
{
  addMeans(field, grid, weight, threads,
    [undisturbed](std::int64_t, std::int64_t, const ComplexField::Value& value)
    { return std::norm(undisturbed + value); });
}

void WavePixels::addFringes(const ComplexField& field, const WaveGrid& grid,
  std::complex<double> undisturbed, const EvenPhase& turns, double weight, int threads)
{
  const auto wavesAlong = [](std::int64_t points, double perPoint, double atFirst)
  {
    std::vector<std::complex<double>> waves;
    for (std::int64_t point = 0; point < points; ++point)
    {
      waves.push_back(std::polar(1., 2 * pi * (atFirst + perPoint * static_cast<double>(point))));
    }
    return waves;
  };
  const auto alongX = wavesAlong(grid.columns, turns.perColumn, turns.atFirst);
  const auto alongY = wavesAlong(grid.rows, turns.perRow, 0);
  addMeans(field, grid, weight, threads,
    [&](std::int64_t column, std::int64_t row, const ComplexField::Value& value)
    {
      const auto wave =
        alongX[static_cast<std::size_t>(column)] * alongY[static_cast<std::size_t>(row)];
      return 0.5 + ((undisturbed + value) * wave).real();
    });
}

RowRange WavePixels::rowsOf(const WaveGrid& grid) const
{
  const std::int64_t perPixel = grid.pointsPerRay * raysPerPixel;
  const std::int64_t first = grid.below + leftOut * perPixel;
  return { first, first + rows * perPixel };
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
