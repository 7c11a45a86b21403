// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Amr/AmrLevels.h"
#include "Walls/BoundaryFaces.h"

#include <functional>
#include <unordered_map>

namespace filters
{

enum class CellState : unsigned char
{
  None,    ///< not in a block of this or a finer level
  Refined, ///< covered by finer blocks
  Gas,
  Solid
};

/// Collects the faces between gas and other cells, each as large as the smaller cell beside it.
/// Looks at solid cells only: the surfaces of those with gas (vtkThreshold and vtkGeometryFilter, which
/// do not divide the faces of coarser cells) make the first image of 2.1 million cells take 1.6 times
/// as long.
class AmrFaces
{
public:
  using StateOf = std::function<CellState(std::size_t level, const Counts& cell)>;

  struct Level
  {
    std::array<double, 3> spacing;
    Counts cells; // cells of the domain
  };

  /// `origin`: first corner of the domain. `levels`: coarsest first. `stateOf`: of cells in the
  /// domain.
  AmrFaces(
    const std::array<double, 3>& origin, std::vector<Level> levels, StateOf stateOf, Extent extent)
    : Origin(origin)
    , Levels(std::move(levels))
    , State(std::move(stateOf))
    , Axes(extent == Extent::Layer ? 2 : 3)
  {
    this->Faces.extent = extent;
  }

  /// Adds the faces around a cell without gas.
  void addAround(std::size_t level, const Counts& cell, bool isHidden);

  /// Adds the faces at the border of the domain.
  void addDomain();

  BoundaryFaces take() { return std::move(this->Faces); }

private:
  void addFace(std::size_t level, const Counts& gas, std::size_t axis, bool isAbove, bool isHidden);
  void addSquare(
    std::size_t level, const Counts& gas, std::size_t axis, bool isAbove, bool isHidden);
  std::int32_t pointAt(std::size_t level, const Counts& corner);
  bool isInDomain(std::size_t level, const Counts& cell) const;

  std::array<double, 3> Origin;
  std::vector<Level> Levels;
  StateOf State;
  std::size_t Axes;
  BoundaryFaces Faces;
  std::unordered_map<std::uint64_t, std::int32_t> Points; // by index on the finest level
};

} // namespace filters
