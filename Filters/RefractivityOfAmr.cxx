// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "RefractivityOfAmr.h"

#include "RefractivityByResampling.h"
#include "RefractivityValues.h"

#include "vtkDoubleArray.h"
#include "vtkImageData.h"
#include "vtkMatrix3x3.h"
#include "vtkPointData.h"
#include "vtkSMPTools.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace refractivity
{

namespace
{

using Counts = std::array<int, 3>;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Part of a cell by which a block may miss its lattice: blocks are often placed in single precision.
constexpr double latticeTolerance = 0.02;

std::size_t volume(const Counts& n)
{
  return static_cast<std::size_t>(n[0]) * static_cast<std::size_t>(n[1]) *
    static_cast<std::size_t>(n[2]);
}

bool isNearlyWhole(double x) { return std::abs(x - std::round(x)) < latticeTolerance; }

/// Cells along each axis; 1 along the axis that is flat.
Counts cellsOf(vtkImageData* image)
{
  Counts points;
  image->GetDimensions(points.data());
  return { std::max(points[0] - 1, 1), std::max(points[1] - 1, 1), std::max(points[2] - 1, 1) };
}

/// The first corner; along a flat axis, half a unit before the plane.
std::array<double, 3> cornerOf(vtkImageData* image, int flat)
{
  std::array<double, 3> corner;
  const int* extent = image->GetExtent();
  image->TransformIndexToPhysicalPoint(extent[0], extent[2], extent[4], corner.data());
  if (flat >= 0)
  {
    corner[static_cast<std::size_t>(flat)] -= 0.5;
  }
  return corner;
}

/// The axis along which an image has one point: -1 for none, -2 where there are several.
int flatAxisOf(vtkImageData* image)
{
  int flat = -1;
  for (int axis = 0; axis < 3; ++axis)
  {
    if (image->GetDimensions()[axis] == 1)
    {
      flat = flat == -1 ? axis : -2;
    }
  }
  return flat;
}

std::array<double, 3> spacingOf(vtkImageData* image, int flat)
{
  std::array<double, 3> spacing;
  std::copy_n(image->GetSpacing(), 3, spacing.begin());
  if (flat >= 0)
  {
    spacing[static_cast<std::size_t>(flat)] = 1;
  }
  return spacing;
}

/// Calls visit(i, j, k) for all cells from `first` on, x fastest.
template <class Visit>
void forCells(const Counts& first, const Counts& count, const Visit& visit)
{
  for (int k = first[2]; k < first[2] + count[2]; ++k)
  {
    for (int j = first[1]; j < first[1] + count[1]; ++j)
    {
      for (int i = first[0]; i < first[0] + count[0]; ++i)
      {
        visit(i, j, k);
      }
    }
  }
}

/// Finds the cells that are no copies of other blocks' cells: a box, around which the copies lie.
void findOwnCells(vtkDataSet* data, AmrBlock& block)
{
  vtkUnsignedCharArray* ghosts = data->GetCellGhostArray();
  if (!ghosts)
  {
    block.ownBegin = { 0, 0, 0 };
    block.ownEnd = block.cells;
    return;
  }
  block.ownBegin = block.cells;
  block.ownEnd = { 0, 0, 0 };
  vtkIdType cell = 0;
  forCells({ 0, 0, 0 }, block.cells,
    [&](int i, int j, int k)
    {
      if (!(ghosts->GetValue(cell++) & vtkDataSetAttributes::DUPLICATECELL))
      {
        const Counts at = { i, j, k };
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
          block.ownBegin[axis] = std::min(block.ownBegin[axis], at[axis]);
          block.ownEnd[axis] = std::max(block.ownEnd[axis], at[axis] + 1);
        }
      }
    });
}

/// Puts the leaves on levels, coarsest first, with positions yet to be found. Empty where they differ in
/// kind.
std::vector<AmrLevel> sortedByLevel(const std::vector<Leaf>& leaves, int& flat)
{
  std::vector<AmrLevel> levels;
  auto* first = vtkImageData::SafeDownCast(leaves[0].data);
  flat = first ? flatAxisOf(first) : -2;
  for (std::size_t number = 0; number < leaves.size(); ++number)
  {
    auto* image = vtkImageData::SafeDownCast(leaves[number].data);
    if (!image || !leaves[number].ofCells || flat == -2 || flatAxisOf(image) != flat ||
      !image->GetDirectionMatrix()->IsIdentity())
    {
      return {};
    }
    const std::array<double, 3> spacing = spacingOf(image, flat);
    const auto isAlike = [&spacing](const AmrLevel& level)
    {
      return std::equal(spacing.begin(), spacing.end(), level.spacing.begin(),
        [](double a, double b) { return std::abs(a - b) < 1e-4 * b; });
    };
    auto level = std::find_if(levels.begin(), levels.end(), isAlike);
    if (level == levels.end())
    {
      level = levels.insert(levels.end(), { spacing, {}, {} });
    }
    level->blocks.push_back({ number, {}, cellsOf(image), {}, {} });
    findOwnCells(image, level->blocks.back());
  }
  std::sort(levels.begin(), levels.end(),
    [](const AmrLevel& a, const AmrLevel& b)
    {
      return a.spacing[0] * a.spacing[1] * a.spacing[2] >
        b.spacing[0] * b.spacing[1] * b.spacing[2];
    });
  return levels;
}

/// Finds where the blocks lie. Returns whether there is such a lattice.
bool place(const std::vector<Leaf>& leaves, std::vector<AmrLevel>& levels, int flat,
  std::array<double, 3>& origin)
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const auto cornerOn = [&](const AmrBlock& block)
    { return cornerOf(vtkImageData::SafeDownCast(leaves[block.leaf].data), flat)[axis]; };
    double& coarsest = levels[0].spacing[axis];
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (const AmrLevel& level : levels)
    {
      const double ratio = coarsest / level.spacing[axis];
      if (!(level.spacing[axis] > 0) || !std::isfinite(ratio) || ratio < 0.5 ||
        std::abs(ratio - std::round(ratio)) > 1e-3 * ratio)
      {
        return false;
      }
      for (const AmrBlock& block : level.blocks)
      {
        low = std::min(low, cornerOn(block));
        high = std::max(high, cornerOn(block) + block.cells[axis] * level.spacing[axis]);
      }
    }
    // A whole number of coarsest cells, in step with the coarsest blocks.
    const double anchor = cornerOn(levels[0].blocks[0]);
    origin[axis] = anchor - std::ceil((anchor - low) / coarsest - latticeTolerance) * coarsest;
    const double cells = std::ceil((high - origin[axis]) / coarsest - latticeTolerance);
    for (std::size_t i = 0; i < levels.size(); ++i)
    {
      AmrLevel& level = levels[i];
      const double ratio = std::round(coarsest / level.spacing[axis]);
      const double before = i > 0 ? std::round(coarsest / levels[i - 1].spacing[axis]) : 1;
      if (!(cells * ratio < 1e6) || !isNearlyWhole(ratio / before))
      {
        return false;
      }
      level.spacing[axis] = coarsest / ratio;
      level.cells[axis] = static_cast<int>(cells * ratio);
      for (AmrBlock& block : level.blocks)
      {
        const double first = (cornerOn(block) - origin[axis]) / level.spacing[axis];
        if (!isNearlyWhole(first))
        {
          return false;
        }
        block.first[axis] = static_cast<int>(std::round(first));
      }
    }
  }
  return true;
}

