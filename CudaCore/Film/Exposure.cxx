// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Film/Exposure.h"

#include "Device/Parallel.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <mutex>
#include <utility>
#include <variant>

namespace schlieren
{

namespace
{

/// Where a ray meets the film, and how much light of each channel arrives.
template <std::size_t Channels>
struct Spot
{
  double column, row;
  double light[Channels];
  std::int64_t ray;
};

/// One thread's part of the films.
template <std::size_t Channels, bool isTinted>
class Bands
{
public:
  explicit Bands(Films& films)
    : tint_(isTinted ? &*films.tintOfRays : nullptr)
  {
    for (std::size_t plane = 0; plane < bands_.size(); ++plane)
    {
      bands_[plane] = std::make_unique<FilmBand>(films.planes[plane]);
    }
  }

  void cover(std::int64_t lowest, std::int64_t highest)
  {
    for (const auto& band : bands_)
    {
      band->cover(lowest, highest);
    }
  }

  void splat(const Spot<Channels>& spot, const float* gathered)
  {
    const Footprint at = footprintOf(spot.column, spot.row);
    std::array<double, 3> color{ 1, 1, 1 };
    if constexpr (isTinted)
    {
      color = tint_->of(gathered + static_cast<std::size_t>(spot.ray) * tint_->colors.size());
    }
    if constexpr (Channels == 1)
    {
      bands_[0]->splat(at, spot.light[0]);
      for (std::size_t plane = 1; plane < bands_.size(); ++plane)
      {
        bands_[plane]->splat(at, spot.light[0] * color[plane - 1]);
      }
    }
    else
    {
      for (std::size_t plane = 0; plane < Channels; ++plane)
      {
        bands_[plane]->splat(at, spot.light[plane] * color[plane]);
      }
    }
  }

private:
  static constexpr std::size_t planes = Channels == 1 && isTinted ? 4 : Channels;

  const Tint* tint_;
  std::array<std::unique_ptr<FilmBand>, planes> bands_;
};

template <bool isTinted, class CutoffKind>
RayCounts exposeBy(const CutoffKind& cutoff, const std::vector<TracedRays>& passes,
  const Projection& projection, std::int64_t margin, int threads, Films& films)
{
  constexpr std::size_t channels = CutoffKind::channels;
  const Film& film = films.planes[0];
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
      Bands<channels, isTinted> bands(films);
      RayCounts countsHere;
      std::vector<Spot<channels>> spots(static_cast<std::size_t>(columns));
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
            const RayAtFilm ray =
              rayAtFilm(exit, startColumn + static_cast<double>(i), startRow, projection);
            const double column = ray.position[0];
            const double up = ray.position[1];
            if (exit.reachesFilm() && isOnFilm(column, up, film.width(), film.height()))
            {
              Spot<channels>& spot = spots[count++];
              spot.column = column;
              spot.row = up;
              spot.ray = first + i;
              cutoff.shade(ray, spot.light);
              ++countsHere.onFilm;
              countsHere.saturated += cutoff.saturates(ray) ? 1 : 0;
              lowest = std::min(lowest, up);
              highest = std::max(highest, up);
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

Films::Films(int channels, std::optional<Tint> tint, int width, int height, std::int64_t mostRays)
  : tintOfRays(std::move(tint))
{
  const int count = channels == 1 && tintOfRays ? 4 : channels;
  for (int plane = 0; plane < count; ++plane)
  {
    planes.emplace_back(width, height, mostRays);
  }
}

PixelArray<float> Films::developIntensity(double raysPerPixel, int threads) const
{
  PixelArray<float> picture = planes[0].develop(raysPerPixel, threads);
  if (planes.size() == 3)
  {
    const PixelArray<float> green = planes[1].develop(raysPerPixel, threads);
    const PixelArray<float> blue = planes[2].develop(raysPerPixel, threads);
    for (std::size_t pixel = 0; pixel < picture.size(); ++pixel)
    {
      // Of linear sRGB (IEC 61966-2-1).
      picture[pixel] = 0.2126f * picture[pixel] + 0.7152f * green[pixel] + 0.0722f * blue[pixel];
    }
  }
  return picture;
}

PixelArray<float> Films::developColor(double raysPerPixel, int threads) const
{
  PixelArray<float> picture(3 * planes[0].pixels());
  for (std::size_t channel = 0; channel < 3; ++channel)
  {
    const Film& film = planes[planes.size() - 3 + channel];
    const PixelArray<float> light = film.develop(raysPerPixel, threads);
    for (std::size_t pixel = 0; pixel < light.size(); ++pixel)
    {
      picture[3 * pixel + channel] = light[pixel];
    }
  }
  return picture;
}

RayCounts expose(const std::vector<TracedRays>& passes, const Cutoffs& cutoff,
  const Projection& projection, std::int64_t margin, int threads, Films& films)
{
  return std::visit(
    [&](const auto& kind)
    {
      return films.tintOfRays ? exposeBy<true>(kind, passes, projection, margin, threads, films)
                              : exposeBy<false>(kind, passes, projection, margin, threads, films);
    },
    cutoff);
}

} // namespace schlieren
