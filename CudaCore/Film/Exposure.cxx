// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Film/Exposure.h"

#include "Device/Parallel.h"
#include "Film/Deposit.h"
#include "Film/RowShader.h"

#include <algorithm>
#include <cstddef>
#include <mutex>
#include <numeric>
#include <utility>

namespace schlieren
{

namespace
{

/// Weights of linear sRGB (IEC 61966-2-1).
constexpr double luminance[3] = { 0.2126, 0.7152, 0.0722 };

/// Rays that start in rows `begin` ... `end` - 1, counted from the margin's lowest on.
template <int planes>
RayCounts exposeRows(std::int64_t begin, std::int64_t end, const std::vector<TracedRays>& passes,
  const Cutoffs& cutoff, const Projection& projection, std::int64_t margin, Films& films)
{
  return depositRows<planes>(
    begin, end, passes, *rowShader<planes>(cutoff, projection, films, margin), films);
}

} // namespace

Films::Films(int channels, int width, int height, std::int64_t maxRays)
{
  for (int plane = 0; plane < channels; ++plane)
  {
    planes.emplace_back(width, height, maxRays);
  }
}

LightBalance Films::balance(double raysPerPixel) const
{
  LightBalance all;
  for (std::size_t plane = 0; plane < planes.size(); ++plane)
  {
    const Film& film = planes[plane];
    const double weight = (planes.size() == 3 ? luminance[plane] : 1) /
      (film.one() * raysPerPixel * static_cast<double>(film.pixels()));
    all.emitted += weight * static_cast<double>(film.sums().emitted);
    all.outside += weight * static_cast<double>(film.sums().outside);
    all.onFilm += weight *
      static_cast<double>(
        std::accumulate(film.light().begin(), film.light().end(), std::int64_t{ 0 }));
  }
  return all;
}

PixelArray<float> Films::developIntensity(double raysPerPixel, int threads) const
{
  PixelArray<float> image = planes[0].develop(raysPerPixel, threads);
  if (planes.size() == 3)
  {
    const PixelArray<float> green = planes[1].develop(raysPerPixel, threads);
    const PixelArray<float> blue = planes[2].develop(raysPerPixel, threads);
    for (std::size_t pixel = 0; pixel < image.size(); ++pixel)
    {
      image[pixel] = static_cast<float>(luminance[0] * static_cast<double>(image[pixel]) +
        luminance[1] * static_cast<double>(green[pixel]) +
        luminance[2] * static_cast<double>(blue[pixel]));
    }
  }
  return image;
}

PixelArray<float> Films::developColor(double raysPerPixel, int threads) const
{
  PixelArray<float> image(3 * planes[0].pixels());
  for (std::size_t channel = 0; channel < 3; ++channel)
  {
    const PixelArray<float> light = planes[channel].develop(raysPerPixel, threads);
    for (std::size_t pixel = 0; pixel < light.size(); ++pixel)
    {
      image[3 * pixel + channel] = light[pixel];
    }
  }
  return image;
}

RayCounts expose(const std::vector<TracedRays>& passes, const Cutoffs& cutoff,
  const Projection& projection, std::int64_t margin, int threads, Films& films)
{
  std::int64_t firstRow = 0;
  return exposeFrom(firstRow, passes, cutoff, projection, margin, threads, films, Monitor{});
}

RayCounts exposeFrom(std::int64_t& firstRow, const std::vector<TracedRays>& passes,
  const Cutoffs& cutoff, const Projection& projection, std::int64_t margin, int threads,
  Films& films, const Monitor& monitor)
{
  constexpr std::int64_t piecesPerThread = 4;
  constexpr std::int64_t fewestRows = 16;
  constexpr std::int64_t maxRowsToPause = 64;
  const std::int64_t rows = films.planes[0].height() + 2 * margin;
  std::int64_t rowsPerPiece = std::max(fewestRows, rows / (piecesPerThread * threadCount(threads)));
  if (monitor.paused)
  {
    rowsPerPiece = std::min(rowsPerPiece, maxRowsToPause);
  }
  RayCounts counts;
  std::mutex countsLock;
  const std::int64_t done = parallelFrom(
    firstRow, rows, rowsPerPiece, threads,
    [&](std::int64_t begin, std::int64_t end)
    {
      const auto work = films.planes.size() == 1 ? exposeRows<1> : exposeRows<3>;
      const RayCounts countsHere = work(begin, end, passes, cutoff, projection, margin, films);
      const std::lock_guard<std::mutex> guard(countsLock);
      counts.add(countsHere);
    },
    monitor);
  firstRow = done < rows ? done : 0;
  return counts;
}

} // namespace schlieren
