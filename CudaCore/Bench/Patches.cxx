// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Bench/Patches.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace schlieren
{

namespace
{

constexpr double pixelsOfSet = 1024; ///< of patches, about
constexpr std::int64_t around = 2;   ///< pixels, what the film knows of a pixel's neighbours

/// Chooses the places of patches.
class Planner
{
public:
  Planner(const Scouts& scouts, const View& view)
    : scouts_(scouts)
    , view_(view)
  {
  }

  PatchLayout layOut(std::int64_t margin, bool wantsAllPixels);

private:
  /// A square of pixels that may be a patch.
  struct Cell
  {
    std::int64_t column, row;
    double variation; ///< how much the rays there differ from their neighbours
  };
  using Cells = std::vector<Cell>;

  /// By their direction from the middle, so that no side is left out.
  static void sortAlongBorder(Cells& cells);
  void spread(const Cells& cells, double pixels, PatchPlace where);
  /// Aims a patch at where the light comes from that lands on it. False if that is from all over the image, or from
  /// outside, where no scouts are.
  bool findOrigin(Patch& patch) const;
  /// Whether light through a patch lands so far from it that others' light may be there instead.
  bool movesLightAway(const Patch& patch) const;
  void takeWholeIfCheaper(std::int64_t margin, bool isWanted);

  const Scouts& scouts_;
  const View& view_;
  PatchLayout layout_;
  std::int64_t lost_ = 0; ///< patches whose light comes from all over the image, or from outside
};

/// Divides the view into cells, of one scout or as large as a patch, and these into strata.
PatchLayout Planner::layOut(std::int64_t margin, bool wantsAllPixels)
{
  const std::int64_t stride = scouts_.stride();
  const std::int64_t size = (Patch::edge + stride - 1) / stride; // scouts
  const std::vector<double> variations = scouts_.variationsOnFilm();
  Cells within, atBodies, atBorders;
  for (std::int64_t row = 0; row < scouts_.rows(); row += size)
  {
    for (std::int64_t column = 0; column < scouts_.columns(); column += size)
    {
      bool hasCrossing = false, hasBody = false, hasBorder = false;
      double variation = 0;
      for (std::int64_t j = row - 1; j <= row + size; ++j)
      {
        for (std::int64_t i = column - 1; i <= column + size; ++i)
        {
          const Scout* scout = scouts_.at(i, j);
          if (!scout) // what is there is unknown
          {
            hasBorder = true;
            continue;
          }
          const bool isCrossing = scout->fate == RayFate::Left;
          hasCrossing = hasCrossing || isCrossing ||
            (scouts_.areOfExtendedSource() && scout->fate != RayFate::Missed);
          hasBorder = hasBorder || scout->fate == RayFate::Missed;
          hasBody = hasBody || (!isCrossing && scout->fate != RayFate::Missed);
          variation =
            std::max(variation, variations[static_cast<std::size_t>(j * scouts_.columns() + i)]);
        }
      }
      if (hasCrossing)
      {
        (hasBody        ? atBodies
            : hasBorder ? atBorders
                        : within)
          .push_back({ column * stride, row * stride, variation });
      }
    }
  }
  constexpr std::size_t perStrong = 12; // of so many cells one
  Cells sorted = within;
  const auto rank = static_cast<std::ptrdiff_t>(sorted.size() / perStrong);
  std::nth_element(sorted.begin(), sorted.begin() + rank, sorted.end(),
    [](const Cell& a, const Cell& b) { return a.variation > b.variation; });
  const double least = sorted.empty() ? 0 : sorted[static_cast<std::size_t>(rank)].variation;
  const auto weak = std::stable_partition(
    within.begin(), within.end(), [&](const Cell& cell) { return cell.variation > least; });
  spread(Cells(within.begin(), weak), 0.25 * pixelsOfSet, PatchPlace::Elsewhere);
  spread(Cells(weak, within.end()), 0.375 * pixelsOfSet, PatchPlace::Elsewhere);
  spread(atBodies, 0.25 * pixelsOfSet, PatchPlace::Body);
  sortAlongBorder(atBorders);
  spread(atBorders, 0.25 * pixelsOfSet, PatchPlace::Border);

  takeWholeIfCheaper(margin, wantsAllPixels);
  return std::move(layout_);
}

void Planner::sortAlongBorder(Cells& cells)
{
  double middle[2] = { 0, 0 };
  for (const Cell& cell : cells)
  {
    middle[0] += static_cast<double>(cell.column) / static_cast<double>(cells.size());
    middle[1] += static_cast<double>(cell.row) / static_cast<double>(cells.size());
  }
  const auto directionOf = [&](const Cell& cell)
  {
    return std::atan2(
      static_cast<double>(cell.row) - middle[1], static_cast<double>(cell.column) - middle[0]);
  };
  std::stable_sort(cells.begin(), cells.end(),
    [&](const Cell& a, const Cell& b) { return directionOf(a) < directionOf(b); });
}

/// Makes the image the only patch where that is wanted, where others miss their light, or where the rays around them are
/// more than that takes. Light that few scouts have met may be between the patches.
void Planner::takeWholeIfCheaper(std::int64_t margin, bool isWanted)
{
  double moved = 0;
  for (const Scout& scout : scouts_.all())
  {
    moved = std::max({ moved, std::abs(scout.moved[0]), std::abs(scout.moved[1]) });
  }
  const auto needed =
    static_cast<std::int64_t>(std::min(static_cast<double>(std::max(view_.width, view_.height)) / 2,
      static_cast<double>(around) + std::ceil(moved)));
  Patch whole{ 0, 0, 1, 0, 0, std::min(margin, needed), view_.width, view_.height };
  if (scouts_.areOfCamera())
  {
    whole.margin = around;
  }
  const auto raysOf = [](const Patch& patch)
  {
    return static_cast<double>(
      (patch.columns + 2 * patch.margin) * (patch.rows + 2 * patch.margin));
  };
  double rays = 0, patches = 0;
  for (const PatchSet& set : layout_.sets)
  {
    for (const PatchList& list : set)
    {
      for (const Patch& patch : list)
      {
        rays += raysOf(patch);
        ++patches;
      }
    }
  }
  constexpr double mostLost = 0.02, mostRays = 4; // of both sets
  constexpr double few = 0.03;
  const double crossing =
    static_cast<double>(scouts_.view().crossed) / static_cast<double>(scouts_.all().size());
  const bool isNarrow =
    patches == 0 || (crossing < few && crossing * raysOf(whole) < mostRays * rays);
  if (isWanted || isNarrow || static_cast<double>(lost_) > mostLost * patches ||
    rays > mostRays * raysOf(whole))
  {
    layout_.isWhole = true;
    layout_.sets[0] = { { { whole }, {}, {} } };
    layout_.sets[1] = {};
  }
}

/// Puts patches with so many pixels into each set, in some of these cells: one of each few, in the order of rows, so that no
/// column is left out.
void Planner::spread(const Cells& cells, double pixels, PatchPlace where)
{
  constexpr std::int64_t edge = Patch::edge;
  const std::int64_t size =
    std::max(scouts_.stride(), (edge + scouts_.stride() - 1) / scouts_.stride() * scouts_.stride());
  const auto within = [&](std::int64_t first, std::int64_t pixelsOfView)
  { return std::max<std::int64_t>(0, std::min(first + (size - edge) / 2, pixelsOfView - edge)); };
  const auto most = static_cast<std::size_t>(2 * pixels / static_cast<double>(edge * edge));
  const std::size_t places = std::min(cells.size(), most);
  const double weight = static_cast<double>(cells.size()) * static_cast<double>(size * size) /
    (0.5 * static_cast<double>(places) * static_cast<double>(edge * edge));
  for (std::size_t n = 0; n < places; ++n)
  {
    constexpr double goldenRatio = 0.6180339887498949;
    const double jitter = std::fmod(goldenRatio * static_cast<double>(n + 1), 1.);
    const double perPlace = static_cast<double>(cells.size()) / static_cast<double>(places);
    const Cell& cell =
      cells[static_cast<std::size_t>((static_cast<double>(n) + jitter) * perPlace)];
    const std::int64_t column = within(cell.column, view_.width),
                       row = within(cell.row, view_.height);
    Patch patch{ column, row, weight, column, row };
    lost_ += findOrigin(patch) ? 0 : 1;
    layout_.sets[n % 2][static_cast<std::size_t>(where)].push_back(patch);
  }
}

/// Looks at the squares between four scouts: which of them are spread over the patch?
bool Planner::findOrigin(Patch& patch) const
{
  constexpr double mostAround = 24;
  const double low[2] = { static_cast<double>(patch.column) - 1,
    static_cast<double>(patch.row) - 1 };
  double least[2] = { 0, 0 }, most[2] = { 0, 0 };
  bool isFound = false;
  for (std::int64_t row = 0; row + 1 < scouts_.rows() && !scouts_.areOfCamera(); ++row)
  {
    for (std::int64_t column = 0; column + 1 < scouts_.columns(); ++column)
    {
      constexpr double infinite = std::numeric_limits<double>::infinity();
      double lowMoved[2] = { infinite, infinite }, highMoved[2] = { -infinite, -infinite };
      double lowPlace[2] = { infinite, infinite }, highPlace[2] = { -infinite, -infinite };
      for (std::int64_t corner = 0; corner < 4; ++corner)
      {
        const std::int64_t at[2] = { column + corner % 2, row + corner / 2 };
        const Scout& scout = *scouts_.at(at[0], at[1]);
        if (scout.fate != RayFate::Left && scout.fate != RayFate::Missed)
        {
          continue;
        }
        for (std::size_t axis = 0; axis < 2; ++axis)
        {
          const double place =
            (static_cast<double>(at[axis]) + 0.5) * static_cast<double>(scouts_.stride()) - 0.5 +
            scout.moved[axis];
          lowMoved[axis] = std::min(lowMoved[axis], scout.moved[axis]);
          highMoved[axis] = std::max(highMoved[axis], scout.moved[axis]);
          lowPlace[axis] = std::min(lowPlace[axis], place);
          highPlace[axis] = std::max(highPlace[axis], place);
        }
      }
      bool isOver = true;
      for (std::size_t axis = 0; axis < 2; ++axis)
      {
        isOver = isOver && lowPlace[axis] <= low[axis] + static_cast<double>(Patch::edge) + 1 &&
          highPlace[axis] >= low[axis];
      }
      for (std::size_t axis = 0; axis < 2 && isOver; ++axis)
      {
        least[axis] = isFound ? std::min(least[axis], lowMoved[axis]) : lowMoved[axis];
        most[axis] = isFound ? std::max(most[axis], highMoved[axis]) : highMoved[axis];
      }
      isFound = isFound || isOver;
    }
  }
  double spreadOf = 0;
  std::int64_t moved[2] = { 0, 0 };
  for (std::size_t axis = 0; axis < 2; ++axis)
  {
    const double middle = scouts_.areShifted() ? std::round(0.5 * (least[axis] + most[axis])) : 0;
    moved[axis] = static_cast<std::int64_t>(middle);
    spreadOf = std::max({ spreadOf, most[axis] - middle, middle - least[axis] });
  }
  patch.fromColumn = patch.column - moved[0];
  patch.fromRow = patch.row - moved[1];
  patch.margin = static_cast<std::int64_t>(
    std::min(static_cast<double>(around) + std::ceil(spreadOf), mostAround));
  return spreadOf <= mostAround && (isFound || scouts_.areOfCamera() || !movesLightAway(patch));
}

bool Planner::movesLightAway(const Patch& patch) const
{
  const std::int64_t stride = scouts_.stride();
  double farthest = 0;
  for (std::int64_t row = patch.row / stride - 1; row * stride <= patch.row + Patch::edge; ++row)
  {
    for (std::int64_t column = patch.column / stride - 1;
         column * stride <= patch.column + Patch::edge; ++column)
    {
      const Scout* scout = scouts_.at(column, row);
      if (scout && scout->fate == RayFate::Left)
      {
        farthest = std::max({ farthest, std::abs(scout->moved[0]), std::abs(scout->moved[1]) });
      }
    }
  }
  return farthest > static_cast<double>(stride + Patch::edge);
}

} // namespace

PatchLayout layOutPatches(
  const Scouts& scouts, const View& view, std::int64_t margin, bool wantsAllPixels)
{
  return Planner(scouts, view).layOut(margin, wantsAllPixels);
}

} // namespace schlieren
