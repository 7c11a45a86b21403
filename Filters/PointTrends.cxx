// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "PointTrends.h"

#include "CellShape.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <numeric>
#include <utility>

namespace refractivity
{

namespace
{

// How much of the differences of values, squared, a polynomial may leave: gradients up to the first are
// taken as they are, from the second on they are limited in full.
constexpr double goodFit = 0.005;
constexpr double poorFit = 0.02;

/// Values may leave the range of those around by this part of it.
constexpr double overshoot = 0.01;

/// Added to the matrix for second derivatives, in parts of their mean: where points are too few they are
/// small.
constexpr double leastSecond = 1e-5;
/// And for first ones, where all points lie in a plane or on a line.
constexpr double leastFirst = 1e-12;

constexpr int unknowns = 9; // three first derivatives, six second ones
constexpr std::size_t fewNeighbours = 14;

/// Which cells have a point: those of point i are cells[starts[i]] to cells[starts[i + 1]], in their order.
struct CellsOfPoints
{
  std::vector<std::uint64_t> starts;
  std::vector<std::uint32_t> cells;
};

CellsOfPoints cellsOfPoints(const MeshArrays& mesh, const std::vector<unsigned char>& isCellUsed,
  const WorkProgress& progress)
{
  const auto points = static_cast<std::size_t>(mesh.points());
  std::vector<std::atomic<std::uint32_t>> counts(points);
  const auto forCells = [&](const WorkProgress& done, const auto& visit)
  {
    forParts(mesh.cells(), done,
      [&](vtkIdType begin, vtkIdType end)
      {
        for (vtkIdType cell = begin; cell < end; ++cell)
        {
          if (isCellUsed[static_cast<std::size_t>(cell)])
          {
            mesh.forPoints(
              cell, [&](vtkIdType point) { visit(cell, static_cast<std::size_t>(point)); });
          }
        }
      });
  };
  forCells(progress.part(0, 0.3),
    [&](vtkIdType, std::size_t point) { counts[point].fetch_add(1, std::memory_order_relaxed); });
  CellsOfPoints result;
  result.starts.resize(points + 1);
  for (std::size_t i = 0; i < points; ++i)
  {
    result.starts[i + 1] = result.starts[i] + counts[i].load(std::memory_order_relaxed);
  }
  result.cells.resize(result.starts.back());
  // From behind; then in the order of the cells, whichever thread was the first.
  forCells(progress.part(0.3, 0.7),
    [&](vtkIdType cell, std::size_t point)
    {
      const std::uint32_t left = counts[point].fetch_sub(1, std::memory_order_relaxed);
      result.cells[result.starts[point] + left - 1] = static_cast<std::uint32_t>(cell);
    });
  forParts(mesh.points(), progress.part(0.7, 1),
    [&](vtkIdType begin, vtkIdType end)
    {
      const auto placeOf = [&](vtkIdType point)
      {
        return result.cells.begin() +
          static_cast<std::ptrdiff_t>(result.starts[static_cast<std::size_t>(point)]);
      };
      for (vtkIdType point = begin; point < end; ++point)
      {
        std::sort(placeOf(point), placeOf(point + 1));
      }
    });
  return result;
}

/// Points, each once, in the order in which they came: a table with open addresses.
class PointSet
{
public:
  const std::vector<std::uint32_t>& points() const { return this->Points; }

  void clear()
  {
    ++this->Turn;
    this->Points.clear();
  }

  void add(std::uint32_t point)
  {
    if (2 * this->Points.size() >= this->Places.size())
    {
      this->Places.assign(2 * this->Places.size(), 0);
      for (const std::uint32_t known : this->Points)
      {
        this->isNew(known);
      }
    }
    if (this->isNew(point))
    {
      this->Points.push_back(point);
    }
  }

private:
  bool isNew(std::uint32_t point)
  {
    const std::uint64_t entry = this->Turn << 32 | point;
    const std::size_t last = this->Places.size() - 1;
    std::size_t place = (point * 0x9e3779b97f4a7c15u >> 32) & last;
    while (this->Places[place] >> 32 == this->Turn)
    {
      if (this->Places[place] == entry)
      {
        return false;
      }
      place = (place + 1) & last;
    }
    this->Places[place] = entry;
    return true;
  }