/// The values of a level, all over the domain.
struct Grid
{
  Counts cells;
  std::vector<double> values;       // NaN: solid, or nothing there
  std::vector<unsigned char> known; // whether a block says what is there

  explicit Grid(const Counts& n)
    : cells(n)
    , values(volume(n), nan)
    , known(volume(n), 0)
  {
  }

  std::size_t index(int i, int j, int k) const
  {
    const auto nx = static_cast<std::size_t>(this->cells[0]);
    const auto ny = static_cast<std::size_t>(this->cells[1]);
    return (static_cast<std::size_t>(k) * ny + static_cast<std::size_t>(j)) * nx +
      static_cast<std::size_t>(i);
  }

  void set(std::size_t cell, double value)
  {
    this->values[cell] = value;
    this->known[cell] = 1;
  }
};

Counts ratioOf(const Counts& fine, const Counts& coarse)
{
  return { fine[0] / coarse[0], fine[1] / coarse[1], fine[2] / coarse[2] };
}

/// Cells of a level, from `begin` to before `end`.
struct Box
{
  Counts begin, end;
};

Box intersection(const Box& a, const Box& b)
{
  Box both;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    both.begin[axis] = std::max(a.begin[axis], b.begin[axis]);
    both.end[axis] = std::min(a.end[axis], b.end[axis]);
  }
  return both;
}

