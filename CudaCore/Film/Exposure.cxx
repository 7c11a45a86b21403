// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Film/Exposure.h"

#include "Device/Parallel.h"

#include <algorithm>
#include <cstddef>
#include <memory>
#include <mutex>

namespace schlieren
{

namespace
{

/// Where a ray meets the film, and how much of it arrives.
struct Spot
{
  Landing at;
  double light;
  std::int64_t ray;
};

/// One thread's part of the films.
struct Bands
{
  Bands(Film& film, ColorFilm* colorFilm)
    : light(film)
  {
    if (colorFilm != nullptr)
    {
      tint = &colorFilm->tint;
      for (std::size_t channel = 0; channel < channels.size(); ++channel)
      {
        channels[channel] = std::make_unique<FilmBand>(colorFilm->channels[channel]);
      }
    }
  }

  void cover(std::int64_t lowest, std::int64_t highest)
  {
    light.cover(lowest, highest);
    if (tint != nullptr)
    {
      for (const auto& channel : channels)
      {
        channel->cover(lowest, highest);
      }
    }
  }

  void splat(const Spot& spot, const float* gathered)
  {
    const Footprint at = footprintOf(spot.at.column, spot.at.row);
    light.splat(at, spot.light);
    if (tint != nullptr)
    {
      const std::array<double, 3> color =
        tint->of(gathered + static_cast<std::size_t>(spot.ray) * tint->colors.size());
      for (std::size_t channel = 0; channel < channels.size(); ++channel)
      {
        channels[channel]->splat(at, spot.light * color[channel]);
      }
    }
  }

  FilmBand light;
  const Tint* tint = nullptr;
  std::array<std::unique_ptr<FilmBand>, 3> channels;
};

template <class CutoffKind>
RayCounts exposeBy(const CutoffKind& cutoff, const std::vector<TracedRays>& passes,
  const Projection& projection, std::int64_t margin, int threads, Film& film, ColorFilm* colorFilm)
{
  const std::int64_t columns = film.width() + 2 * margin;
  const std::int64_t rows = film.height() + 2 * margin;
  constexpr std::int64_t piecesPerThread = 4;
  constexpr std::int64_t fewestRows = 16;
  const std::int64_t rowsPerPiece =
    std::max(fewestRows, rows / (piecesPerThread * threadCount(threads)));
  RayCounts counts;
  std::mutex countsLock;
  parallelFor(rows, rowsPerPiece, threads,
    [&](std::int64_t begin, std::int64_t end)
    {
      Bands bands(film, colorFilm);
      RayCounts countsHere;
      std::vector<Spot> spots(static_cast<std::size_t>(columns));
      for (std::int64_t row = begin - margin; row < end - margin; ++row)
      {
        for (const TracedRays& rays : passes)
        {
          const std::int64_t first = rays.rayOf(-margin, row);
          const double startColumn = static_cast<double>(-margin) + rays.pass.offset.column;
          const double startRow = static_cast<double>(row) + rays.pass.offset.row;
          double lowest = static_cast<double>(film.height());
          double highest = -1;
          std::size_t count = 0;
          for (std::int64_t i = 0; i < columns; ++i)
          {
            const RayExit& exit = rays.exits[first + i];
            countsHere.add(exit);
            const Landing at =
              landingOf(exit, startColumn + static_cast<double>(i), startRow, projection);
            if (exit.reachesFilm() && isOnFilm(at.column, at.row, film.width(), film.height()))
            {
              spots[count++] = { at, cutoff.transmission(exit.deflection), first + i };
              lowest = std::min(lowest, at.row);
              highest = std::max(highest, at.row);
            }
          }
          if (count > 0)
          {
            bands.cover(footprintOf(0, lowest).row, footprintOf(0, highest).row);
          }
          for (std::size_t i = 0; i < count; ++i)
          {
            bands.splat(spots[i], rays.gathered);
          }
        }
      }
      const std::lock_guard<std::mutex> guard(countsLock);
      counts.add(countsHere);
    });
  return counts;
}

} // namespace

ColorFilm::ColorFilm(const Tint& tintOfRays, int width, int height, std::int64_t mostRays)
  : tint(tintOfRays)
  , channels{ Film(width, height, mostRays), Film(width, height, mostRays),
    Film(width, height, mostRays) }
{
}

PixelArray<float> ColorFilm::develop(double raysPerPixel, int threads) const
{
  PixelArray<float> picture(channels.size() * channels[0].pixels());
  for (std::size_t channel = 0; channel < 3; ++channel)
  {
    const PixelArray<float> light = channels[channel].develop(raysPerPixel, threads);
    for (std::size_t pixel = 0; pixel < light.size(); ++pixel)
    {
      picture[3 * pixel + channel] = light[pixel];
    }
  }
  return picture;
}

RayCounts expose(const std::vector<TracedRays>& passes, const Cutoffs& cutoff,
  const Projection& projection, std::int64_t margin, int threads, Film& film, ColorFilm* colorFilm)
{
  return std::visit([&](const auto& kind)
    { return exposeBy(kind, passes, projection, margin, threads, film, colorFilm); },
    cutoff);
}

} // namespace schlieren
