// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Bench/EdgeTiles.h"

#include "Bench/StageSettings.h"

#include <algorithm>
#include <limits>

namespace schlieren
{

bool EdgeTiles::arePossible(const Scene& scene, const Light& light, double moved)
{
  constexpr double mostMoved = 2.5;
  return moved <= mostMoved && techniqueOf(scene.cutoff).plane == RecordedPlane::Focus &&
    !isOfCamera(scene.cutoff) && !(light.pupilTilt > 0) && scene.smoothingRadius <= 0;
}

EdgePixels::EdgePixels(
  const std::vector<RaysOfPixel>& rays, std::int64_t columns, std::int64_t around)
  : around_(around)
  , stride_(columns + 2 * around)
  , lit_(rays.size())
  , lighting_(rays.size())
{
  const auto rows = static_cast<std::int64_t>(rays.size()) / stride_;
  // Calls visit(pixel) for those whose middles are no farther than `reach`, along either axis, from that of a pixel's light.
  const auto visitAround = [&](std::size_t n, const double(&moved)[2], double reach, auto visit)
  {
    const double column = static_cast<double>(static_cast<std::int64_t>(n) % stride_) + moved[0];
    const double row = static_cast<double>(static_cast<std::int64_t>(n) / stride_) + moved[1];
    const auto within = [](double place, std::int64_t count)
    { return static_cast<std::int64_t>(std::clamp(place, 0., static_cast<double>(count))); };
    const std::int64_t endRow = within(std::floor(row + reach) + 1, rows),
                       endColumn = within(std::floor(column + reach) + 1, stride_);
    for (std::int64_t j = within(std::ceil(row - reach), rows); j < endRow; ++j)
    {
      for (std::int64_t i = within(std::ceil(column - reach), stride_); i < endColumn; ++i)
      {
        visit(static_cast<std::size_t>(j * stride_ + i));
      }
    }
  };
  for (std::size_t n = 0; n < rays.size(); ++n)
  {
    bool stopsSome = false, stopsAll = true;
    visitAround(n, { 0, 0 }, 1,
      [&](std::size_t beside)
      {
        stopsSome = stopsSome || rays[beside].blocked > 0;
        stopsAll = stopsAll && rays[beside].blocked >= 1;
      });
    if (stopsSome && !stopsAll)
    {
      constexpr double reach = 2.5; // two pixels around the one where light lands
      lit_[n] = true;
      if (rays[n].blocked < 1)
      {
        visitAround(n, rays[n].moved, reach, [&](std::size_t where) { lit_[where] = true; });
      }
    }
  }
  for (std::size_t n = 0; n < rays.size(); ++n)
  {
    bool isLighting = lit_[n];
    if (rays[n].blocked < 1)
    {
      visitAround(n, rays[n].moved, EdgeTiles::reachOfRays,
        [&](std::size_t where) { isLighting = isLighting || lit_[where]; });
    }
    lighting_[n] = isLighting;
  }
}

PatchList EdgeTiles::in(const EdgePixels& pixels, const View& view, double moved)
{
  constexpr std::int64_t edge = Patch::edge, longest = 16; // tiles
  const std::int64_t columns = (view.width + edge - 1) / edge,
                     rows = (view.height + edge - 1) / edge;
  std::vector<bool> isWanted(static_cast<std::size_t>(columns * rows));
  for (std::int64_t row = 0; row < view.height; ++row)
  {
    for (std::int64_t column = 0; column < view.width; ++column)
    {
      const auto tile = static_cast<std::size_t>(row / edge * columns + column / edge);
      isWanted[tile] = isWanted[tile] || pixels.isLit(column, row);
    }
  }
  PatchList tiles;
  for (std::int64_t row = 0; row < rows; ++row)
  {
    for (std::int64_t column = 0; column < columns; ++column)
    {
      const auto countFrom = [&](std::int64_t right, std::int64_t up)
      {
        std::int64_t count = 0;
        for (std::int64_t i = column, j = row; i < columns && j < rows && count < longest &&
             isWanted[static_cast<std::size_t>(j * columns + i)];
             i += right, j += up)
        {
          ++count;
        }
        return count;
      };
      const std::int64_t along = countFrom(1, 0), upwards = countFrom(0, 1);
      if (along == 0)
      {
        continue;
      }
      const std::int64_t wide = along >= upwards ? along : 1, high = along >= upwards ? 1 : upwards;
      for (std::int64_t n = 0; n < wide * high; ++n)
      {
        isWanted[static_cast<std::size_t>((row + n / wide) * columns + column + n % wide)] = false;
      }
      const std::int64_t left = column * edge, low = row * edge;
      tiles.push_back({ left, low, 1, left, low, marginFor(moved),
        std::min(wide * edge, view.width - left), std::min(high * edge, view.height - low) });
    }
  }
  return tiles;
}

RaysOfTiles::RaysOfTiles(PatchList::const_iterator first, PatchList::const_iterator end,
  const EdgePixels& pixels, int samples)
  : left_(std::numeric_limits<std::int64_t>::max())
  , low_(left_)
{
  constexpr int outside = -2, missing = -1;
  std::int64_t right = std::numeric_limits<std::int64_t>::min(), high = right;
  std::for_each(first, end,
    [&](const Patch& tile)
    {
      left_ = std::min(left_, tile.column - tile.margin);
      low_ = std::min(low_, tile.row - tile.margin);
      right = std::max(right, tile.column + tile.columns + tile.margin);
      high = std::max(high, tile.row + tile.rows + tile.margin);
    });
  columns_ = right - left_;
  rectangleAt_.assign(static_cast<std::size_t>(columns_ * (high - low_)), outside);
  const auto forEachPixel = [](const Patch& tile, const auto& use)
  {
    for (std::int64_t row = tile.row - tile.margin; row < tile.row + tile.rows + tile.margin; ++row)
    {
      for (std::int64_t column = tile.column - tile.margin;
           column < tile.column + tile.columns + tile.margin; ++column)
      {
        use(column, row);
      }
    }
  };
  std::for_each(first, end,
    [&](const Patch& tile)
    {
      forEachPixel(tile,
        [&](std::int64_t column, std::int64_t row)
        { rectangleAt(column, row) = pixels.hasRays(column, row) ? missing : outside; });
    });
  std::size_t count = 0;
  for (std::int64_t row = low_; row < high; ++row)
  {
    for (std::int64_t column = left_; column < right; ++column)
    {
      const auto missingFrom = [&](std::int64_t inRow)
      {
        std::int64_t to = column;
        while (to < right && rectangleAt(to, inRow) == missing)
        {
          ++to;
        }
        return to - column;
      };
      const std::int64_t columns = missingFrom(row);
      if (columns > 0)
      {
        std::int64_t rows = 1;
        while (row + rows < high && missingFrom(row + rows) >= columns)
        {
          ++rows;
        }
        rectangles_.push_back({ column, row, 1, column, row, 0, columns, rows });
        forEachPixel(rectangles_.back(),
          [&, number = static_cast<int>(rectangles_.size()) - 1](std::int64_t i, std::int64_t j)
          { rectangleAt(i, j) = number; });
        firstRays_.push_back(count);
        count += static_cast<std::size_t>(samples * columns * rows);
      }
    }
  }
}

std::optional<std::size_t> RaysOfTiles::ray(std::int64_t column, std::int64_t row, int pass) const
{
  const int number =
    rectangleAt_[static_cast<std::size_t>((row - low_) * columns_ + column - left_)];
  if (number < 0)
  {
    return {};
  }
  const auto n = static_cast<std::size_t>(number);
  const Patch& of = rectangles_[n];
  return firstRays_[n] +
    static_cast<std::size_t>((pass * of.rows + row - of.row) * of.columns + column - of.column);
}

} // namespace schlieren
