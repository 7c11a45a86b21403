// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Film/Exposure.h"

#include "Device/Parallel.h"
#include "Film/Sheet.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <mutex>
#include <numeric>
#include <utility>
#include <variant>

namespace schlieren
{

namespace
{

/// Of linear sRGB (IEC 61966-2-1).
constexpr double luminance[3] = { 0.2126, 0.7152, 0.0722 };

/// Where on the film rays land; nowhere at first.
struct RowRange
{
  double lowest = std::numeric_limits<double>::infinity();
  double highest = -std::numeric_limits<double>::infinity();

  void add(double y)
  {
    lowest = std::min(lowest, y);
    highest = std::max(highest, y);
  }
};

/// One thread's part of the films.
template <int planes>
class Bands
{
public:
  explicit Bands(Films& films)
  {
    for (std::size_t plane = 0; plane < planes; ++plane)
    {
      bands_[plane] = std::make_unique<FilmBand>(films.planes[plane]);
    }
  }

  /// Makes quick what is added `higher` than where rays land.
  void cover(const RowRange& lands, double higher)
  {
    if (lands.lowest > lands.highest)
    {
      return;
    }
    const auto lowest = static_cast<std::int64_t>(std::floor(lands.lowest + higher));
    const auto highest = static_cast<std::int64_t>(std::floor(lands.highest + higher));
    for (const auto& band : bands_)
    {
      band->cover(lowest, highest);
    }
  }

  // As Sheet wants it.
  void emitted(int plane, std::int64_t light) { of(plane).addEmitted(light); }
  void outside(int plane, std::int64_t light) { of(plane).addOutside(light); }
  void pixel(int plane, std::int64_t column, std::int64_t row, std::int64_t light)
  {
    of(plane).add(column, row, light);
  }
  void block(int plane, std::int64_t column, std::int64_t row, const Shares& shares)
  {
    of(plane).add(column, row, shares);
  }

private:
  FilmBand& of(int plane) { return *bands_[static_cast<std::size_t>(plane)]; }

  std::array<std::unique_ptr<FilmBand>, planes> bands_;
};

/// A picture's rays as they meet the film, row by row of where they start.
template <bool isTinted, class CutoffKind>
class RaysAtFilm
{
public:
  static constexpr int channels = CutoffKind::channels;
  static constexpr int planes = channels == 1 && isTinted ? 4 : channels;
  using Ray = FilmRay<planes>;

  RaysAtFilm(
    const CutoffKind& cutoff, const Projection& projection, const Films& films, std::int64_t margin)
    : columns(films.planes[0].width() + 2 * margin)
    , rows(films.planes[0].height() + 2 * margin)
    , cutoff_(cutoff)
    , projection_(projection)
    , tint_(isTinted ? &*films.tintOfRays : nullptr)
    , margin_(margin)
    , width_(static_cast<double>(films.planes[0].width()))
    , height_(static_cast<double>(films.planes[0].height()))
  {
  }

  const std::int64_t columns, rows;

  /// The rays of a pass that start in a row (from 0 on). Returns the rows of the film (from the first to the
  /// last pixel) that some of them land in. Apart, so that what it calls is compiled into it.
  SCHLIEREN_APART RowRange load(
    const TracedRays& pass, std::int64_t row, Ray* rays, RayCounts& counts) const
  {
    const std::int64_t first = pass.rayOf(-margin_, row - margin_);
    const double startColumn = static_cast<double>(-margin_) + pass.pass.offset.column;
    const double startRow = static_cast<double>(row - margin_) + pass.pass.offset.row;
    const bool isRowOfPicture = row >= margin_ && row < rows - margin_;
    RowRange lands;
    for (std::int64_t i = 0; i < columns; ++i)
    {
      const RayExit& exit = pass.exits[first + i];
      counts.add(exit);
      if (isRowOfPicture && i >= margin_ && i < columns - margin_)
      {
        counts.addShaded(exit, cutoff_);
      }
      Ray& ray = rays[i];
      ray.arrives = exit.reachesFilm();
      ray.crossed = crossedOnTheWay(exit, projection_);
      if (ray.arrives)
      {
        const RayAtFilm atFilm = rayAtFilm(
          exit, startColumn + static_cast<double>(i), startRow, pass.pass.tilt, projection_);
        const double x = atFilm.place[0] + 0.5;
        const double y = atFilm.place[1] + 0.5;
        ray.x = x;
        ray.y = y;
        shade(atFilm, pass.gathered, first + i, ray);
        if (x > -1 && x < width_ + 1 && y > -1 && y < height_ + 1)
        {
          lands.add(y);
        }
      }
    }
    return lands;
  }

private:
  void shade(const RayAtFilm& atFilm, const float* gathered, std::int64_t number, Ray& ray) const
  {
    double light[channels];
    cutoff_.shade(atFilm, light);
    if constexpr (!isTinted)
    {
      std::copy_n(light, channels, ray.light);
    }
    else
    {
      const std::array<double, 3> color =
        tint_->of(gathered + static_cast<std::size_t>(number) * tint_->colors.size());
      ray.light[0] = light[0];
      for (std::size_t plane = 0; plane < 3; ++plane)
      {
        ray.light[planes - 3 + plane] = light[channels == 1 ? 0 : plane] * color[plane];
      }
    }
  }

