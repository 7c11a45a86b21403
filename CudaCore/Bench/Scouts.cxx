// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Bench/Scouts.h"

#include "Bench/Differences.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace schlieren
{

namespace
{

constexpr std::int64_t wantedScouts = 4096;

} // namespace

Light lightOfPart(const Light& light, double column, double row, double stride)
{
  Light part = light;
  part.corner = light.start(column, row);
  part.perColumn = stride * light.perColumn;
  part.perRow = stride * light.perRow;
  part.inclination.atOrigin[0] += column * light.inclination.perPixel;
  part.inclination.atOrigin[1] += row * light.inclination.perPixel;
  part.inclination.perPixel *= stride;
  return part;
}

template <class Real>
Scouts::Scouts(RayTask<Real> task, const ViewSetup<Real>& setup, const Scene& scene)
  : technique_(&techniqueOf(scene.cutoff))
  , isOfCamera_(setup.projection.isOfCamera)
  , isExtended_(scene.source.shape != SourceShape::Point || setup.light.pupilTilt > 0)
{
  const View& view = scene.view;
  const Projection& projection = setup.projection;
  const double pixels = static_cast<double>(view.width) * view.height;
  stride_ = std::max<std::int64_t>(1, std::llround(std::sqrt(pixels / wantedScouts)));
  const double middle = 0.5 * static_cast<double>(stride_ - 1);
  task.light = lightOfPart(setup.light, middle, middle, static_cast<double>(stride_));
  const Pass pass{ 0, 0, (view.width + stride_ - 1) / stride_,
    (view.height + stride_ - 1) / stride_, { 0, 0 } };
  const TracedPass traced = setup.tracer.trace(task, pass);

  columns_ = pass.columns;
  rows_ = pass.rows;
  double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
  Differences slopes; // of the path: deflections
  for (std::int64_t row = 0; row < pass.rows; ++row)
  {
    for (std::int64_t column = 0; column < pass.columns; ++column)
    {
      const RayExit& exit = traced.exits[static_cast<std::size_t>(row * pass.columns + column)];
      scouts_.push_back({ exit.fate, { exit.deflection[0], exit.deflection[1] }, { 0, 0 } });
      if (exit.fate != RayFate::Left)
      {
        continue;
      }
      const FilmShift shift = shiftOnFilm(exit.deflection, exit.displacement,
        static_cast<double>(column * stride_) + middle, static_cast<double>(row * stride_) + middle,
        pass.tilt, projection);
      for (std::size_t axis = 0; axis < 2; ++axis)
      {
        scouts_.back().moved[axis] = projection.perDataUnit * shift.moved[axis];
      }
      ++view_.crossed;
      const double* eps = exit.deflection;
      view_.largestDeflection = std::max(view_.largestDeflection, std::hypot(eps[0], eps[1]));
      slopes.push_back({ std::hypot(eps[0], eps[1]), 1 });
      lowest = std::min(lowest, exit.opticalPathDifference);
      highest = std::max(highest, exit.opticalPathDifference);
    }
  }
  view_.path = view_.crossed > 0 ? highest - lowest : 0;
  view_.steepestPath =
    exceededBy(mayExceed, slopes) * setup.settings.lengthScale / projection.perDataUnit;
  view_.strongDeflection = strongDeflection({ pass, traced.exits.data() },
    static_cast<int>(pass.columns), static_cast<int>(pass.rows), setup.errors, scene.threads);
}

const Scout* Scouts::at(std::int64_t column, std::int64_t row) const
{
  return column >= 0 && column < columns_ && row >= 0 && row < rows_
    ? &scouts_[static_cast<std::size_t>(row * columns_ + column)]
    : nullptr;
}

double Scouts::largestDeflectionAround(
  std::int64_t column, std::int64_t row, std::int64_t columns, std::int64_t rows) const
{
  double largest = 0;
  for (std::int64_t j = row / stride_ - 1; j <= (row + rows) / stride_ + 1; ++j)
  {
    for (std::int64_t i = column / stride_ - 1; i <= (column + columns) / stride_ + 1; ++i)
    {
      if (const Scout* scout = at(i, j); scout && scout->fate == RayFate::Left)
      {
        largest = std::max(largest, std::hypot(scout->deflection[0], scout->deflection[1]));
      }
    }
  }
  return largest;
}

/// By how much the light of neighbouring rays differs from a linear change. That of fringes changes as the path does, that of
/// cutoffs as the deflection, and that of a screen as the area J on which it lands: by J' / J^2.
double Scouts::variationAt(std::int64_t column, std::int64_t row) const
{
  const Scout& here = *at(column, row);
  if (technique_->hasFringes)
  {
    return std::hypot(here.deflection[0], here.deflection[1]);
  }
  const bool isOnScreen = technique_->plane == RecordedPlane::Screen;
  double variation = 0;
  double slopes[2][2] = { { 1, 0 }, { 0, 1 } }; // of where rays land
  for (const std::int64_t up : { 0, 1 })
  {
    const Scout* before = at(column - 1 + up, row - up);
    const Scout* after = at(column + 1 - up, row + up);
    for (std::size_t axis = 0; axis < 2 && before && after; ++axis)
    {
      const auto value = [&](const Scout& scout)
      { return isOnScreen ? scout.moved[axis] : scout.deflection[axis]; };
      variation += std::abs(value(*after) - 2 * value(here) + value(*before));
      slopes[up][axis] +=
        (after->moved[axis] - before->moved[axis]) / (2 * static_cast<double>(stride_));
    }
  }
  const double area = slopes[0][0] * slopes[1][1] - slopes[0][1] * slopes[1][0];
  constexpr double smallest = 0.1;
  return isOnScreen ? variation / std::max(smallest * smallest, area * area) : variation;
}

std::vector<double> Scouts::variationsOnFilm() const
{
  std::vector<double> variations(scouts_.size(), 0);
  for (std::int64_t row = 0; row < rows_; ++row)
  {
    for (std::int64_t column = 0; column < columns_; ++column)
    {
      const Scout& scout = *at(column, row);
      const auto landing = [&](std::int64_t from, std::size_t axis, std::int64_t count)
      {
        const double place = static_cast<double>(from) +
          (areShifted() ? scout.moved[axis] / static_cast<double>(stride_) : 0);
        return static_cast<std::int64_t>(
          std::lround(std::clamp(place, 0., static_cast<double>(count - 1))));
      };
      double& there = variations[static_cast<std::size_t>(
        landing(row, 1, rows_) * columns_ + landing(column, 0, columns_))];
      there = std::max(there, variationAt(column, row));
    }
  }
  return variations;
}

template Scouts::Scouts(RayTask<float>, const ViewSetup<float>&, const Scene&);
template Scouts::Scouts(RayTask<double>, const ViewSetup<double>&, const Scene&);

} // namespace schlieren
