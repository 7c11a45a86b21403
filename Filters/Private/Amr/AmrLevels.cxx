// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Amr/AmrLevels.h"

#include "vtkImageData.h"
#include "vtkMatrix3x3.h"
#include "vtkUnsignedCharArray.h"

#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

namespace filters
{

namespace
{

/// Tolerance, in cells, of block positions: they are often in single precision.
constexpr double latticeTolerance = 0.02;

/// Maximum ratio of the cells of the coarsest lattice to those of all blocks.
constexpr std::size_t maxEmpty = 8;

bool isNearlyWhole(double x) { return std::abs(x - std::round(x)) < latticeTolerance; }

/// Returns the cells along each axis; 1 along a flat axis.
Counts cellsOf(vtkImageData* image)
{
  Counts points;
  image->GetDimensions(points.data());
  return { std::max(points[0] - 1, 1), std::max(points[1] - 1, 1), std::max(points[2] - 1, 1) };
}

/// Returns the first corner; along a flat axis, half a unit before the plane.
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

/// Returns the axis along which an image has one point; -1: none, -2: several.
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

/// Finds the cells that are not copies from other blocks.
void findOwnCells(vtkDataSet* data, AmrImage& image)
{
  vtkUnsignedCharArray* ghosts = data->GetCellGhostArray();
  if (!ghosts)
  {
    image.ownBegin = { 0, 0, 0 };
    image.ownEnd = image.cells;
    return;
  }
  image.ownBegin = image.cells;
  image.ownEnd = { 0, 0, 0 };
  vtkIdType cell = 0;
  forCells({ 0, 0, 0 }, image.cells,
    [&](int i, int j, int k)
    {
      if (!(ghosts->GetValue(cell++) & vtkDataSetAttributes::DUPLICATECELL))
      {
        const Counts at = { i, j, k };
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
          image.ownBegin[axis] = std::min(image.ownBegin[axis], at[axis]);
          image.ownEnd[axis] = std::max(image.ownEnd[axis], at[axis] + 1);
        }
      }
    });
}

/// Sorts the images by level, coarsest first. Empty if they are not all flat along the same axis.
std::vector<AmrLevel> sortedByLevel(const std::vector<AmrImage>& images)
{
  std::vector<AmrLevel> levels;
  for (std::size_t number = 0; number < images.size(); ++number)
  {
    const AmrImage& image = images[number];
    if (image.flat != images[0].flat)
    {
      return {};
    }
    const auto isAlike = [&](const AmrLevel& level)
    {
      return std::equal(image.spacing.begin(), image.spacing.end(), level.spacing.begin(),
        [](double a, double b) { return std::abs(a - b) < 1e-4 * b; });
    };
    auto level = std::find_if(levels.begin(), levels.end(), isAlike);
    if (level == levels.end())
    {
      level = levels.insert(levels.end(), { image.spacing, {}, {} });
    }
    level->blocks.push_back({ number, {}, image.cells, image.ownBegin, image.ownEnd });
  }
  std::sort(levels.begin(), levels.end(),
    [](const AmrLevel& a, const AmrLevel& b)
    {
      return a.spacing[0] * a.spacing[1] * a.spacing[2] >
        b.spacing[0] * b.spacing[1] * b.spacing[2];
    });
  return levels;
}

/// Finds the positions of blocks on a common lattice. Returns whether there is one.
bool place(
  const std::vector<AmrImage>& images, std::vector<AmrLevel>& levels, std::array<double, 3>& origin)
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const auto cornerOn = [&](const AmrBlock& block) { return images[block.leaf].corner[axis]; };
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
    // Extends the domain by whole coarsest cells from a coarsest block.
    const double anchor = cornerOn(levels[0].blocks[0]);
    origin[axis] = anchor - std::ceil((anchor - low) / coarsest - latticeTolerance) * coarsest;
    const double cells = std::ceil((high - origin[axis]) / coarsest - latticeTolerance);
    for (std::size_t i = 0; i < levels.size(); ++i)
    {
      AmrLevel& level = levels[i];
      const double ratio = std::round(coarsest / level.spacing[axis]);
      const double before = i > 0 ? std::round(coarsest / levels[i - 1].spacing[axis]) : 1;
      if (!(cells >= 1 && cells * ratio < 1e6) || !isNearlyWhole(ratio / before))
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

} // namespace

std::optional<AmrImage> amrImageOf(const Leaf& leaf)
{
  auto* data = vtkImageData::SafeDownCast(leaf.data);
  const int flat = data ? flatAxisOf(data) : -2;
  if (!leaf.ofCells || flat == -2 || !data->GetDirectionMatrix()->IsIdentity())
  {
    return std::nullopt;
  }
  AmrImage image{ cornerOf(data, flat), spacingOf(data, flat), cellsOf(data), {}, {}, flat };
  findOwnCells(data, image);
  return image;
}

std::optional<AmrLevels> findLevels(const std::vector<Leaf>& leaves)
{
  std::vector<AmrImage> images;
  for (const Leaf& leaf : leaves)
  {
    const std::optional<AmrImage> image = amrImageOf(leaf);
    if (!image)
    {
      return std::nullopt;
    }
    images.push_back(*image);
  }
  return findLevels(images);
}

std::optional<AmrLevels> findLevels(const std::vector<AmrImage>& images)
{
  AmrLevels found;
  found.levels = sortedByLevel(images);
  if (found.levels.empty() || !place(images, found.levels, found.origin))
  {
    return std::nullopt;
  }
  found.flat = images[0].flat;
  // Rejects blocks so far apart that a common lattice would be mostly empty.
  std::size_t cells = 0;
  for (const AmrLevel& level : found.levels)
  {
    for (const AmrBlock& block : level.blocks)
    {
      cells += volume(block.cells);
    }
  }
  if (volume(found.levels[0].cells) > maxEmpty * cells)
  {
    return std::nullopt;
  }
  return found;
}

schlieren::Box AmrLevels::bounds() const
{
  const AmrLevel& coarsest = this->levels[0];
  schlieren::Box box{ this->origin, this->origin };
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    box.high[axis] += coarsest.cells[axis] * coarsest.spacing[axis];
  }
  return box;
}

