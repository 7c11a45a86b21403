// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Cells/PointTrends.h"

#include "Cells/CellShape.h"
#include "Cells/PointFit.h"
#include "Common/Vectors.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace filters
{

namespace
{

// How much of the differences of values, squared, a polynomial may leave: gradients up to the first are
// taken as they are, from the second on they are limited in full.
constexpr double goodFit = 0.005;
constexpr double poorFit = 0.02;

/// Fraction of the range of neighbours by which values may exceed it.
constexpr double overshoot = 0.01;

constexpr std::size_t fewNeighbours = 14;

/// Cells of points: those of point i are cells[starts[i]] to cells[starts[i + 1]], in order.
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
    forChunks(mesh.cells(), done,
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
  // Fills from behind, then sorts, so that the order does not depend on threads.
  forCells(progress.part(0.3, 0.7),
    [&](vtkIdType cell, std::size_t point)
    {
      const std::uint32_t left = counts[point].fetch_sub(1, std::memory_order_relaxed);
      result.cells[result.starts[point] + left - 1] = static_cast<std::uint32_t>(cell);
    });
  forChunks(mesh.points(), progress.part(0.7, 1),
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

/// A set of points in the order of insertion: a hash table with open addressing.
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

  std::uint64_t Turn = 1; // marks valid entries
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

/// Maximum ratio of gradients at the boundary to those at points beside it.
constexpr double steeperAtBoundary = 2;

/// Minimum ratio of the density at a point to that of any cell around it.
constexpr double leastByCell = 0.5;

/// 0 where a point has cells on all sides, 1 where it is at the boundary: by how far from the point they are, in units of
/// how far they reach along the same direction.
double partAtBoundary(const CellsAround& cells)
{
  const float* s = cells.second;
  const Vector columns[3] = { { s[0], s[3], s[5] }, { s[3], s[1], s[4] }, { s[5], s[4], s[2] } };
  const Vector first = { cells.first[0], cells.first[1], cells.first[2] };
  Vector rows[3];
  if (!invert(columns, rows))
  {
    return 0;
  }
  const double away =
    dot(first, { dot(rows[0], first), dot(rows[1], first), dot(rows[2], first) }); // up to 3/4
  constexpr double inside = 0.15, outside = 0.45;
  return std::clamp((away - inside) / (outside - inside), 0., 1.);
}

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Fits polynomials of points that come one by one, several at once. Calls take(fit, its number there, point).
template <class Take>
class FitOfPoints
{
public:
  FitOfPoints(PointFit::Values values, Take take)
    : Kind(values)
    , Taken(std::move(take))
  {
  }

  void add(
    const MeshArrays& mesh, vtkIdType point, const std::uint32_t* first, const std::uint32_t* last)
  {
    this->Points[this->Count] = point;
    this->Ids.insert(this->Ids.end(), first, last);
    this->Ends[this->Count++] = this->Ids.size();
    this->Most = std::max(this->Most, static_cast<std::size_t>(last - first));
    if (this->Count == PointFit::points)
    {
      this->finish(mesh);
    }
  }

  void finish(const MeshArrays& mesh)
  {
    this->Fit.clear(this->Most, this->Kind);
    for (std::size_t i = 0, next = 0; i < this->Count; ++i)
    {
      for (; next < this->Ends[i]; ++next)
      {
        this->add(mesh, i, this->Points[i], static_cast<vtkIdType>(this->Ids[next]));
      }
      this->setOwn(mesh, i, this->Points[i]);
    }
    fitPoints(this->Fit);
    for (std::size_t i = 0; i < this->Count; ++i)
    {
      this->Taken(this->Fit, i, this->Points[i]);
    }
    this->Ids.clear();
    this->Count = this->Most = 0;
  }

private:
  void add(const MeshArrays& mesh, std::size_t i, vtkIdType point, vtkIdType other)
  {
    Vector x, away;
    mesh.coordinates(point, x.data());
    mesh.coordinates(other, away.data());
    away = away - x;
    if (away[0] == 0 && away[1] == 0 && away[2] == 0) // a double of the point
    {
      return;
    }
    const double value = mesh.values()[other] - mesh.values()[point];
    if (this->Kind == PointFit::Values::AtPoints)
    {
      this->Fit.add(i, away.data(), value);
      return;
    }
    const CellsAround& here = mesh.cellsAround()[point];
    const CellsAround& there = mesh.cellsAround()[other];
    Vector firsts;
    double seconds[6];
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const std::size_t next = (axis + 1) % 3;
      firsts[axis] = away[axis] + there.first[axis] - here.first[axis];
      seconds[axis] =
        away[axis] * (away[axis] + 2 * there.first[axis]) + there.second[axis] - here.second[axis];
      seconds[axis + 3] = away[axis] * (away[next] + there.first[next]) +
        away[next] * there.first[axis] + there.second[axis + 3] - here.second[axis + 3];
    }
    this->Fit.add(i, firsts.data(), seconds, value);
  }

  void setOwn(const MeshArrays& mesh, std::size_t i, vtkIdType point)
  {
    if (this->Kind == PointFit::Values::Means)
    {
      const CellsAround& here = mesh.cellsAround()[point];
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        this->Fit.own[axis][i] = here.first[axis];
        this->Fit.own[axis + 3][i] = here.second[axis];
        this->Fit.own[axis + 6][i] = here.second[axis + 3];
      }
    }
  }

  PointFit::Values Kind;
  Take Taken;
  PointFit Fit;
  vtkIdType Points[PointFit::points];
  std::vector<std::uint32_t> Ids;     // of all points that are fitted at once
  std::size_t Ends[PointFit::points]; // in them
  std::size_t Count = 0, Most = 0;
};

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
  this->Chunks.resize(static_cast<std::size_t>((points + chunkSize - 1) / chunkSize));
  this->Ends.resize(static_cast<std::size_t>(points));
  forChunks(points, progress.part(0.3, 1),
    [&](vtkIdType begin, vtkIdType end)
    {
      PointSet found;
      std::vector<std::uint32_t> ids;
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
        ids.insert(ids.end(), found.points().begin() + 1, found.points().end());
        this->Ends[static_cast<std::size_t>(point)] = static_cast<std::uint32_t>(ids.size());
      }
      this->Chunks[static_cast<std::size_t>(begin / chunkSize)].assign(ids.begin(), ids.end());
    });
}

