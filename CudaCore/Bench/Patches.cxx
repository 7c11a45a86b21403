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

constexpr std::int64_t around = 2; ///< pixels, what the film knows of a pixel's neighbours
/// Pixels by which light may land beside where it starts and comes from no farther than that: a cell between rays is half as
/// wide.
constexpr double halfCell = 0.5;

/// Patches of both sets, at the most. Of n independent ones all miss what covers a part f of the pixels with a probability
/// of (1 - f)^n: of 100, for 2 and 3 %, 0.13 and 0.05. Spread as they are they miss a disc with 0.01 and 0.001, a band along
/// columns with 0.06 and 0.01, one along rows with 0.01 and less; what is scattered all over the image as independent ones.
constexpr std::size_t patchesElsewhere = 100;
constexpr std::size_t patchesAtBodies = 32, patchesAtBorders = 32, patchesAtVariations = 32;

/// Of the pixels whose light crosses the data, about, for finer voxels. These take eight times as long to make.
constexpr double partOfVoxels = 0.03;
constexpr double fewestOfVoxels = 40; ///< patches: all miss a square of 6 % of the image with 0.04

/// Chooses the places of patches.
class Planner
{
public:
  Planner(const Scouts& scouts, const View& view)
    : scouts_(scouts)
    , view_(view)
  {
  }

  PatchLayout layOut(std::int64_t margin);

private:
  /// A square of pixels that may be a patch.
  struct Cell
  {
    std::int64_t column, row;
    double variation; ///< how much the rays there differ from their neighbours
  };
  using Cells = std::vector<Cell>;

  /// The rays between four scouts: where they land, and how far they are moved.
  struct Quad
  {
    double lowPlace[2], highPlace[2], lowMoved[2], highMoved[2];
  };
  void makeQuads();

  /// By their direction from the middle, so that no side is left out.
  static void sortAlongBorder(Cells& cells);
  void spread(const Cells& cells, std::size_t most, PatchPlace where);
  /// Aims a patch at where the light comes from that lands on it. False if that is from all over the image, or from
  /// outside, where no scouts are.
  bool findOrigin(Patch& patch) const;
  /// Whether light through a patch lands so far from it that others' light may be there instead.
  bool movesLightAway(const Patch& patch) const;
  void takeWholeIfCheaper(std::int64_t margin);

  const Scouts& scouts_;
  const View& view_;
  std::vector<Quad> quads_;
  PatchLayout layout_;
  std::size_t everyOfVoxels_ = 1; ///< patches one that is looked at with finer voxels
  std::int64_t lost_ = 0; ///< patches whose light comes from all over the image, or from outside
};

/// Divides the view into cells, of one scout or as large as a patch, and these into strata.
PatchLayout Planner::layOut(std::int64_t margin)
{
  const std::int64_t stride = scouts_.stride();
  const std::int64_t size = (Patch::edge + stride - 1) / stride; // scouts
  const std::vector<double> variations = scouts_.variationsOnFilm();
  Cells within, atBodies, atBorders;
  makeQuads();
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
  const Cells strong(within.begin(), weak), others(weak, within.end());
  constexpr auto edgeWithMargin = static_cast<double>(Patch::edge + 2 * around);
  const double crossing =
    static_cast<double>(scouts_.view().crossed) * static_cast<double>(stride * stride);
  const double ofVoxels =
    std::max(fewestOfVoxels, partOfVoxels * crossing / (edgeWithMargin * edgeWithMargin));
  const std::size_t all = std::min(strong.size(), patchesAtVariations) +
    std::min(others.size(), patchesElsewhere) + std::min(atBodies.size(), patchesAtBodies) +
    std::min(atBorders.size(), patchesAtBorders);
  everyOfVoxels_ = std::max<std::size_t>(
    1, static_cast<std::size_t>(std::ceil(static_cast<double>(all) / ofVoxels)));
  spread(strong, patchesAtVariations, PatchPlace::Elsewhere);
  spread(others, patchesElsewhere, PatchPlace::Elsewhere);
  spread(atBodies, patchesAtBodies, PatchPlace::Body);
  sortAlongBorder(atBorders);
  spread(atBorders, patchesAtBorders, PatchPlace::Border);

  takeWholeIfCheaper(margin);
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

/// Makes the image the only patch where others miss their light, or where the rays around them are
/// more than that takes. Light that few scouts have met may be between the patches.
void Planner::takeWholeIfCheaper(std::int64_t margin)
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
  if (isNarrow || static_cast<double>(lost_) > mostLost * patches ||
    rays > mostRays * raysOf(whole))
  {
    layout_.isWhole = true;
    layout_.sets[0] = { { { whole }, {}, {} } };
    layout_.sets[1] = {};
  }
}