void setDepth(AmrLevels& levels, double depth)
{
  const auto flat = static_cast<std::size_t>(levels.flat);
  levels.origin[flat] += 0.5 * (levels.levels[0].spacing[flat] - depth);
  for (AmrLevel& level : levels.levels)
  {
    level.spacing[flat] = depth;
  }
}

AmrLevels turnedAcrossZ(AmrLevels levels)
{
  if (levels.flat < 0)
  {
    return levels;
  }
  // Keeps the order of cells: x is before y, and there is one layer across the plane.
  const auto flat = static_cast<std::size_t>(levels.flat);
  const std::size_t along = flat == 0 ? 1 : 0, up = flat == 2 ? 1 : 2;
  const auto turn = [&](auto& of) { of = { of[along], of[up], of[flat] }; };
  levels.origin = { levels.origin[along], levels.origin[up],
    flat == 1 ? -levels.origin[1] - levels.levels[0].spacing[1] : levels.origin[flat] };
  for (AmrLevel& level : levels.levels)
  {
    turn(level.spacing);
    turn(level.cells);
    for (AmrBlock& block : level.blocks)
    {
      turn(block.first);
      turn(block.cells);
      turn(block.ownBegin);
      turn(block.ownEnd);
    }
  }
  return levels;
}

CellBox boxOf(const AmrBlock& block)
{
  CellBox box{ block.first, block.first };
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    box.end[axis] += block.cells[axis];
  }
  return box;
}

CellBox intersection(const CellBox& a, const CellBox& b)
{
  CellBox both;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    both.begin[axis] = std::max(a.begin[axis], b.begin[axis]);
    both.end[axis] = std::min(a.end[axis], b.end[axis]);
  }
  return both;
}

BoxBins::BoxBins(std::vector<CellBox> boxes)
  : Boxes(std::move(boxes))
{
  constexpr int most = std::numeric_limits<int>::max();
  CellBox all{ { most, most, most }, { -most, -most, -most } };
  for (const CellBox& box : this->Boxes)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      all.begin[axis] = std::min(all.begin[axis], box.begin[axis]);
      all.end[axis] = std::max(all.end[axis], box.end[axis]);
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
  for (std::size_t number = 0; number < this->Boxes.size(); ++number)
  {
    this->forBins(this->Boxes[number],
      [&](std::size_t bin, const CellBox&) { this->Bins[bin].push_back(number); });
  }
}

BoxBins binsOf(const AmrLevel& level)
{
  std::vector<CellBox> boxes;
  std::transform(level.blocks.begin(), level.blocks.end(), std::back_inserter(boxes), boxOf);
  return BoxBins(std::move(boxes));
}

BoxBins coveredCells(const std::vector<AmrLevel>& levels, std::size_t level)
{
  std::vector<CellBox> boxes;
  for (std::size_t finer = level + 1; finer < levels.size(); ++finer)
  {
    const Counts ratio = ratioOf(levels[finer].cells, levels[level].cells);
    for (const AmrBlock& block : levels[finer].blocks)
    {
      CellBox& box = boxes.emplace_back();
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        const int last = block.first[axis] + block.ownEnd[axis] - 1;
        box.begin[axis] = (block.first[axis] + block.ownBegin[axis]) / ratio[axis];
        box.end[axis] = last / ratio[axis] + 1;
      }
    }
  }
  return BoxBins(std::move(boxes));
}

} // namespace filters
