// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Cells/PointTrends.h"

#include "Cells/CellShape.h"
#include "Cells/PointFit.h"
#include "Common/Vectors.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace filters
{

namespace
{

// How much of the differences of values, squared, a polynomial may leave: gradients up to the first are
// taken as they are, from the second on they are limited in full.
constexpr double goodFit = 0.005;
constexpr double poorFit = 0.02;

/// Fraction of the range of neighbours by which values may exceed it wherever they are.
constexpr double overshoot = 0.01;

const FitPoints fitPoints = functionsToFit().back();

/// A point whose gradient leads beyond the values of its neighbours.
struct Beyond
{
  vtkIdType point;
  float least, most; // half the way to the neighbours
  float limited;     // 0: the gradient stays as it is, 1: it is limited in full
};

/// Returns the trend of one of the points, and adds it to `toBeLimited` if its gradient leads beyond.
PointTrend trendOf(
  const PointFit& fit, std::size_t i, vtkIdType point, std::vector<Beyond>& toBeLimited)
{
  const double more = overshoot * (fit.highest[i] - fit.lowest[i]);
  PointTrend trend;
  for (int axis = 0; axis < 3; ++axis)
  {
    trend.gradient[axis] = static_cast<float>(fit.gradient[axis][i]);
  }
  trend.lowest = static_cast<float>(fit.lowest[i] - more);
  trend.highest = static_cast<float>(fit.highest[i] + more);
  const auto least = static_cast<float>(fit.leastHalf[i]);
  const auto most = static_cast<float>(fit.mostHalf[i]);
  if (least < trend.lowest || most > trend.highest)
  {
    const double limited = std::clamp((fit.unfit[i] - goodFit) / (poorFit - goodFit), 0., 1.);
    toBeLimited.push_back({ point, least, most, static_cast<float>(limited) });
  }
  return trend;
}

/// C of Colella and Sekora (see PointTrends.h): by how much more the second derivative at an extremum may be than the
/// least one nearby.
constexpr float moreThanLeast = 1.25f;

/// By how much values may go beyond at an extremum, in units of what second derivatives make of the distance to the
/// neighbours: the top between two of them is a quarter of it higher, that in the middle of eight up to 0.6.
constexpr float beyondNeighbours = 0.6f;

/// Limits a trend. `leastBend` and `mostBend`: of the point and all its neighbours.
void limit(PointTrend& trend, const Beyond& beyond, float leastBend, float mostBend)
{
  constexpr float part = moreThanLeast * beyondNeighbours;
  trend.highest += part * std::max(-mostBend, 0.f);
  trend.lowest -= part * std::max(leastBend, 0.f);
  float factor = 1;
  factor = beyond.most > trend.highest ? std::min(factor, trend.highest / beyond.most) : factor;
  factor = beyond.least < trend.lowest ? std::min(factor, trend.lowest / beyond.least) : factor;
  for (float& along : trend.gradient)
  {
    along *= 1 + beyond.limited * (factor - 1);
  }
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
  return std::clamp(
    (away - PointFit::onAllSides) / (PointFit::onOneSide - PointFit::onAllSides), 0., 1.);
}

constexpr double infinity = std::numeric_limits<double>::infinity();

bool isMean(const CellsAround& around)
{
  return around.second[0] + around.second[1] + around.second[2] > 0;
}

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

  void add(const MeshArrays& mesh, vtkIdType point, const PointNeighbours::Range& neighbours)
  {
    this->Points[this->Count] = point;
    this->Ids.insert(this->Ids.end(), neighbours.begin(), neighbours.end());
    this->Ends[this->Count++] = this->Ids.size();
    this->Most =
      std::max(this->Most, static_cast<std::size_t>(neighbours.end() - neighbours.begin()));
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

std::vector<PointTrend> trendsOf(
  const MeshArrays& mesh, const PointNeighbours& neighbours, const WorkProgress& progress)
{
  const auto points = static_cast<std::size_t>(mesh.points());
  std::vector<PointTrend> trends(points);
  std::vector<float> bends(points);
  std::vector<std::vector<Beyond>> toBeLimited((points + chunkSize - 1) / chunkSize);
  forChunks(mesh.points(), progress.part(0, 0.95),
    [&](vtkIdType begin, vtkIdType end)
    {
      std::vector<Beyond>& ofChunk = toBeLimited[static_cast<std::size_t>(begin / chunkSize)];
      FitOfPoints fit(PointFit::Values::AtPoints,
        [&](const PointFit& of, std::size_t i, vtkIdType point)
        {
          const auto at = static_cast<std::size_t>(point);
          trends[at] = trendOf(of, i, point, ofChunk);
          bends[at] = static_cast<float>(of.bend[i]);
        });
      PointSet memory;
      for (vtkIdType point = begin; point < end; ++point)
      {
        fit.add(mesh, point, neighbours.of(mesh, point, memory));
      }
      fit.finish(mesh);
    });
  forChunks(mesh.points(), progress.part(0.95, 1),
    [&](vtkIdType begin, vtkIdType)
    {
      PointSet memory;
      for (const Beyond& beyond : toBeLimited[static_cast<std::size_t>(begin / chunkSize)])
      {
        const auto at = static_cast<std::size_t>(beyond.point);
        float least = bends[at], most = least;
        for (const std::uint32_t other : neighbours.of(mesh, beyond.point, memory))
        {
          least = std::min(least, bends[other]);
          most = std::max(most, bends[other]);
        }
        limit(trends[at], beyond, least, most);
      }
    });
  return trends;
}

std::vector<double> valuesOfMeans(
  const MeshArrays& mesh, const PointNeighbours& neighbours, const WorkProgress& progress)
{
  const auto points = static_cast<std::size_t>(mesh.points());
  const double* means = mesh.values();
  const CellsAround* around = mesh.cellsAround();
  struct Change
  {
    float correction, gradient[3];
  };
  std::vector<Change> changes(points);
  constexpr float none = std::numeric_limits<float>::quiet_NaN();
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
      PointSet memory;
      for (vtkIdType point = begin; point < end; ++point)
      {
        if (isMean(around[point]))
        {
          fit.add(mesh, point, neighbours.of(mesh, point, memory));
        }
        else
        {
          changes[static_cast<std::size_t>(point)].correction = none;
        }
      }
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
      PointSet memory;
      for (vtkIdType point = begin; point < end; ++point)
      {
        const auto at = static_cast<std::size_t>(point);
        const CellsAround& cells = around[at];
        if (!isMean(cells))
        {
          values[at] = means[at];
          continue;
        }
        // The corrections nearby, and what gradients nearby make of the distance from the cells to the point, which is long
        // at the boundary only.
        const auto along = [&](const Change& change)
        {
          return -(change.gradient[0] * cells.first[0] + change.gradient[1] * cells.first[1] +
            change.gradient[2] * cells.first[2]);
        };
        float low = changes[at].correction, high = low;
        float down = along(changes[at]), up = down;
        for (const std::uint32_t other : neighbours.of(mesh, point, memory))
        {
          const Change& change = changes[other];
          low = std::max(low, change.correction); // unless there is none
          high = std::min(high, change.correction);
          down = std::max(down, along(change));
          up = std::min(up, along(change));
        }
        low = moreThanLeast * std::min(low, 0.f);
        high = moreThanLeast * std::max(high, 0.f);
        const auto part = static_cast<float>(steeperAtBoundary * partAtBoundary(cells));
        down *= part;
        up *= part;
        // Keeps positive what is positive in all cells, such as a density.
        const double least = std::max(means[at] + std::min(cells.lowest, down) + low,
          isPositive ? leastByCell * (means[at] + cells.lowest) : -infinity);
        const double most = means[at] + std::max(cells.highest, up) + high;
        const double value = means[at] + changes[at].correction;
        values[at] = value < least ? least : value > most ? most : value;
      }
    });
  return values;
}

} // namespace filters
