// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Film/Smoothing.h"

#include "Device/Parallel.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace schlieren
{

namespace
{

/// A pixel beside another.
struct Neighbour
{
  int columns, rows;
  double squared; ///< of the distance
  double weight;
};

/// The nearest first.
std::vector<Neighbour> neighboursWithin(double radius)
{
  const double variance = 0.25 * radius * radius;
  const int reach = static_cast<int>(1.5 * radius);
  std::vector<Neighbour> neighbours;
  for (int row = -reach; row <= reach; ++row)
  {
    for (int column = -reach; column <= reach; ++column)
    {
      const double squared = column * column + row * row;
      if (squared <= 9 * variance)
      {
        neighbours.push_back({ column, row, squared, std::exp(-0.5 * squared / variance) });
      }
    }
  }
  std::stable_sort(neighbours.begin(), neighbours.end(),
    [](const Neighbour& a, const Neighbour& b) { return a.squared < b.squared; });
  return neighbours;
}

} // namespace

PixelArray<float> smoothed(
  PixelArray<float> image, int width, int height, double radius, int threads)
{
  const std::vector<Neighbour> neighbours = neighboursWithin(radius);
  if (neighbours.size() <= 1 || image.empty())
  {
    return image;
  }
  const std::size_t channels =
    image.size() / (static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  PixelArray<float> result(image.size());
  const auto smoothAt = [&](int column, int row, double* sums)
  {
    const auto valuesOf = [&](int i, int j)
    {
      return channels *
        (static_cast<std::size_t>(j) * static_cast<std::size_t>(width) +
          static_cast<std::size_t>(i));
    };
    std::fill(sums, sums + channels, 0.);
    double weights = 0;
    for (const Neighbour& neighbour : neighbours)
    {
      const int i = column + neighbour.columns, j = row + neighbour.rows;
      if (i < 0 || i >= width || j < 0 || j >= height)
      {
        continue;
      }
      weights += neighbour.weight;
      for (std::size_t channel = 0; channel < channels; ++channel)
      {
        sums[channel] += neighbour.weight * static_cast<double>(image[valuesOf(i, j) + channel]);
      }
    }
    for (std::size_t channel = 0; channel < channels; ++channel)
    {
      result[valuesOf(column, row) + channel] = static_cast<float>(sums[channel] / weights);
    }
  };
  constexpr std::int64_t rowsPerPiece = 8;
  parallelFor(height, rowsPerPiece, threads,
    [&](std::int64_t begin, std::int64_t end)
    {
      std::vector<double> sums(channels);
      for (std::int64_t row = begin; row < end; ++row)
      {
        for (int column = 0; column < width; ++column)
        {
          smoothAt(column, static_cast<int>(row), sums.data());
        }
      }
    });
  return result;
}

} // namespace schlieren