/// Puts patches into both sets, in some of these cells: evenly over their order, and in each row, but at borders, by
/// multiples of the golden ratio, as points of Hammersley's set are. Patches are tiles of the image, and each is another
/// one of those of its cell: they see all pixels equally, whatever repeats from cell to cell, and have none in common.
void Planner::spread(const Cells& cells, std::size_t most, PatchPlace where)
{
  const bool areInRows = where != PatchPlace::Border;
  constexpr std::int64_t edge = Patch::edge;
  const std::int64_t size =
    std::max(scouts_.stride(), (edge + scouts_.stride() - 1) / scouts_.stride() * scouts_.stride());
  const std::size_t places = std::min(cells.size(), most);
  const double perPlace = static_cast<double>(cells.size()) / static_cast<double>(places);
  std::vector<bool> isTaken(cells.size(), false);
  for (std::size_t n = 0; n < places; ++n)
  {
    const auto fraction = [&](double factor)
    { return std::fmod(factor * static_cast<double>(n + 1), 1.); };
    constexpr double goldenRatio = 0.6180339887498949, rootOfTwo = 1.4142135623730950;
    const auto at = static_cast<std::size_t>(
      (static_cast<double>(n) + fraction(areInRows ? rootOfTwo : goldenRatio)) * perPlace);
    std::size_t taken = at;
    if (areInRows)
    {
      const auto isBelow = [](const Cell& a, const Cell& b) { return a.row < b.row; };
      const auto row = std::equal_range(cells.begin(), cells.end(), cells[at], isBelow);
      taken = static_cast<std::size_t>(row.first - cells.begin()) +
        static_cast<std::size_t>(
          fraction(goldenRatio) * static_cast<double>(row.second - row.first));
    }
    while (isTaken[taken])
    {
      taken = (taken + 1) % cells.size();
    }
    isTaken[taken] = true;
    const Cell& cell = cells[taken];
    std::int64_t tiles = 1; // of the cell
    const auto within = [&](std::int64_t first, std::int64_t pixelsOfView, double part)
    {
      const std::int64_t begin = (first + edge - 1) / edge;
      const std::int64_t end = (std::min(first + size, pixelsOfView) + edge - 1) / edge;
      const std::int64_t count = std::max<std::int64_t>(1, end - begin);
      tiles *= count;
      const auto tile = static_cast<std::int64_t>(part * static_cast<double>(count));
      return std::max<std::int64_t>(0, std::min((begin + tile) * edge, pixelsOfView - edge));
    };
    // One over the only positive root of x^3 = x + 1, and its square, fill a plane as the golden ratio does a line.
    constexpr double plastic = 0.7548776662466927;
    const std::int64_t column = within(cell.column, view_.width, fraction(plastic)),
                       row = within(cell.row, view_.height, fraction(plastic * plastic));
    Patch patch{ column, row, 2 * perPlace * static_cast<double>(tiles), column, row };
    lost_ += findOrigin(patch) ? 0 : 1;
    layout_.sets[n % 2][static_cast<std::size_t>(where)].push_back(patch);
    // One of so many, but not each fifth or eighth: by multiples of the golden ratio these are in few columns.
    const std::size_t turn = n / everyOfVoxels_, first = turn * everyOfVoxels_;
    const double ofTurn = std::fmod(rootOfTwo * static_cast<double>(turn + 1), 1.) *
      static_cast<double>(std::min(everyOfVoxels_, places - first));
    if (n == first + static_cast<std::size_t>(ofTurn))
    {
      layout_.ofVoxels[static_cast<std::size_t>(where)].push_back(patch);
      if (turn % 3 == 0)
      {
        layout_.someOfVoxels[static_cast<std::size_t>(where)].push_back(patch);
      }
    }
  }
}

/// What is beyond the outermost scouts moves as these do.
void Planner::makeQuads()
{
  if (scouts_.areOfCamera())
  {
    return;
  }
  const std::int64_t counts[2] = { scouts_.columns(), scouts_.rows() };
  const double last[2] = { static_cast<double>(view_.width - 1),
    static_cast<double>(view_.height - 1) };
  for (std::int64_t row = 0; row + 1 < counts[1]; ++row)
  {
    for (std::int64_t column = 0; column + 1 < counts[0]; ++column)
    {
      constexpr double infinite = std::numeric_limits<double>::infinity();
      Quad quad{ { infinite, infinite }, { -infinite, -infinite }, { infinite, infinite },
        { -infinite, -infinite } };
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
          const double moved = scout.moved[axis];
          const double place =
            (static_cast<double>(at[axis]) + 0.5) * static_cast<double>(scouts_.stride()) - 0.5;
          const double low = at[axis] == 0 ? 0 : place;
          const double high = at[axis] + 1 == counts[axis] ? std::max(place, last[axis]) : place;
          quad.lowMoved[axis] = std::min(quad.lowMoved[axis], moved);
          quad.highMoved[axis] = std::max(quad.highMoved[axis], moved);
          quad.lowPlace[axis] = std::min(quad.lowPlace[axis], low + moved);
          quad.highPlace[axis] = std::max(quad.highPlace[axis], high + moved);
        }
      }
      quads_.push_back(quad);
    }
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
  for (const Quad& quad : quads_)
  {
    bool isOver = true;
    for (std::size_t axis = 0; axis < 2; ++axis)
    {
      isOver = isOver && quad.lowPlace[axis] <= low[axis] + static_cast<double>(Patch::edge) + 1 &&
        quad.highPlace[axis] >= low[axis];
    }
    for (std::size_t axis = 0; axis < 2 && isOver; ++axis)
    {
      least[axis] = isFound ? std::min(least[axis], quad.lowMoved[axis]) : quad.lowMoved[axis];
      most[axis] = isFound ? std::max(most[axis], quad.highMoved[axis]) : quad.highMoved[axis];
    }
    isFound = isFound || isOver;
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
  patch.margin = static_cast<std::int64_t>(std::min(
    static_cast<double>(around) + std::ceil(std::max(0., spreadOf - halfCell)), mostAround));
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

PatchLayout layOutPatches(const Scouts& scouts, const View& view, std::int64_t margin)
{
  return Planner(scouts, view).layOut(margin);
}

} // namespace schlieren