/// The cells of a level that finer blocks cover. The blocks are sorted into about as many equal bins, so that few
/// are looked at for each block of the level.
class CoveredCells
{
public:
  CoveredCells(const Amr& amr, std::size_t level)
  {
    constexpr int most = std::numeric_limits<int>::max();
    Box all{ { most, most, most }, { 0, 0, 0 } };
    for (std::size_t finer = level + 1; finer < amr.levels.size(); ++finer)
    {
      const Counts ratio = ratioOf(amr.levels[finer].cells, amr.levels[level].cells);
      for (const AmrBlock& block : amr.levels[finer].blocks)
      {
        Box& box = this->Boxes.emplace_back();
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
          const int last = block.first[axis] + block.ownEnd[axis] - 1;
          box.begin[axis] = (block.first[axis] + block.ownBegin[axis]) / ratio[axis];
          box.end[axis] = last / ratio[axis] + 1;
          all.begin[axis] = std::min(all.begin[axis], box.begin[axis]);
          all.end[axis] = std::max(all.end[axis], box.end[axis]);
        }
      }
    }
    const double bins = std::cbrt(static_cast<double>(this->Boxes.size()));
    for (std::size_t axis = 0; axis < 3 && !this->Boxes.empty(); ++axis)
    {
      const int cells = std::max(1, all.end[axis] - all.begin[axis]);
      this->First[axis] = all.begin[axis];
      this->Edge[axis] = static_cast<int>(std::ceil(cells / bins));
      this->Count[axis] = (cells - 1) / this->Edge[axis] + 1;
    }
    this->Bins.resize(volume(this->Count));
    for (const Box& box : this->Boxes)
    {
      this->ForBins(box, [&](std::size_t bin, const Box&) { this->Bins[bin].push_back(&box); });
    }
  }

  /// Calls visit(cells) for boxes that make up what of a box is covered.
  template <class Visit>
  void ForBoxesIn(const Box& box, const Visit& visit) const
  {
    this->ForBins(box,
      [&](std::size_t bin, const Box& cells)
      {
        for (const Box* finer : this->Bins[bin])
        {
          visit(intersection(intersection(*finer, box), cells));
        }
      });
  }

private:
  /// Calls visit(number, cells) for the bins that a box meets.
  template <class Visit>
  void ForBins(const Box& box, const Visit& visit) const
  {
    Counts first, count;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const int begin = std::max(box.begin[axis] - this->First[axis], 0) / this->Edge[axis];
      const int last = (box.end[axis] - 1 - this->First[axis]) / this->Edge[axis];
      first[axis] = begin;
      count[axis] = box.end[axis] > this->First[axis] && box.end[axis] > box.begin[axis]
        ? std::min(last + 1, this->Count[axis]) - begin
        : 0;
    }
    forCells(first, count,
      [&](int i, int j, int k)
      {
        const Counts at = { i, j, k };
        Box cells;
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
          cells.begin[axis] = this->First[axis] + at[axis] * this->Edge[axis];
          cells.end[axis] = cells.begin[axis] + this->Edge[axis];
        }
        visit((static_cast<std::size_t>(k) * static_cast<std::size_t>(this->Count[1]) +
                static_cast<std::size_t>(j)) *
              static_cast<std::size_t>(this->Count[0]) +
            static_cast<std::size_t>(i),
          cells);
      });
  }

  std::vector<Box> Boxes; // of the finer blocks
  Counts First{ 0, 0, 0 }, Edge{ 1, 1, 1 }, Count{ 0, 0, 0 };
  std::vector<std::vector<const Box*>> Bins;
};

