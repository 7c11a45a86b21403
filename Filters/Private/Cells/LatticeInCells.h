// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Cells/CellSampler.h"
#include "Cells/PlacesInCell.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace filters
{

/// The points of a lattice, and the cells found so far.
class LatticeInCells
{
public:
  LatticeInCells(const CellTree& tree, const schlieren::Lattice& lattice, double* values);

  /// Sets the box for add(). Returns whether it contains points.
  bool enter(const CellTree::Steps& box);
  void add(std::size_t place);
  /// Adds a cell that is known to contain these points, and no others.
  void add(std::size_t place, const std::uint16_t* begin, const std::uint16_t* end);
  std::size_t countFound() const;
  void finish(unsigned char* found, CellsOfLattice* cells) const;

private:
  template <CellShape shape>
  void addNormal(const CellTree::Cell& cell);
  template <CellShape shape>
  void findSlabs(const double corners[4][8], const Polynomial place[3], const Vector rows[3]);
  /// Coordinates in a cell along the lattice's rows.
  struct Rows;
  void scan(const NormalCell& cell, const Vector& middle, const Vector rows[3]);
  void scanGiven(const NormalCell& cell, const Rows& rows);
  void scanBox(const NormalCell& cell, const Rows& rows);
  void collect(
    const NormalCell& cell, const Rows& rows, const double at[3], int i, std::size_t point);
  void flush(const NormalCell& cell);
  bool isSettled(std::size_t point) const
  {
    return this->Misses[point] == 0 && this->Owners[point] <= this->Number;
  }
  void set(std::size_t point, double miss, double value);

  const CellTree& Tree;
  const schlieren::Lattice& Lattice;
  double* Values;
  // Converts steps of the tree's boxes to indices of points.
  double PerStep[3], AtOrigin[3], Rounding[3], Slack[3];
  int First[3], Last[3]; // of the last box

  // Misses and values of the best cells so far.
  std::vector<float> Misses;
  std::vector<CellTree::Number> Owners;
  std::vector<std::uint32_t> Cells; // these cells' places in the tree

  CellTree::Number Number = 0;
  std::uint32_t Cell = 0;
  const std::uint16_t *GivenBegin = nullptr, *GivenEnd = nullptr;
  double Tolerance = 0;
  double Low[4],
    High[4]; // of normal coordinates, and of their sum for slanting faces
  CellPoints Points;
  std::size_t Places[CellPoints::most];
  int Count = 0;
};

} // namespace filters
