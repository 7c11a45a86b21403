// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Cells/CellSampler.h"

#include "Cells/LatticeInCells.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace filters
{

namespace
{

/// Prefers the earlier block for points on its faces, regardless of rounding.
constexpr double nothing = 1e-9;

/// Relative error of corners up to which hexahedra count as parallelepipeds.
constexpr double bendOfParallelepipeds = 1e-12;

const LocateInCell locateInCell = functionsToLocate().back();

} // namespace

LatticeInCells::LatticeInCells(
  const CellTree& tree, const schlieren::Lattice& lattice, double* values)
  : Tree(tree)
  , Lattice(lattice)
  , Values(values)
{
  constexpr double epsilon = 4 * std::numeric_limits<double>::epsilon();
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double spacing = lattice.spacing[axis], first = lattice.first[axis];
    this->PerStep[axis] = tree.step()[axis] / spacing;
    this->AtOrigin[axis] = (tree.origin()[axis] - first) / spacing;
    this->Rounding[axis] = epsilon * (std::abs(first) + std::abs(tree.origin()[axis]));
    this->Slack[axis] = this->Rounding[axis] / spacing + 1e-12;
  }
  const auto size = static_cast<std::size_t>(lattice.size());
  this->Misses.assign(size, std::numeric_limits<float>::infinity());
  this->Owners.assign(size, 0);
  this->Cells.assign(size, 0);
  std::fill_n(values, size, 0.);
}

bool LatticeInCells::enter(const CellTree::Steps& box)
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double last = this->Lattice.points[axis] - 1;
    const double low =
      this->AtOrigin[axis] + box.low[axis] * this->PerStep[axis] - this->Slack[axis];
    const double high =
      this->AtOrigin[axis] + box.high[axis] * this->PerStep[axis] + this->Slack[axis];
    if (!(low <= last && high >= 0))
    {
      return false;
    }
    const int before = low > 0 ? static_cast<int>(low) : 0;
    this->First[axis] = before < low ? before + 1 : before;
    this->Last[axis] = static_cast<int>(high < last ? high : last);
    if (this->First[axis] > this->Last[axis])
    {
      return false;
    }
  }
  return true;
}

void LatticeInCells::set(std::size_t point, double miss, double value)
{
  if (!(miss <= this->Tolerance) || miss == std::numeric_limits<double>::infinity())
  {
    return;
  }
  const auto rounded = miss <= nothing ? 0 : static_cast<float>(miss);
  if (rounded < this->Misses[point] ||
    (rounded == this->Misses[point] && this->Number < this->Owners[point]))
  {
    this->Misses[point] = rounded;
    this->Owners[point] = this->Number;
    this->Cells[point] = this->Cell;
    this->Values[point] = value;
  }
}

void LatticeInCells::add(std::size_t place, const std::uint16_t* begin, const std::uint16_t* end)
{
  this->GivenBegin = begin;
  this->GivenEnd = end;
  this->add(place);
}

void LatticeInCells::add(std::size_t place)
{
  this->Cell = static_cast<std::uint32_t>(place);
  this->Number = this->Tree.number(place);
  const CellTree::Cell cell = this->Tree.cell(this->Number);
  const CellShape shape = shapeOf(cell.block->type(cell.id));
  withShape(shape, [&](const auto of) { this->addNormal<decltype(of)::value>(cell); });
}

/// Finds the bounds of the normal coordinates in a cell.
template <CellShape shape>
void LatticeInCells::findSlabs(
  const double corners[4][8], const Polynomial place[3], const Vector rows[3])
{
  constexpr bool isSimplex = shape == CellShape::Tetrahedron || shape == CellShape::Wedge;
  // Uses that interpolation, and so the cell, is bounded by the corners.
  for (int i = 0; i < 4; ++i)
  {
    this->Low[i] = std::numeric_limits<double>::infinity();
    this->High[i] = -this->Low[i];
  }
  for (int i = 0; i < cornersOf(shape); ++i)
  {
    const Vector x = { corners[0][i] - place[0][0], corners[1][i] - place[1][0],
      corners[2][i] - place[2][0] };
    const double at[3] = { dot(rows[0], x), dot(rows[1], x), dot(rows[2], x) };
    for (int axis = 0; axis < 3; ++axis)
    {
      this->Low[axis] = std::min(this->Low[axis], at[axis]);
      this->High[axis] = std::max(this->High[axis], at[axis]);
    }
    if constexpr (isSimplex)
    {
      const double sum = at[0] + at[1] + (shape == CellShape::Tetrahedron ? at[2] : 0);
      this->Low[3] = std::min(this->Low[3], sum);
      this->High[3] = std::max(this->High[3], sum);
    }
  }
  for (int i = 0; i < 4; ++i)
  {
    const double more = 3 * this->Tolerance * (this->High[i] - this->Low[i]);
    this->Low[i] -= more;
    this->High[i] += more;
  }
}