/// Calls visit(i, j, k, N) for the block's cells that belong to it and that no finer block covers.
/// N is NaN in solids.
template <class Visit>
void forValues(const CoveredCells& covered, const AmrBlock& block, const Source& source,
  Tally& tally, const Visit& visit)
{
  vtkDataSet* data = source.leaves[block.leaf].data;
  std::vector<bool> isCovered(volume(block.cells), false);
  Box own{ block.first, {} };
  Counts count;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    own.end[axis] = block.first[axis] + block.cells[axis];
  }
  covered.ForBoxesIn(own,
    [&](const Box& cells)
    {
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        count[axis] = cells.end[axis] - cells.begin[axis];
      }
      forCells(cells.begin, count,
        [&](int i, int j, int k)
        {
          isCovered[(static_cast<std::size_t>(k - own.begin[2]) *
                        static_cast<std::size_t>(block.cells[1]) +
                      static_cast<std::size_t>(j - own.begin[1])) *
              static_cast<std::size_t>(block.cells[0]) +
            static_cast<std::size_t>(i - own.begin[0])] = true;
        });
    });

  auto valid = newMask(data->GetNumberOfCells());
  vtkUnsignedCharArray* ghosts = data->GetCellGhostArray();
  for (vtkIdType i = 0; i < valid->GetNumberOfValues(); ++i)
  {
    if (isCovered[static_cast<std::size_t>(i)] ||
      (ghosts && (ghosts->GetValue(i) & vtkDataSetAttributes::HIDDENCELL)))
    {
      valid->SetValue(i, 0);
    }
  }
  const auto values =
    convert<vtkDoubleArray>(source.leaves[block.leaf].arrays, source.model, valid, nan, tally);
  vtkIdType cell = 0;
  forCells(block.first, block.cells,
    [&](int i, int j, int k)
    {
      if (!isCovered[static_cast<std::size_t>(cell)] &&
        !(ghosts && (ghosts->GetValue(cell) & vtkDataSetAttributes::DUPLICATECELL)))
      {
        visit(i, j, k, values->GetValue(cell));
      }
      ++cell;
    });
}

/// Sets the mean of all cells of finer levels wherever there are any.
void averageFinerLevels(const Amr& amr, const Source& source, Grid& grid, Tally& tally)
{
  if (amr.used + 1 == amr.levels.size())
  {
    return;
  }
  std::vector<double> sums(grid.values.size(), 0.), weights(grid.values.size(), 0.);
  for (std::size_t level = amr.used + 1; level < amr.levels.size(); ++level)
  {
    const Counts ratio = ratioOf(amr.levels[level].cells, grid.cells);
    const double weight = 1 / static_cast<double>(volume(ratio));
    const CoveredCells covered(amr, level);
    for (const AmrBlock& block : amr.levels[level].blocks)
    {
      forValues(covered, block, source, tally,
        [&](int i, int j, int k, double value)
        {
          const std::size_t cell = grid.index(i / ratio[0], j / ratio[1], k / ratio[2]);
          sums[cell] += weight * value;
          weights[cell] += weight;
        });
    }
  }
  for (std::size_t i = 0; i < sums.size(); ++i)
  {
    if (weights[i] > 0)
    {
      grid.set(i, sums[i] / weights[i]);
    }
  }
}

/// Sets the mean of the finer cells wherever there are any; solid if one of them is.
void restrictTo(Grid& coarse, const Grid& fine)
{
  const Counts ratio = ratioOf(fine.cells, coarse.cells);
  vtkSMPTools::For(0, coarse.cells[2],
    [&](vtkIdType begin, vtkIdType end)
    {
      forCells({ 0, 0, static_cast<int>(begin) },
        { coarse.cells[0], coarse.cells[1], static_cast<int>(end - begin) },
        [&](int i, int j, int k)
        {
          double sum = 0;
          int count = 0;
          forCells({ i * ratio[0], j * ratio[1], k * ratio[2] }, ratio,
            [&](int a, int b, int c)
            {
              const std::size_t cell = fine.index(a, b, c);
              sum += fine.known[cell] ? fine.values[cell] : 0;
              count += fine.known[cell];
            });
          if (count > 0)
          {
            coarse.set(coarse.index(i, j, k), sum / count);
          }
        });
    });
}

/// What five neighbouring cells, of edge 1 and with known means, say of the mean over an interval: the
/// polynomial of fourth degree that has these means. So no order is lost, and the parts of a cell have the
/// cell's mean (Colella & Woodward 1984 do so in their equation 1.6).
struct Reconstruction
{
  std::array<double, 5> weights;