  std::uint64_t Turn = 1; // entries of others are old
  std::vector<std::uint32_t> Points;
  std::vector<std::uint64_t> Places = std::vector<std::uint64_t>(256, 0); // a power of two
};

/// Finds the points of all cells around a point, which is the first of them, and if these are few those of all cells
/// around these. `forCells(point, visit)` visits the numbers of the cells around a point.
template <class ForCells>
void findNeighbours(
  const MeshArrays& mesh, const ForCells& forCells, vtkIdType point, PointSet& found)
{
  found.clear();
  found.add(static_cast<std::uint32_t>(point));
  std::size_t done = 0;
  for (int ring = 0; ring < 2 && found.points().size() <= fewNeighbours; ++ring)
  {
    for (const std::size_t end = found.points().size(); done < end; ++done)
    {
      forCells(static_cast<vtkIdType>(found.points()[done]),
        [&](vtkIdType cell) {
          mesh.forPoints(
            cell, [&](vtkIdType other) { found.add(static_cast<std::uint32_t>(other)); });
        });
    }
  }
}

/// Solves matrix * x = right for a positive definite matrix, of which the lower half is used. False where it is none.
bool solve(double matrix[unknowns][unknowns], double x[unknowns])
{
  for (int i = 0; i < unknowns; ++i)
  {
    for (int k = 0; k <= i; ++k)
    {
      double sum = matrix[i][k];
      for (int j = 0; j < k; ++j)
      {
        sum -= matrix[i][j] * matrix[k][j];
      }
      if (k < i)
      {
        matrix[i][k] = sum * matrix[k][k];
      }
      else if (sum > 0)
      {
        matrix[i][i] = 1 / std::sqrt(sum);
      }
      else
      {
        return false;
      }
    }
  }
  for (int i = 0; i < unknowns; ++i)
  {
    for (int j = 0; j < i; ++j)
    {
      x[i] -= matrix[i][j] * x[j];
    }
    x[i] *= matrix[i][i];
  }
  for (int i = unknowns - 1; i >= 0; --i)
  {
    for (int j = i + 1; j < unknowns; ++j)
    {
      x[i] -= matrix[j][i] * x[j];
    }
    x[i] *= matrix[i][i];
  }
  return true;
}

/// A point's neighbours, counted from it.
struct Neighbour
{
  Vector x;
  double value;
};

/// L with L * transposed(L) = the mean of x * transposed(x): places in units of it are as far along every axis.
bool spreadOf(const std::vector<Neighbour>& neighbours, double spread[3][3])
{
  double sums[3][3] = {};
  for (const Neighbour& neighbour : neighbours)
  {
    for (std::size_t i = 0; i < 3; ++i)
    {
      for (std::size_t k = 0; k <= i; ++k)
      {
        sums[i][k] += neighbour.x[i] * neighbour.x[k];
      }
    }
  }
  const double trace = sums[0][0] + sums[1][1] + sums[2][2];
  for (int i = 0; i < 3; ++i)
  {
    for (int k = 0; k <= i; ++k)
    {
      double sum =
        sums[i][k] / static_cast<double>(neighbours.size()) + (i == k ? leastFirst * trace : 0);
      for (int j = 0; j < k; ++j)
      {
        sum -= spread[i][j] * spread[k][j];
      }
      spread[i][k] = k < i ? sum / spread[k][k] : std::sqrt(sum);
    }
    if (!(spread[i][i] > 0))
    {
      return false;
    }
  }
  return true;
}

/// Lowest and highest value, counted from the point's own.
std::array<double, 2> rangeOf(const std::vector<Neighbour>& neighbours)
{
  std::array<double, 2> range = { 0, 0 };
  for (const Neighbour& neighbour : neighbours)
  {
    range[0] = std::min(range[0], neighbour.value);
    range[1] = std::max(range[1], neighbour.value);
  }
  const double more = overshoot * (range[1] - range[0]);
  return { range[0] - more, range[1] + more };
}

/// Zero where there is no good one.
Vector gradientOf(const std::vector<Neighbour>& neighbours, const std::array<double, 2>& range)
{
  double spread[3][3];
  if (neighbours.size() < 3 || !spreadOf(neighbours, spread))
  {
    return {};
  }
  // The fit's matrix, and behind it its right side and the sum of the values' squares: the same number of columns
  // in all rows, for the compiler.
  constexpr int columns = unknowns + 1;
  double sums[columns][columns] = {};
  for (const Neighbour& neighbour : neighbours)
  {
    double y[3];
    for (int i = 0; i < 3; ++i)
    {
      y[i] = neighbour.x[static_cast<std::size_t>(i)];
      for (int k = 0; k < i; ++k)
      {
        y[i] -= spread[i][k] * y[k];
      }
      y[i] /= spread[i][i];
    }
    const double square = y[0] * y[0] + y[1] * y[1] + y[2] * y[2];
    const double weight = 1 / (square + 1e-6);
    const double terms[columns] = { y[0], y[1], y[2], y[0] * y[0], y[1] * y[1], y[2] * y[2],
      y[0] * y[1], y[1] * y[2], y[2] * y[0], neighbour.value };
    for (int i = 0; i < columns; ++i)
    {
      const double weighted = weight * terms[i];
      for (int k = 0; k < columns; ++k)
      {
        sums[i][k] += weighted * terms[k];
      }
    }
  }
  double matrix[unknowns][unknowns], x[unknowns];
  for (int i = 0; i < unknowns; ++i)
  {
    std::copy_n(sums[i], unknowns, matrix[i]);
    x[i] = sums[i][unknowns];
  }
  const double all = sums[unknowns][unknowns];
  double trace[2] = { 0, 0 };
  for (int i = 0; i < unknowns; ++i)
  {
    trace[i / 3 > 0] += matrix[i][i];
  }
  for (int i = 0; i < unknowns; ++i)
  {
    matrix[i][i] += i < 3 ? leastFirst * trace[0] : leastSecond * trace[1] / 6;
  }
  if (!solve(matrix, x))
  {
    return {};
  }
  // What is left of the squares: for the best fit, all that the right side does not take away.
  double left = all;
  for (int i = 0; i < unknowns; ++i)
  {
    left -= x[i] * sums[i][unknowns];
  }
  Vector gradient;
  for (std::size_t i = 3; i-- > 0;)
  {
    gradient[i] = x[i];
    for (std::size_t k = i + 1; k < 3; ++k)
    {
      gradient[i] -= spread[k][i] * gradient[k];
    }
    gradient[i] /= spread[i][i];
  }
  if (!std::isfinite(gradient[0] + gradient[1] + gradient[2]))
  {
    return {};
  }
  const double unfit = all > 0 ? left / all : 0;
  if (unfit > goodFit)
  {
    double least = 1;
    for (const Neighbour& neighbour : neighbours)
    {
      const double reached = dot(gradient, neighbour.x) / 2;
      if (reached > range[1] || reached < range[0])
      {
        least = std::min(least, range[reached > 0] / reached);
      }
    }
    const double limited = std::min(1., (unfit - goodFit) / (poorFit - goodFit));
    for (double& along : gradient)
    {
      along *= 1 + limited * (least - 1);
    }
  }
  return gradient;
}

} // namespace

PointNeighbours::PointNeighbours(
  const MeshArrays& mesh, std::vector<unsigned char> isCellUsed, const WorkProgress& progress)
{
  if (mesh.isStructured())
  {
    this->IsCellUsed = std::move(isCellUsed);
    return;
  }
  const CellsOfPoints known = cellsOfPoints(mesh, isCellUsed, progress.part(0, 0.3));
  const vtkIdType points = mesh.points();
  std::vector<std::vector<std::uint32_t>> parts(
    static_cast<std::size_t>((points + partSize - 1) / partSize));
  this->Starts.resize(static_cast<std::size_t>(points) + 1);
  forParts(points, progress.part(0.3, 1),
    [&](vtkIdType begin, vtkIdType end)
    {
      PointSet found;
      const auto forCells = [&](vtkIdType point, const auto& visit)
      {
        const auto at = static_cast<std::size_t>(point);
        for (std::uint64_t i = known.starts[at]; i < known.starts[at + 1]; ++i)
        {
          visit(static_cast<vtkIdType>(known.cells[i]));
        }
      };
      for (vtkIdType point = begin; point < end; ++point)
      {
        findNeighbours(mesh, forCells, point, found);
        std::vector<std::uint32_t>& part = parts[static_cast<std::size_t>(point / partSize)];
        part.insert(part.end(), found.points().begin() + 1, found.points().end());
        this->Starts[static_cast<std::size_t>(point) + 1] = found.points().size() - 1;
      }
    });
  std::partial_sum(this->Starts.begin(), this->Starts.end(), this->Starts.begin());
  this->Ids.reserve(this->Starts.back());
  for (std::vector<std::uint32_t>& part : parts)
  {
    this->Ids.insert(this->Ids.end(), part.begin(), part.end());
    part = std::vector<std::uint32_t>();
  }
}

std::vector<PointTrend> PointNeighbours::trends(
  const MeshArrays& mesh, const WorkProgress& progress) const
{
  std::vector<PointTrend> trends(static_cast<std::size_t>(mesh.points()));
  const auto forCells = [&](vtkIdType point, const auto& visit)
  {
    mesh.forCellsAround(point,
      [&](vtkIdType cell)
      {
        if (this->IsCellUsed[static_cast<std::size_t>(cell)])
        {
          visit(cell);
        }
      });
  };
  forParts(mesh.points(), progress,
    [&](vtkIdType begin, vtkIdType end)
    {
      PointSet found;
      std::vector<Neighbour> neighbours;
      for (vtkIdType point = begin; point < end; ++point)
      {
        const auto at = static_cast<std::size_t>(point);
        const std::uint32_t *first = nullptr, *last = nullptr;
        if (mesh.isStructured())
        {
          findNeighbours(mesh, forCells, point, found);
          first = found.points().data() + 1;
          last = found.points().data() + found.points().size();
        }
        else
        {
          first = this->Ids.data() + this->Starts[at];
          last = this->Ids.data() + this->Starts[at + 1];
        }
        Vector x;
        mesh.coordinates(point, x.data());
        neighbours.clear();
        for (; first != last; ++first)
        {
          Neighbour neighbour;
          mesh.coordinates(*first, neighbour.x.data());
          double distance = 0;
          for (std::size_t axis = 0; axis < 3; ++axis)
          {
            neighbour.x[axis] -= x[axis];
            distance += std::abs(neighbour.x[axis]);
          }
          neighbour.value = mesh.values()[*first] - mesh.values()[point];
          if (distance > 0) // not a double of the point
          {
            neighbours.push_back(neighbour);
          }
        }
        const std::array<double, 2> range = rangeOf(neighbours);
        const Vector gradient = gradientOf(neighbours, range);
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
          trends[at].gradient[axis] = static_cast<float>(gradient[axis]);
        }
        trends[at].lowest = static_cast<float>(range[0]);
        trends[at].highest = static_cast<float>(range[1]);
      }
    });
  return trends;
}

std::size_t PointNeighbours::bytes() const
{
  return this->Starts.size() * sizeof(std::uint64_t) + this->Ids.size() * sizeof(std::uint32_t) +
    this->IsCellUsed.size();
}

} // namespace refractivity
