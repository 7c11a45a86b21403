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

PatchList EdgeTiles::in(const PixelArray<float>& blockedFraction, const View& view, double moved)
{
  constexpr std::int64_t edge = Patch::edge, longest = 16; // tiles
  const std::int64_t around = 1 + std::llround(moved);
  const std::int64_t columns = (view.width + edge - 1) / edge,
                     rows = (view.height + edge - 1) / edge;
  std::vector<bool> isWanted(static_cast<std::size_t>(columns * rows));
  const auto isEdgeIn = [&](std::int64_t left, std::int64_t low)
  {
    bool stopsSome = false, stopsAll = true;
    for (std::int64_t row = std::max<std::int64_t>(0, low - around);
         row < std::min<std::int64_t>(view.height, low + edge + around); ++row)
    {
      for (std::int64_t column = std::max<std::int64_t>(0, left - around);
           column < std::min<std::int64_t>(view.width, left + edge + around); ++column)
      {
        const float blocked = blockedFraction[static_cast<std::size_t>(row * view.width + column)];
        stopsSome = stopsSome || blocked > 0;
        stopsAll = stopsAll && blocked >= 1;
      }
    }
    return stopsSome && !stopsAll;
  };
  for (std::size_t n = 0; n < isWanted.size(); ++n)
  {
    const auto tile = static_cast<std::int64_t>(n);
    isWanted[n] = isEdgeIn(tile % columns * edge, tile / columns * edge);
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

RaysOfTiles::RaysOfTiles(
  PatchList::const_iterator first, PatchList::const_iterator end, int samples)
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
  const auto fill = [&](const Patch& with, int value)
  {
    for (std::int64_t row = with.row - with.margin; row < with.row + with.rows + with.margin; ++row)
    {
      std::fill_n(
        &rectangleAt(with.column - with.margin, row), with.columns + 2 * with.margin, value);
    }
  };
  std::for_each(first, end, [&](const Patch& tile) { fill(tile, missing); });
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
        fill(rectangles_.back(), static_cast<int>(rectangles_.size()) - 1);
        firstRays_.push_back(count);
        count += static_cast<std::size_t>(samples * columns * rows);
      }
    }
  }
}

std::size_t RaysOfTiles::ray(std::int64_t column, std::int64_t row, int pass) const
{
  const auto n = static_cast<std::size_t>(
    rectangleAt_[static_cast<std::size_t>((row - low_) * columns_ + column - left_)]);
  const Patch& of = rectangles_[n];
  return firstRays_[n] +
    static_cast<std::size_t>((pass * of.rows + row - of.row) * of.columns + column - of.column);
}

} // namespace schlieren
