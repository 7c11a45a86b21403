// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "PointTrends.h"

#include "PointFit.h"
#include "Vectors.h"

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

const FitPoints fitPoints = functionsToFit().back();

/// What is known of one of the points.
PointTrend trendOf(const PointFit& fit, std::size_t point)
{
  const double more = overshoot * (fit.highest[point] - fit.lowest[point]);
  const double lowest = fit.lowest[point] - more, highest = fit.highest[point] + more;
  double least = 1;
  if (fit.unfit[point] > goodFit)
  {
    for (std::size_t i = 0; i < fit.counts[point]; ++i)
    {
      const double* neighbour = fit.numbers.data() + 4 * PointFit::points * i + point;
      double reached = 0;
      for (int axis = 0; axis < 3; ++axis)
      {
        reached += fit.gradient[axis][point] * neighbour[axis * PointFit::points] / 2;
      }
      if (reached > highest || reached < lowest)
      {
        least = std::min(least, (reached > 0 ? highest : lowest) / reached);
      }
    }
  }
  const double limited = std::clamp((fit.unfit[point] - goodFit) / (poorFit - goodFit), 0., 1.);
  PointTrend trend;
  for (int axis = 0; axis < 3; ++axis)
  {
    trend.gradient[axis] =
      static_cast<float>(fit.gradient[axis][point] * (1 + limited * (least - 1)));
  }
  trend.lowest = static_cast<float>(lowest);
  trend.highest = static_cast<float>(highest);
  return trend;
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
      std::vector<std::uint32_t> ids;     // of all points that are fitted at once
      std::size_t ends[PointFit::points]; // in them
      PointFit fit;
      for (vtkIdType first = begin; first < end; first += PointFit::points)
      {
        const auto count =
          static_cast<std::size_t>(std::min<vtkIdType>(PointFit::points, end - first));
        ids.clear();
        std::size_t most = 0;
        for (std::size_t i = 0; i < count; ++i)
        {
          const vtkIdType point = first + static_cast<vtkIdType>(i);
          const auto at = static_cast<std::size_t>(point);
          const std::size_t before = ids.size();
          if (mesh.isStructured())
          {
            findNeighbours(mesh, forCells, point, found);
            ids.insert(ids.end(), found.points().begin() + 1, found.points().end());
          }
          else
          {
            ids.insert(ids.end(), this->Ids.begin() + static_cast<std::ptrdiff_t>(this->Starts[at]),
              this->Ids.begin() + static_cast<std::ptrdiff_t>(this->Starts[at + 1]));
          }
          ends[i] = ids.size();
          most = std::max(most, ends[i] - before);
        }
        fit.clear(most);
        std::size_t next = 0;
        for (std::size_t i = 0; i < count; ++i)
        {
          const vtkIdType point = first + static_cast<vtkIdType>(i);
          Vector x;
          mesh.coordinates(point, x.data());
          for (; next < ends[i]; ++next)
          {
            Vector away;
            mesh.coordinates(ids[next], away.data());
            for (std::size_t axis = 0; axis < 3; ++axis)
            {
              away[axis] -= x[axis];
            }
            if (away[0] != 0 || away[1] != 0 || away[2] != 0) // not a double of the point
            {
              fit.add(i, away.data(), mesh.values()[ids[next]] - mesh.values()[point]);
            }
          }
        }
        fitPoints(fit);
        for (std::size_t i = 0; i < count; ++i)
        {
          trends[static_cast<std::size_t>(first) + i] = trendOf(fit, i);
        }
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