namespace
{

template <CellShape shape>
bool isAffine(const Polynomial (&place)[3], double length)
{
  if constexpr (shape == CellShape::Hexahedron)
  {
    for (const Polynomial& along : place)
    {
      for (std::size_t i = 4; i < 8; ++i)
      {
        if (!(std::abs(along[i]) <= bendOfParallelepipeds * length))
        {
          return false;
        }
      }
    }
    return true;
  }
  return shape == CellShape::Tetrahedron || shape == CellShape::Voxel;
}

/// Averages the corners' linear polynomials with half of their gradients, weighted as by the cell, which is exact for
/// quadratic fields. The differences from their common terms are the slopes. Changes the corners' values.
template <CellShape shape>
void addTrends(const PointTrend* trends, const vtkIdType* points, const Polynomial (&place)[3],
  const Vector (&columns)[3], double (&corners)[4][8], NormalCell& normal)
{
  double slopes[3][8], limits[2][8];
  for (int i = 0; i < cornersOf(shape); ++i)
  {
    const PointTrend& trend = trends[points[i]];
    limits[0][i] = corners[3][i] + trend.lowest;
    limits[1][i] = corners[3][i] + trend.highest;
    const Vector half = { 0.5 * trend.gradient[0], 0.5 * trend.gradient[1],
      0.5 * trend.gradient[2] };
    corners[3][i] -= half[0] * (corners[0][i] - place[0][0]) +
      half[1] * (corners[1][i] - place[1][0]) + half[2] * (corners[2][i] - place[2][0]);
    for (int axis = 0; axis < 3; ++axis)
    {
      slopes[axis][i] = dot(half, columns[axis]);
    }
  }
  for (int i = 0; i < 3; ++i)
  {
    const Polynomial slope = polynomialOf<shape>(slopes[i]);
    std::copy(slope.begin(), slope.end(), normal.slope[i]);
  }
  for (int i = 0; i < 2; ++i)
  {
    const Polynomial limit = polynomialOf<shape>(limits[i]);
    std::copy(limit.begin(), limit.end(), normal.limit[i]);
  }
}

} // namespace

/// Adds a cell that has a volume at its middle; ignores others.
template <CellShape shape>
void LatticeInCells::addNormal(const CellTree::Cell& cell)
{
  constexpr int count = cornersOf(shape);
  vtkIdType points[8];
  cell.block->points(cell.id, count, points);
  double corners[4][8];
  Vector origin;
  cell.block->coordinates(points[0], origin.data());
  double length = 0;
  for (int i = 0; i < count; ++i)
  {
    double x[3];
    cell.block->coordinates(points[i], x);
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      corners[axis][i] = x[axis] - origin[axis];
      length = std::max(length, std::abs(corners[axis][i]));
    }
    corners[3][i] = cell.block->values()[points[i]];
  }
  const Polynomial place[3] = { polynomialOf<shape>(corners[0]), polynomialOf<shape>(corners[1]),
    polynomialOf<shape>(corners[2]) };
  const Vector columns[3] = { { place[0][1], place[1][1], place[2][1] },
    { place[0][2], place[1][2], place[2][2] }, { place[0][3], place[1][3], place[2][3] } };
  Vector rows[3];
  if (!invert(columns, rows))
  {
    return;
  }
  NormalCell normal;
  normal.shape = shape;
  normal.isAffine = isAffine<shape>(place, length);
  this->Tolerance = normal.isAffine ? toleranceOfPlaneFaces : toleranceOfCurvedFaces;
  // Enlarges the tolerance for coordinates far from the origin, which are rounded more.
  for (const Vector& row : rows)
  {
    this->Tolerance = std::max(this->Tolerance,
      std::abs(row[0]) * this->Rounding[0] + std::abs(row[1]) * this->Rounding[1] +
        std::abs(row[2]) * this->Rounding[2]);
  }

  if (!this->GivenBegin)
  {
    this->findSlabs<shape>(corners, place, rows);
  }
  for (int i = 0; i < 3; ++i)
  {
    for (std::size_t k = 0; k < 4; ++k)
    {
      const Vector factor = { place[0][k + 4], place[1][k + 4], place[2][k + 4] };
      normal.bend[i][k] = dot(rows[i], factor);
    }
  }
  normal.isSmooth = cell.block->trends() != nullptr;
  if (normal.isSmooth)
  {
    addTrends<shape>(cell.block->trends(), points, place, columns, corners, normal);
  }
  const Polynomial value = polynomialOf<shape>(corners[3]);
  std::copy(value.begin(), value.end(), normal.value);
  const Vector middle = { origin[0] + place[0][0], origin[1] + place[1][0],
    origin[2] + place[2][0] };
  this->scan(normal, middle, rows);
}

