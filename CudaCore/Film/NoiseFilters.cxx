// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Film/NoiseFilters.h"

#include "Device/Parallel.h"
#include "Math/Units.h"

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
  double distance;
  double weight; ///< of filters that are the same everywhere
};

/// All up to a distance, the nearest first.
std::vector<Neighbour> neighboursWithin(double distance)
{
  std::vector<Neighbour> neighbours;
  const int reach = static_cast<int>(distance);
  for (int row = -reach; row <= reach; ++row)
  {
    for (int column = -reach; column <= reach; ++column)
    {
      const double here = std::sqrt(static_cast<double>(column * column + row * row));
      if (here <= distance)
      {
        neighbours.push_back({ column, row, here, 1 });
      }
    }
  }
  std::stable_sort(neighbours.begin(), neighbours.end(),
    [](const Neighbour& a, const Neighbour& b) { return a.distance < b.distance; });
  return neighbours;
}

std::vector<Neighbour> neighboursOf(NoiseFilter filter, double radius)
{
  if (filter == NoiseFilter::Cone)
  {
    return neighboursWithin(2 * radius);
  }
  if (filter == NoiseFilter::Mean)
  {
    return neighboursWithin(radius);
  }
  const double deviation = radius / 2;
  std::vector<Neighbour> neighbours = neighboursWithin(3 * deviation);
  for (Neighbour& each : neighbours)
  {
    each.weight = std::exp(-0.5 * each.distance * each.distance / (deviation * deviation));
  }
  return neighbours;
}

/// Where a filter looks.
struct Neighbourhood
{
  int width, height;
  int column, row;

  std::size_t pixel() const { return pixelOf(column, row); }
  std::size_t of(const Neighbour& neighbour) const
  {
    return pixelOf(column + neighbour.columns, row + neighbour.rows);
  }
  bool has(const Neighbour& neighbour) const
  {
    const int i = column + neighbour.columns, j = row + neighbour.rows;
    return i >= 0 && i < width && j >= 0 && j < height;
  }

private:
  std::size_t pixelOf(int i, int j) const
  {
    return static_cast<std::size_t>(j) * static_cast<std::size_t>(width) +
      static_cast<std::size_t>(i);
  }
};

/// The radius of the smallest disc around a place that holds `wanted` samples: where samples s(r) for each of
/// its pixels in the image make pi r^2 s(r) = wanted.
double coneRadius(const Neighbourhood& place, const std::vector<Neighbour>& neighbours,
  const PixelArray<float>& samples, double wanted)
{
  double found = 0;
  double pixels = 0;
  for (std::size_t i = 0; i < neighbours.size();)
  {
    const double distance = neighbours[i].distance;
    for (; i < neighbours.size() && neighbours[i].distance == distance; ++i)
    {
      if (place.has(neighbours[i]))
      {
        found += static_cast<double>(samples[place.of(neighbours[i])]);
        ++pixels;
      }
    }
    const double next = i < neighbours.size() ? neighbours[i].distance : distance;
    const double squared = wanted * pixels / (pi * found);
    if (squared <= next * next) // false where nothing was found
    {
      return std::max(distance, std::sqrt(squared));
    }
  }
  return neighbours.back().distance;
}

} // namespace

bool filtersNoise(NoiseFilter filter, double radius)
{
  return filter != NoiseFilter::None && radius >= 1;
}

bool countsSamples(NoiseFilter filter, double radius)
{
  return filter == NoiseFilter::Cone && filtersNoise(filter, radius);
}

PixelArray<float> filtered(PixelArray<float> image, int width, int height, NoiseFilter filter,
  double radius, const PixelArray<float>& samples, int threads)
{
  if (!filtersNoise(filter, radius) || image.empty())
  {
    return image;
  }
  const bool isCone = filter == NoiseFilter::Cone;
  const std::vector<Neighbour> neighbours = neighboursOf(filter, radius);
  const std::size_t channels =
    image.size() / (static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  PixelArray<float> result(image.size());
  constexpr std::int64_t rowsPerPiece = 8;
  parallelFor(height, rowsPerPiece, threads,
    [&](std::int64_t begin, std::int64_t end)
    {
      std::vector<double> sums(channels);
      for (std::int64_t row = begin; row < end; ++row)
      {
        for (int column = 0; column < width; ++column)
        {
          const Neighbourhood place{ width, height, column, static_cast<int>(row) };
          const double reach = isCone ? coneRadius(place, neighbours, samples, pi * radius * radius)
                                      : neighbours.back().distance;
          std::fill(sums.begin(), sums.end(), 0.);
          double weights = 0;
          for (const Neighbour& neighbour : neighbours)
          {
            if (neighbour.distance > reach)
            {
              break;
            }
            if (place.has(neighbour))
            {
              const double weight =
                isCone && reach > 0 ? 1 - neighbour.distance / reach : neighbour.weight;
              const float* light = image.data() + channels * place.of(neighbour);
              weights += weight;
              for (std::size_t channel = 0; channel < channels; ++channel)
              {
                sums[channel] += weight * static_cast<double>(light[channel]);
              }
            }
          }
          for (std::size_t channel = 0; channel < channels; ++channel)
          {
            result[channels * place.pixel() + channel] =
              static_cast<float>(sums[channel] / weights);
          }
        }
      }
    });
  return result;
}

} // namespace schlieren
