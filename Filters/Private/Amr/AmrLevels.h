// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Input/Flow.h"

#include "Schlieren.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <vector>

/// The levels and blocks of adaptive meshes with values in cells.
namespace filters
{

using Counts = std::array<int, 3>;

inline std::size_t volume(const Counts& n)
{
  return static_cast<std::size_t>(n[0]) * static_cast<std::size_t>(n[1]) *
    static_cast<std::size_t>(n[2]);
}

/// The geometry of an image with values in cells.
struct AmrImage
{
  std::array<double, 3> corner; // along a flat axis: half a unit before the plane
  std::array<double, 3> spacing;
  Counts cells; // along a flat axis: 1
  Counts ownBegin,
    ownEnd; // the box of cells that are not copies, which surround it
  int flat; // axis with one layer of points; -1: none
};
/// Returns nothing for leaves with point arrays, turned, or with one point along several axes.
std::optional<AmrImage> amrImageOf(const Leaf& leaf);

/// A block and its position on the lattice of its level.
struct AmrBlock
{
  std::size_t leaf;         // index of the image
  std::array<int, 3> first; // first cell
  std::array<int, 3> cells;
  std::array<int, 3> ownBegin, ownEnd; // cells of the block that are not copies
};

/// All blocks of one spacing.
struct AmrLevel
{
  std::array<double, 3> spacing;
  std::array<int, 3> cells; // cells of the domain
  std::vector<AmrBlock> blocks;
};

struct AmrLevels
{
  std::vector<AmrLevel> levels;
  int flat;                     // axis with one layer of points; -1: none
  std::array<double, 3> origin; // first corner of the domain

  schlieren::Box bounds() const; // bounds of the domain
};

/// Returns nothing if the images do not fit into one lattice.
std::optional<AmrLevels> findLevels(const std::vector<AmrImage>& images);
/// Returns nothing for other leaves, or for images that do not fit into one lattice.
std::optional<AmrLevels> findLevels(const std::vector<Leaf>& leaves);

/// Sets the depth of flat levels, by default one unit, about the same plane.
void setDepth(AmrLevels& levels, double depth);

/// Turns flat levels to the axes of directionAcross().
AmrLevels turnedAcrossZ(AmrLevels levels);

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

inline Counts ratioOf(const Counts& fine, const Counts& coarse)
{
  return { fine[0] / coarse[0], fine[1] / coarse[1], fine[2] / coarse[2] };
}

/// The cells of a level in [begin, end).
struct CellBox
{
  Counts begin, end;

  bool isEmpty() const
  {
    return this->end[0] <= this->begin[0] || this->end[1] <= this->begin[1] ||
      this->end[2] <= this->begin[2];
  }
  Counts size() const
  {
    return { this->end[0] - this->begin[0], this->end[1] - this->begin[1],
      this->end[2] - this->begin[2] };
  }
  std::size_t index(int i, int j, int k) const
  {
    const Counts n = this->size();
    return (static_cast<std::size_t>(k - this->begin[2]) * static_cast<std::size_t>(n[1]) +
             static_cast<std::size_t>(j - this->begin[1])) *
      static_cast<std::size_t>(n[0]) +
      static_cast<std::size_t>(i - this->begin[0]);
  }
};

CellBox boxOf(const AmrBlock& block);
CellBox intersection(const CellBox& a, const CellBox& b);

/// Sorts boxes into about as many bins of equal size, for fast queries.
class BoxBins
{
public:
  explicit BoxBins(std::vector<CellBox> boxes);

  /// Calls visit(number, cells) for disjoint boxes that together are the intersections with `box`.
  template <class Visit>
  void forPartsIn(const CellBox& box, const Visit& visit) const
  {
    this->forBins(box,
      [&](std::size_t bin, const CellBox& cells)
      {
        for (const std::size_t number : this->Bins[bin])
        {
          const CellBox part = intersection(intersection(this->Boxes[number], box), cells);
          if (!part.isEmpty())
          {
            visit(number, part);
          }
        }
      });
  }

private:
  /// Calls visit(number, cells) for the bins that a box meets.
  template <class Visit>
  void forBins(const CellBox& box, const Visit& visit) const
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
    const CellBox all{ { 0, 0, 0 }, this->Count };
    forCells(first, count,
      [&](int i, int j, int k)
      {
        const Counts at = { i, j, k };
        CellBox cells;
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
          cells.begin[axis] = this->First[axis] + at[axis] * this->Edge[axis];
          cells.end[axis] = cells.begin[axis] + this->Edge[axis];
        }
        visit(all.index(i, j, k), cells);
      });
  }

  std::vector<CellBox> Boxes;
  Counts First{ 0, 0, 0 }, Edge{ 1, 1, 1 }, Count{ 0, 0, 0 };
  std::vector<std::vector<std::size_t>> Bins;
};

/// Sorts the blocks of a level into bins.
BoxBins binsOf(const AmrLevel& level);

/// Sorts the cells of a level that finer blocks cover into bins.
BoxBins coveredCells(const std::vector<AmrLevel>& levels, std::size_t level);

} // namespace filters
