// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "PointTrends.h"

#include "CellShape.h"

#include "vtkSMPTools.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

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

/// Which cells have a point: those of point i are cells[starts[i]] to cells[starts[i + 1]].
struct CellsOfPoints
{
  std::vector<std::size_t> starts;
  std::vector<std::uint32_t> cells;
};

CellsOfPoints cellsOfPoints(
  const MeshArrays& mesh, vtkIdType points, const std::function<bool(vtkIdType)>& isCellUsed)
{
  CellsOfPoints result;
  result.starts.assign(static_cast<std::size_t>(points) + 2, 0);
  std::vector<bool> isUsed(static_cast<std::size_t>(mesh.cells()));
  for (vtkIdType cell = 0; cell < mesh.cells(); ++cell)
  {
    isUsed[static_cast<std::size_t>(cell)] = isCellUsed(cell);
    if (isUsed[static_cast<std::size_t>(cell)])
    {
      mesh.forPoints(
        cell, [&](vtkIdType point) { ++result.starts[static_cast<std::size_t>(point) + 2]; });
    }
  }
  for (std::size_t i = 2; i < result.starts.size(); ++i)
  {
    result.starts[i] += result.starts[i - 1];
  }
  result.cells.resize(result.starts.back());
  for (vtkIdType cell = 0; cell < mesh.cells(); ++cell)
  {
    if (isUsed[static_cast<std::size_t>(cell)])
    {
      mesh.forPoints(cell,
        [&](vtkIdType point)
        {
          result.cells[result.starts[static_cast<std::size_t>(point) + 1]++] =
            static_cast<std::uint32_t>(cell);
        });
    }
  }
  result.starts.pop_back();
  return result;
}

/// Adds the points of all cells that have one of the points. They are sorted then.
void addNeighbours(
  const MeshArrays& mesh, const CellsOfPoints& known, std::vector<vtkIdType>& points)
{
  const std::size_t count = points.size();
  for (std::size_t i = 0; i < count; ++i)
  {
    const auto point = static_cast<std::size_t>(points[i]);
    for (std::size_t k = known.starts[point]; k < known.starts[point + 1]; ++k)
    {
      mesh.forPoints(static_cast<vtkIdType>(known.cells[k]),
        [&](vtkIdType neighbour) { points.push_back(neighbour); });
    }
  }
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
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
  double matrix[unknowns][unknowns] = {}, right[unknowns] = {}, all = 0;
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
    const double terms[unknowns] = { y[0], y[1], y[2], y[0] * y[0], y[1] * y[1], y[2] * y[2],
      y[0] * y[1], y[1] * y[2], y[2] * y[0] };
    for (int i = 0; i < unknowns; ++i)
    {
      const double weighted = weight * terms[i];
      for (int k = 0; k <= i; ++k)
      {
        matrix[i][k] += weighted * terms[k];
      }
      right[i] += weighted * neighbour.value;
    }
    all += weight * neighbour.value * neighbour.value;
  }
  double trace[2] = { 0, 0 };
  for (int i = 0; i < unknowns; ++i)
  {
    trace[i / 3 > 0] += matrix[i][i];
  }
  for (int i = 0; i < unknowns; ++i)
  {
    matrix[i][i] += i < 3 ? leastFirst * trace[0] : leastSecond * trace[1] / 6;
  }
  double x[unknowns];
  std::copy_n(right, unknowns, x);
  if (!solve(matrix, x))
  {
    return {};
  }
  // What is left of the squares: for the best fit, all that the right side does not take away.
  double left = all;
  for (int i = 0; i < unknowns; ++i)
  {
    left -= x[i] * right[i];
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

std::vector<PointTrend> pointTrends(
  const MeshArrays& mesh, const std::function<bool(vtkIdType)>& isCellUsed)
{
  const vtkIdType points = mesh.points();
  std::vector<PointTrend> trends(static_cast<std::size_t>(points));
  const CellsOfPoints known = cellsOfPoints(mesh, points, isCellUsed);
  vtkSMPTools::For(0, points, 4096,
    [&](vtkIdType begin, vtkIdType end)
    {
      std::vector<vtkIdType> ids;
      std::vector<Neighbour> neighbours;
      for (vtkIdType point = begin; point < end; ++point)
      {
        const auto at = static_cast<std::size_t>(point);
        ids.assign(1, point);
        addNeighbours(mesh, known, ids);
        if (ids.size() <= fewNeighbours)
        {
          addNeighbours(mesh, known, ids);
        }
        Vector x;
        mesh.coordinates(point, x.data());
        neighbours.clear();
        for (const vtkIdType id : ids)
        {
          Neighbour neighbour;
          mesh.coordinates(id, neighbour.x.data());
          double distance = 0;
          for (std::size_t axis = 0; axis < 3; ++axis)
          {
            neighbour.x[axis] -= x[axis];
            distance += std::abs(neighbour.x[axis]);
          }
          neighbour.value = mesh.values()[id] - mesh.values()[point];
          if (distance > 0) // not the point itself, nor a double of it
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

} // namespace refractivity