void LatticeInCells::flush(const NormalCell& cell)
{
  // Fills the last pack with any finite numbers.
  for (int i = this->Count; i < this->Count + 7 && this->Count > 0; ++i)
  {
    for (double* of : { this->Points.normal[0], this->Points.normal[1], this->Points.normal[2] })
    {
      of[i] = of[this->Count - 1];
    }
  }
  locateInCell(cell, this->Count, this->Points);
  for (int i = 0; i < this->Count; ++i)
  {
    this->set(this->Places[i], this->Points.miss[i], this->Points.value[i]);
  }
  this->Count = 0;
}

std::size_t LatticeInCells::countFound() const
{
  return static_cast<std::size_t>(std::count_if(this->Misses.begin(), this->Misses.end(),
    [](float miss) { return miss < std::numeric_limits<float>::infinity(); }));
}

void LatticeInCells::finish(unsigned char* found, CellsOfLattice* cells) const
{
  std::transform(this->Misses.begin(), this->Misses.end(), found,
    [](float miss) -> unsigned char
    { return miss < std::numeric_limits<float>::infinity() ? 1 : 0; });
  if (!cells)
  {
    return;
  }
  const std::size_t count = this->countFound();
  // Numbers the cells in the order in which points meet them, by a hash table.
  std::size_t last = 1;
  while (last < 2 * count)
  {
    last = 2 * last + 1;
  }
  constexpr std::uint32_t none = 0xffffffff;
  std::vector<std::uint32_t> table(last + 1, none), numbers(this->Misses.size(), none);
  cells->cells.clear();
  std::vector<std::uint16_t> counts;
  for (std::size_t i = 0; i < numbers.size(); ++i)
  {
    if (found[i] == 0)
    {
      continue;
    }
    const std::uint32_t cell = this->Cells[i];
    std::size_t at = (cell * 0x9e3779b97f4a7c15u >> 32) & last;
    while (table[at] != none && cells->cells[table[at]] != cell)
    {
      at = (at + 1) & last;
    }
    if (table[at] == none)
    {
      table[at] = static_cast<std::uint32_t>(cells->cells.size());
      cells->cells.push_back(cell);
      counts.push_back(0);
    }
    numbers[i] = table[at];
    ++counts[table[at]];
  }
  cells->starts.assign(counts.size() + 1, 0);
  for (std::size_t i = 0; i < counts.size(); ++i)
  {
    cells->starts[i + 1] = static_cast<std::uint16_t>(cells->starts[i] + counts[i]);
    counts[i] = cells->starts[i];
  }
  cells->points.resize(count);
  for (std::size_t i = 0; i < numbers.size(); ++i)
  {
    if (numbers[i] != none)
    {
      cells->points[counts[numbers[i]]++] = static_cast<std::uint16_t>(i);
    }
  }
  cells->cells.shrink_to_fit();
}

CellSampler::CellSampler(const CellTree& tree)
  : Tree(tree)
{
}

void CellSampler::sample(const schlieren::Lattice& lattice, double* values, unsigned char* found,
  CellsOfLattice* cells) const
{
  LatticeInCells points(this->Tree, lattice, values);
  this->Tree.walk([&](const CellTree::Steps& box) { return points.enter(box); },
    [&](std::size_t place) { points.add(place); });
  points.finish(found, cells);
}

bool CellSampler::sample(
  const schlieren::Lattice& lattice, const CellsOfLattice& cells, double* values) const
{
  LatticeInCells points(this->Tree, lattice, values);
  for (std::size_t i = 0; i < cells.cells.size(); ++i)
  {
    this->Tree.fetchAhead(
      i, cells.cells.size(), [&](std::size_t n) { return std::size_t{ cells.cells[n] }; });
    points.add(cells.cells[i], cells.points.data() + cells.starts[i],
      cells.points.data() + cells.starts[i + 1]);
  }
  return points.countFound() == cells.points.size();
}

} // namespace filters
