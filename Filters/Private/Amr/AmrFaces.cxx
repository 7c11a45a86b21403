// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Amr/AmrFaces.h"

namespace filters
{

bool AmrFaces::isInDomain(std::size_t level, const Counts& cell) const
{
  const Counts& cells = this->Levels[level].cells;
  return cell[0] >= 0 && cell[1] >= 0 && cell[2] >= 0 && cell[0] < cells[0] && cell[1] < cells[1] &&
    cell[2] < cells[2];
}

void AmrFaces::addAround(std::size_t level, const Counts& cell, bool isHidden)
{
  for (std::size_t axis = 0; axis < this->Axes; ++axis)
  {
    for (const bool isAbove : { false, true })
    {
      Counts beside = cell;
      beside[axis] += isAbove ? 1 : -1;
      this->addFace(level, beside, axis, isAbove, isHidden);
    }
  }
}

void AmrFaces::addDomain()
{
  const Counts& cells = this->Levels[0].cells;
  for (std::size_t axis = 0; axis < this->Axes; ++axis)
  {
    Counts layer = cells;
    layer[axis] = 1;
    forCells({ 0, 0, 0 }, layer,
      [&](int i, int j, int k)
      {
        Counts cell{ i, j, k };
        this->addFace(0, cell, axis, true, false);
        cell[axis] = cells[axis] - 1;
        this->addFace(0, cell, axis, false, false);
      });
  }
}

/// Adds the face of the cell `gas`, if it has gas, to the cell before it (`isAbove`) or behind it
/// along the axis, which has none.
void AmrFaces::addFace(
  std::size_t level, const Counts& gas, std::size_t axis, bool isAbove, bool isHidden)
{
  if (!this->isInDomain(level, gas))
  {
    return;
  }
  CellState state = this->State(level, gas);
  if (state == CellState::Refined)
  {
    const Counts ratio = ratioOf(this->Levels[level + 1].cells, this->Levels[level].cells);
    Counts first, count = ratio;
    for (std::size_t i = 0; i < 3; ++i)
    {
      first[i] = gas[i] * ratio[i] + (i == axis && !isAbove ? ratio[i] - 1 : 0);
    }
    count[axis] = 1;
    forCells(first, count,
      [&](int i, int j, int k) {
        this->addFace(level + 1, { i, j, k }, axis, isAbove, isHidden);
      });
    return;
  }
  Counts coarse = gas;
  for (std::size_t below = level; state == CellState::None && below > 0; --below)
  {
    const Counts ratio = ratioOf(this->Levels[below].cells, this->Levels[below - 1].cells);
    for (std::size_t i = 0; i < 3; ++i)
    {
      coarse[i] /= ratio[i];
    }
    state = this->State(below - 1, coarse);
  }
  if (state == CellState::Gas)
  {
    this->addSquare(level, gas, axis, isAbove, isHidden);
  }
}

void AmrFaces::addSquare(
  std::size_t level, const Counts& gas, std::size_t axis, bool isAbove, bool isHidden)
{
  std::array<std::int32_t, 4> points;
  for (unsigned i = 0; i < 4; ++i)
  {
    Counts corner = gas;
    corner[axis] += isAbove ? 0 : 1;
    corner[(axis + 1) % 3] += i == 1 || i == 2 ? 1 : 0;
    corner[(axis + 2) % 3] += i >= 2 ? 1 : 0;
    points[isAbove ? i : 3 - i] = this->pointAt(level, corner);
  }
  this->Faces.surface.corners.push_back({ points[0], points[1], points[2] });
  this->Faces.surface.corners.push_back({ points[0], points[2], points[3] });
  this->Faces.hidesBehind.insert(this->Faces.hidesBehind.end(), 2, isHidden ? 1 : 0);
}

std::int32_t AmrFaces::pointAt(std::size_t level, const Counts& corner)
{
  const Level& finest = this->Levels.back();
  const Counts ratio = ratioOf(finest.cells, this->Levels[level].cells);
  std::uint64_t key = 0;
  for (std::size_t i = 0; i < 3; ++i)
  {
    // findLevels() limits levels to a million cells along an axis.
    key = key << 20 | static_cast<std::uint64_t>(corner[i] * ratio[i]);
  }
  std::vector<Point>& points = this->Faces.surface.points;
  const auto [found, isNew] = this->Points.emplace(key, static_cast<std::int32_t>(points.size()));
  if (isNew)
  {
    Point place;
    for (std::size_t i = 0; i < 3; ++i)
    {
      // Computes the point from its index on the finest level, so that all ranks get the same bits.
      place[i] = this->Origin[i] + corner[i] * ratio[i] * finest.spacing[i];
    }
    points.push_back(place);
  }
  return found->second;
}

} // namespace filters