/// Calls visit(point, begin, end) for points in turn, with the numbers of their neighbours.
template <class Visit>
void PointNeighbours::forNeighbours(
  const MeshArrays& mesh, vtkIdType begin, vtkIdType end, const Visit& visit) const
{
  const auto forCells = [&](vtkIdType point, const auto& visitCell)
  {
    mesh.forCellsAround(point,
      [&](vtkIdType cell)
      {
        if (this->IsCellUsed[static_cast<std::size_t>(cell)])
        {
          visitCell(cell);
        }
      });
  };
  PointSet found;
  for (vtkIdType point = begin; point < end; ++point)
  {
    if (mesh.isStructured())
    {
      findNeighbours(mesh, forCells, point, found);
      const std::uint32_t* ids = found.points().data();
      visit(point, ids + 1, ids + found.points().size());
    }
    else
    {
      const auto at = static_cast<std::size_t>(point);
      const std::uint32_t* ids = this->Chunks[static_cast<std::size_t>(point / chunkSize)].data();
      visit(point, point % chunkSize == 0 ? ids : ids + this->Ends[at - 1], ids + this->Ends[at]);
    }
  }
}

std::vector<PointTrend> PointNeighbours::trends(
  const MeshArrays& mesh, const WorkProgress& progress) const
{
  std::vector<PointTrend> trends(static_cast<std::size_t>(mesh.points()));
  forChunks(mesh.points(), progress,
    [&](vtkIdType begin, vtkIdType end)
    {
      FitOfPoints fit(PointFit::Values::AtPoints,
        [&](const PointFit& of, std::size_t i, vtkIdType point)
        { trends[static_cast<std::size_t>(point)] = trendOf(of, i); });
      this->forNeighbours(mesh, begin, end,
        [&](vtkIdType point, const std::uint32_t* first, const std::uint32_t* last)
        { fit.add(mesh, point, first, last); });
      fit.finish(mesh);
    });
  return trends;
}

