// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Amr/AmrLevels.h"
#include "Walls/BoundaryFaces.h"

#include <functional>
#include <unordered_map>

namespace filters
{

/// What a cell of a level is.
enum class CellState : unsigned char
{
  None,    ///< no block of this level or a finer one has it
  Refined, ///< finer blocks cover it
  Gas,
  Solid
};

/**
 * The faces between the gas of adaptive meshes and cells that hold none, each as large as the smaller of the two cells
 * beside it.
 */
class AmrFaces
{
public:
  using StateOf = std::function<CellState(std::size_t level, const Counts& cell)>;

  struct Level
  {
    std::array<double, 3> spacing;
    Counts cells; // of the domain
  };

  /// `origin`: the domain's first corner. `levels`: coarsest first. `stateOf`: of cells in the domain.
  AmrFaces(
    const std::array<double, 3>& origin, std::vector<Level> levels, StateOf stateOf, Extent extent)
    : Origin(origin)
    , Levels(std::move(levels))
    , State(std::move(stateOf))
    , Axes(extent == Extent::Layer ? 2 : 3)
  {
    this->Faces.extent = extent;
  }

  /// The faces around a cell without gas.
  void addAround(std::size_t level, const Counts& cell, bool isHidden);

  /// The faces of the domain.
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
  std::unordered_map<std::uint64_t, std::int32_t> Points; // by their place on the finest level
};

/// Puts triangles and points in an order that does not depend on who has found them: of those that are as near, the first
/// counts. Of the same ones one stays.
void sortTriangles(BoundaryFaces& faces);

} // namespace filters