  const CutoffKind& cutoff_;
  const Projection& projection_;
  const Tint* tint_;
  std::int64_t margin_;
  double width_, height_;
};

/// Rays that start in rows `begin` ... `end` - 1, one by one.
template <class Rays, class Deposit>
void addPhotons(const Rays& source, const std::vector<TracedRays>& passes, std::int64_t begin,
  std::int64_t end, const FilmSize& film, Deposit& bands, RayCounts& counts)
{
  std::vector<typename Rays::Ray> rays(static_cast<std::size_t>(source.columns));
  for (std::int64_t row = begin; row < end; ++row)
  {
    for (const TracedRays& pass : passes)
    {
      // From half a pixel below where they land.
      bands.cover(source.load(pass, row, rays.data(), counts), -0.5);
      for (const auto& ray : rays)
      {
        addPhoton(ray, film, bands);
      }
    }
  }
}

/// Cells whose lower rays start in rows `begin` ... `end` - 1.
template <class Rays, class Deposit>
void addSheet(const Rays& source, const std::vector<TracedRays>& passes, std::int64_t begin,
  std::int64_t end, const FilmSize& film, Deposit& bands, RayCounts& counts)
{
  using Ray = typename Rays::Ray;
  using Row = std::vector<Ray>;
  Sheet<Rays::planes, Deposit> sheet(film, bands);
  const auto columns = static_cast<std::size_t>(source.columns);
  // With a ray that does not arrive at either end, as in rows outside.
  const Row none(columns + 2, Ray{});
  std::array<Row, 4> rows{ none, none, none, none };
  std::array<RowRange, 4> lands;
  std::vector<SheetRay<Rays::planes>> lower(columns), upper(columns);
  RayCounts ofOthers;
  for (const TracedRays& pass : passes)
  {
    const auto slotOf = [](std::int64_t row) { return static_cast<std::size_t>((row + 4) % 4); };
    const auto load = [&](std::int64_t row)
    {
      const std::size_t slot = slotOf(row);
      if (row < 0 || row >= source.rows)
      {
        rows[slot] = none;
        return;
      }
      lands[slot] = source.load(
        pass, row, rows[slot].data() + 1, row >= begin && row < end ? counts : ofOthers);
    };
    const auto smooth = [&](std::int64_t row, std::vector<SheetRay<Rays::planes>>& to)
    {
      const Ray* below = rows[slotOf(row - 1)].data() + 1;
      const Ray* here = rows[slotOf(row)].data() + 1;
      const Ray* above = rows[slotOf(row + 1)].data() + 1;
      for (std::size_t i = 0; i < columns; ++i)
      {
        to[i] = sheetRay(here[i], here[i - 1], here[i + 1], below[i], above[i]);
      }
    };
    load(begin - 1);
    load(begin);
    load(begin + 1);
    smooth(begin, lower);
    for (std::int64_t row = begin; row < std::min(end, source.rows - 1); ++row)
    {
      load(row + 2);
      smooth(row + 1, upper);
      const RowRange& below = lands[slotOf(row)];
      const RowRange& above = lands[slotOf(row + 1)];
      bands.cover(
        { std::min(below.lowest, above.lowest), std::max(below.highest, above.highest) }, 0);
      for (std::size_t i = 0; i + 1 < columns; ++i)
      {
        sheet.addCell(lower[i], lower[i + 1], upper[i], upper[i + 1],
          [&](int right, int up) -> const Ray&
          { return rows[slotOf(row + up)][i + static_cast<std::size_t>(1 + right)]; });
      }
      std::swap(lower, upper);
    }
  }
}

/// Rays that start in rows `begin` ... `end` - 1, counted from the margin's lowest on.
template <bool isTinted, class CutoffKind>
RayCounts exposeRows(std::int64_t begin, std::int64_t end, const CutoffKind& cutoff,
  const std::vector<TracedRays>& passes, const Projection& projection, std::int64_t margin,
  FilmEstimator estimator, Films& films)
{
  using Rays = RaysAtFilm<isTinted, CutoffKind>;
  const Rays rays(cutoff, projection, films, margin);
  const FilmSize film{ films.planes[0].width(), films.planes[0].height(), films.planes[0].one() };
  RayCounts counts;
  Bands<Rays::planes> bands(films);
  if (estimator == FilmEstimator::Sheet)
  {
    addSheet(rays, passes, begin, end, film, bands, counts);
  }
  else
  {
    addPhotons(rays, passes, begin, end, film, bands, counts);
  }
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

LightBalance Films::balance(double raysPerPixel) const
{
  LightBalance all;
  for (std::size_t plane = 0; plane < (planes.size() == 3 ? 3 : 1); ++plane)
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
  PixelArray<float> picture = planes[0].develop(raysPerPixel, threads);
  if (planes.size() == 3)
  {
    const PixelArray<float> green = planes[1].develop(raysPerPixel, threads);
    const PixelArray<float> blue = planes[2].develop(raysPerPixel, threads);
    for (std::size_t pixel = 0; pixel < picture.size(); ++pixel)
    {
      picture[pixel] = static_cast<float>(luminance[0] * static_cast<double>(picture[pixel]) +
        luminance[1] * static_cast<double>(green[pixel]) +
        luminance[2] * static_cast<double>(blue[pixel]));
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
  const Projection& projection, std::int64_t margin, FilmEstimator estimator, int threads,
  Films& films)
{
  std::int64_t firstRow = 0;
  return exposeFrom(
    firstRow, passes, cutoff, projection, margin, estimator, threads, films, Monitor{});
}

RayCounts exposeFrom(std::int64_t& firstRow, const std::vector<TracedRays>& passes,
  const Cutoffs& cutoff, const Projection& projection, std::int64_t margin, FilmEstimator estimator,
  int threads, Films& films, const Monitor& monitor)
{
  constexpr std::int64_t piecesPerThread = 4;
  constexpr std::int64_t fewestRows = 16;
  constexpr std::int64_t mostRowsToPause = 64;
  const std::int64_t rows = films.planes[0].height() + 2 * margin;
  std::int64_t rowsPerPiece = std::max(fewestRows, rows / (piecesPerThread * threadCount(threads)));
  if (monitor.paused)
  {
    rowsPerPiece = std::min(rowsPerPiece, mostRowsToPause);
  }
  RayCounts counts;
  std::mutex countsLock;
  const std::int64_t done = parallelFrom(
    firstRow, rows, rowsPerPiece, threads,
    [&](std::int64_t begin, std::int64_t end)
    {
      if (films.samples)
      {
        exposeRows<false>(
          begin, end, Shadowgraph{}, passes, projection, margin, estimator, *films.samples);
      }
      const RayCounts countsHere = std::visit(
        [&](const auto& kind)
        {
          return films.tintOfRays
            ? exposeRows<true>(begin, end, kind, passes, projection, margin, estimator, films)
            : exposeRows<false>(begin, end, kind, passes, projection, margin, estimator, films);
        },
        cutoff);
      const std::lock_guard<std::mutex> guard(countsLock);
      counts.add(countsHere);
    },
    monitor);
  firstRow = done < rows ? done : 0;
  return counts;
}

} // namespace schlieren