  /// The interval is `width` wide around `centre`, measured from the centre of the middle cell.
  Reconstruction(double centre, double width)
  {
    // The integral over x is a polynomial of fifth degree through six faces; cell k adds to the faces
    // behind it.
    constexpr int faces = 6;
    this->weights.fill(0);
    for (int face = 0; face < faces; ++face)
    {
      double atEnd = 1, atBegin = 1;
      for (int other = 0; other < faces; ++other)
      {
        if (other != face)
        {
          atEnd *= (centre + width / 2 + 2.5 - other) / (face - other);
          atBegin *= (centre - width / 2 + 2.5 - other) / (face - other);
        }
      }
      for (int cell = 0; cell < face; ++cell)
      {
        this->weights[static_cast<std::size_t>(cell)] += (atEnd - atBegin) / width;
      }
    }
  }

  /// The cells from the left to the right; those that are NaN are extrapolated. NaN where the middle is.
  /// Sums differences, so that what is uniform stays so to the last bit.
  double operator()(const std::array<double, 5>& cells) const
  {
    std::array<double, 4> step;
    for (std::size_t i = 0; i < 4; ++i)
    {
      step[i] = cells[i + 1] - cells[i];
    }
    const auto isKnown = [](double x) { return !std::isnan(x); };
    if (!isKnown(step[1]) && !isKnown(step[2]))
    {
      return cells[2]; // NaN, or alone
    }
    // At first straight on, and as a parabola where a third cell is known.
    const bool hasLeft = isKnown(step[1]), hasRight = isKnown(step[2]);
    if (!hasLeft)
    {
      step[1] = isKnown(step[3]) ? 2 * step[2] - step[3] : step[2];
    }
    if (!hasRight)
    {
      step[2] = isKnown(step[0]) ? 2 * step[1] - step[0] : step[1];
    }
    if (!hasLeft || !isKnown(step[0]))
    {
      step[0] = 2 * step[1] - step[2];
    }
    if (!hasRight || !isKnown(step[3]))
    {
      step[3] = 2 * step[2] - step[1];
    }
    return cells[2] - this->weights[0] * (step[0] + step[1]) - this->weights[1] * step[1] +
      this->weights[3] * step[2] + this->weights[4] * (step[2] + step[3]);
  }
};

/// The means over as many equal parts of an axis. A part whose middle lies in a solid cell is NaN; no
/// other one takes anything from there.
void resampleAxis(std::vector<double>& values, Counts& cells, std::size_t axis, int count)
{
  const int n = cells[axis];
  if (n == count)
  {
    return;
  }
  const vtkIdType stride =
    axis == 0 ? 1 : static_cast<vtkIdType>(cells[0]) * (axis == 2 ? cells[1] : 1);
  const vtkIdType lines = static_cast<vtkIdType>(volume(cells)) / n;
  const double width = static_cast<double>(n) / count;
  std::vector<double> result(static_cast<std::size_t>(lines) * static_cast<std::size_t>(count));
  vtkSMPTools::For(0, lines / stride * count,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType row = begin; row < end; ++row)
      {
        const double middle = (static_cast<double>(row % count) + 0.5) * width - 0.5;
        const int cell = std::clamp(static_cast<int>(std::lround(middle)), 0, n - 1);
        const Reconstruction mean(middle - cell, std::min(width, 1.));
        const double* line = values.data() + row / count * n * stride;
        for (vtkIdType k = 0; k < stride; ++k)
        {
          std::array<double, 5> around;
          for (int i = 0; i < 5; ++i)
          {
            const int at = cell + i - 2;
            around[static_cast<std::size_t>(i)] = at < 0 || at >= n ? nan : line[at * stride + k];
          }
          result[static_cast<std::size_t>(row * stride + k)] = mean(around);
        }
      }
    });
  values = std::move(result);
  cells[axis] = count;
}

void resampleTo(std::vector<double>& values, Counts cells, const Counts& counts)
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    resampleAxis(values, cells, axis, counts[axis]);
  }
}

