// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Film/Deposit.h"

#include "Film/Sheet.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <utility>

namespace schlieren
{

namespace
{

/// The rows of the films that one thread writes.
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

  /// Makes quick what is added where rays land.
  void cover(const RowRange& lands)
  {
    if (lands.lowest > lands.highest)
    {
      return;
    }
    const auto lowest = static_cast<std::int64_t>(std::floor(lands.lowest));
    const auto highest = static_cast<std::int64_t>(std::floor(lands.highest));
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
  void block(int plane, std::int64_t column, std::int64_t row, const Contributions& contributions)
  {
    of(plane).add(column, row, contributions);
  }

private:
  FilmBand& of(int plane) { return *bands_[static_cast<std::size_t>(plane)]; }

  std::array<std::unique_ptr<FilmBand>, planes> bands_;
};

template <bool isOfPhase, int planes>
void addSheet(std::int64_t begin, std::int64_t end, const std::vector<TracedRays>& passes,
  const RowShader<planes>& shader, const FilmSize& film, Bands<planes>& bands, RayCounts& counts)
{
  using Ray = FilmRay<planes>;
  using Row = std::vector<Ray>;
  Sheet<planes, Bands<planes>, coverageTileSize, isOfPhase> sheet(film, bands);
  const auto columns = static_cast<std::size_t>(shader.columns);
  // With a ray that does not arrive at either end, as in rows outside.
  const Row none(columns + 2, Ray{});
  std::array<Row, 4> rows{ none, none, none, none };
  std::array<RowRange, 4> lands;
  std::vector<SheetRay<planes>> lower(columns), upper(columns);
  RayBox<planes, Bands<planes>, coverageTileSize, isOfPhase> box(film, bands);
  RayCounts ofOthers;
  for (const TracedRays& pass : passes)
  {
    const auto slotOf = [](std::int64_t row) { return static_cast<std::size_t>((row + 4) % 4); };
    const auto load = [&](std::int64_t row)
    {
      const std::size_t slot = slotOf(row);
      if (row < 0 || row >= shader.rows)
      {
        rows[slot] = none;
        return;
      }
      lands[slot] = shader.shade(
        pass, row, rows[slot].data() + 1, row >= begin && row < end ? counts : ofOthers);
    };
    const auto smooth = [&](std::int64_t row, std::vector<SheetRay<planes>>& to)
    {
      const Ray* below = rows[slotOf(row - 1)].data() + 1;
      const Ray* here = rows[slotOf(row)].data() + 1;
      const Ray* above = rows[slotOf(row + 1)].data() + 1;
      for (std::size_t i = 0; i < columns; ++i)
      {
        to[i] = sheetRay<isOfPhase>(here[i], here[i - 1], here[i + 1], below[i], above[i]);
      }
    };
    load(begin - 1);
    load(begin);
    if (pass.pass.side < 1)
    {
      for (std::int64_t row = begin; row < end; ++row)
      {
        load(row + 1);
        const RowRange& here = lands[slotOf(row)];
        // Boxes are no higher than a pixel unless rays part by more.
        bands.cover({ here.lowest - 0.5, here.highest + 0.5 });
        const Ray* at = rows[slotOf(row)].data() + 1;
        for (std::size_t i = 0; i < columns; ++i, ++at)
        {
          box.add(*at, at[-1], at[1], rows[slotOf(row - 1)][i + 1], rows[slotOf(row + 1)][i + 1],
            pass.pass.side);
        }
      }
      continue;
    }
    load(begin + 1);
    smooth(begin, lower);
    for (std::int64_t row = begin; row < std::min(end, shader.rows - 1); ++row)
    {
      load(row + 2);
      smooth(row + 1, upper);
      const RowRange& below = lands[slotOf(row)];
      const RowRange& above = lands[slotOf(row + 1)];
      bands.cover({ std::min(below.lowest, above.lowest), std::max(below.highest, above.highest) });
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

} // namespace

template <int planes>
RayCounts depositRows(std::int64_t begin, std::int64_t end, const std::vector<TracedRays>& passes,
  const RowShader<planes>& shader, Films& films)
{
  const FilmSize film{ films.planes[0].width(), films.planes[0].height(), films.planes[0].one() };
  RayCounts counts;
  Bands<planes> bands(films);
  if (shader.isOfPhase)
  {
    addSheet<true>(begin, end, passes, shader, film, bands, counts);
  }
  else
  {
    addSheet<false>(begin, end, passes, shader, film, bands, counts);
  }
  return counts;
}

template RayCounts depositRows<1>(
  std::int64_t, std::int64_t, const std::vector<TracedRays>&, const RowShader<1>&, Films&);
template RayCounts depositRows<3>(
  std::int64_t, std::int64_t, const std::vector<TracedRays>&, const RowShader<3>&, Films&);

} // namespace schlieren