std::vector<double> PointNeighbours::valuesFromCells(
  const MeshArrays& mesh, const WorkProgress& progress) const
{
  const auto points = static_cast<std::size_t>(mesh.points());
  const double* means = mesh.values();
  const CellsAround* around = mesh.cellsAround();
  struct Change
  {
    float correction, gradient[3];
  };
  std::vector<Change> changes(points);
  forChunks(mesh.points(), progress.part(0, 0.9),
    [&](vtkIdType begin, vtkIdType end)
    {
      FitOfPoints fit(PointFit::Values::Means,
        [&](const PointFit& of, std::size_t i, vtkIdType point)
        {
          changes[static_cast<std::size_t>(point)] = { static_cast<float>(of.correction[i]),
            { static_cast<float>(of.gradient[0][i]), static_cast<float>(of.gradient[1][i]),
              static_cast<float>(of.gradient[2][i]) } };
        });
      this->forNeighbours(mesh, begin, end,
        [&](vtkIdType point, const std::uint32_t* first, const std::uint32_t* last)
        { fit.add(mesh, point, first, last); });
      fit.finish(mesh);
    });
  double lowest = infinity, largest = 0; // of the cells
  for (std::size_t i = 0; i < points; ++i)
  {
    lowest = std::min(lowest, means[i] + around[i].lowest); // NaN: unknown
    largest = std::max(largest, std::abs(means[i]));
  }
  const bool isPositive = lowest > -1e-6 * largest;
  std::vector<double> values(points);
  forChunks(mesh.points(), progress.part(0.9, 1),
    [&](vtkIdType begin, vtkIdType end)
    {
      this->forNeighbours(mesh, begin, end,
        [&](vtkIdType point, const std::uint32_t* first, const std::uint32_t* last)
        {
          const auto at = static_cast<std::size_t>(point);
          const CellsAround& cells = around[at];
          // The corrections nearby, and what gradients nearby make of the distance from the cells to the point, which is long
          // at the boundary only.
          const auto along = [&](const Change& change)
          {
            return -(change.gradient[0] * cells.first[0] + change.gradient[1] * cells.first[1] +
              change.gradient[2] * cells.first[2]);
          };
          float low = changes[at].correction, high = low;
          float down = along(changes[at]), up = down;
          for (const std::uint32_t* other = first; other != last; ++other)
          {
            const Change& change = changes[*other];
            low = std::max(low, change.correction);
            high = std::min(high, change.correction);
            down = std::max(down, along(change));
            up = std::min(up, along(change));
          }
          low = std::min(low, 0.f);
          high = std::max(high, 0.f);
          const auto part = static_cast<float>(steeperAtBoundary * partAtBoundary(cells));
          down *= part;
          up *= part;
          // Keeps positive what is positive in all cells, such as a density.
          const double least = std::max(means[at] + std::min(cells.lowest, down) + low,
            isPositive ? leastByCell * (means[at] + cells.lowest) : -infinity);
          const double most = means[at] + std::max(cells.highest, up) + high;
          const double value = means[at] + changes[at].correction;
          values[at] = value < least ? least : value > most ? most : value;
        });
    });
  return values;
}

std::size_t PointNeighbours::bytes() const
{
  const std::size_t ids =
    std::accumulate(this->Chunks.begin(), this->Chunks.end(), std::size_t{ 0 },
      [](std::size_t sum, const std::vector<std::uint32_t>& chunk) { return sum + chunk.size(); });
  return (ids + this->Ends.size()) * sizeof(std::uint32_t) + this->IsCellUsed.size();
}

} // namespace filters