/// The values of the level that is used, all over the domain.
Grid valuesOf(const Amr& amr, const Source& source, Tally& tally)
{
  std::vector<Grid> grids;
  for (std::size_t level = 0; level <= amr.used; ++level)
  {
    Grid& grid = grids.emplace_back(amr.levels[level].cells);
    const CoveredCells covered(amr, level);
    for (const AmrBlock& block : amr.levels[level].blocks)
    {
      forValues(covered, block, source, tally,
        [&grid](int i, int j, int k, double value) { grid.set(grid.index(i, j, k), value); });
    }
  }
  averageFinerLevels(amr, source, grids.back(), tally);
  for (std::size_t level = amr.used; level > 0; --level)
  {
    restrictTo(grids[level - 1], grids[level]);
  }
  for (std::size_t level = 1; level <= amr.used; ++level)
  {
    Grid& fine = grids[level];
    std::vector<double> coarse = std::move(grids[level - 1].values);
    resampleTo(coarse, grids[level - 1].cells, fine.cells);
    for (std::size_t i = 0; i < coarse.size(); ++i)
    {
      if (!fine.known[i])
      {
        fine.values[i] = coarse[i];
      }
    }
  }
  return std::move(grids.back());
}

} // namespace

std::optional<Amr> planAmr(const Source& source, const int samplingDimensions[3])
{
  Amr amr;
  int flat = -1;
  amr.levels = sortedByLevel(source.leaves, flat);
  std::array<double, 3> corner;
  if (amr.levels.empty() || !place(source.leaves, amr.levels, flat, corner))
  {
    return std::nullopt;
  }
  const Counts given = requireDimensions(samplingDimensions);
  const bool isGiven = std::find(given.begin(), given.end(), 0) == given.end();
  // Not a finer level than fits, or than a grid that is given can show.
  const auto fits = [&](std::size_t level)
  {
    const double cells = static_cast<double>(volume(amr.levels[level].cells));
    return cells <= (isGiven ? 2 * static_cast<double>(volume(given)) : mostVoxels);
  };
  amr.used = amr.levels.size() - 1;
  while (amr.used > 0 && !fits(amr.used))
  {
    --amr.used;
  }
  // Blocks far apart: a grid over all of them would be empty.
  std::size_t cells = 0;
  for (const AmrLevel& level : amr.levels)
  {
    for (const AmrBlock& block : level.blocks)
    {
      cells += volume(block.cells);
    }
  }
  if (!fits(amr.used) && volume(amr.levels[amr.used].cells) > 8 * cells)
  {
    return std::nullopt;
  }

  amr.note = isGiven ? "as given" : "the cells of level " + std::to_string(amr.used);
  if (!isGiven && amr.used + 1 < amr.levels.size())
  {
    const Counts finest = amr.levels.back().cells;
    amr.note += " of " + std::to_string(amr.levels.size()) +
      ", coarser than the finest to bound memory (as fine as it is: Sampling Dimensions " +
      std::to_string(finest[0]) + " " + std::to_string(finest[1]) + " " +
      std::to_string(finest[2]) + ")";
  }
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    amr.dimensions[axis] =
      given[axis] ? given[axis] : std::max(amr.levels[amr.used].cells[axis], 2);
  }
  requireFits(amr.dimensions);
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double length = amr.levels[0].cells[axis] * amr.levels[0].spacing[axis];
    const bool isFlat = static_cast<int>(axis) == flat;
    amr.spacing[axis] = isFlat ? 1. / (amr.dimensions[axis] - 1) : length / amr.dimensions[axis];
    amr.origin[axis] = corner[axis] + (isFlat ? 0 : amr.spacing[axis] / 2);
  }
  return amr;
}

void gridOf(const Amr& amr, vtkImageData* structure)
{
  structure->Initialize();
  structure->SetDimensions(amr.dimensions.data());
  structure->SetOrigin(amr.origin.data());
  structure->SetSpacing(amr.spacing.data());
}

Tally convertAmr(const Amr& amr, const Source& source, bool doublePrecision, vtkImageData* output)
{
  Tally tally;
  Grid grid = valuesOf(amr, source, tally);
  resampleTo(grid.values, grid.cells, amr.dimensions);
  gridOf(amr, output);
  vtkNew<vtkDoubleArray> values;
  values->SetArray(grid.values.data(), static_cast<vtkIdType>(grid.values.size()), 1);
  setArrays(output, { values }, Linear(), nullptr, doublePrecision);
  return tally;
}

} // namespace refractivity
