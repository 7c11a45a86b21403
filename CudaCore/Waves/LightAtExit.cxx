// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Waves/LightAtExit.h"

#include "Device/Parallel.h"
#include "Waves/Spline.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace schlieren
{

namespace
{

constexpr std::int64_t rowsInPiece = 16;

/// Calls use(ray) for all rays, from several threads.
template <class Use>
void forEachRay(std::int64_t columns, std::int64_t rows, int threads, const Use& use)
{
  parallelFor(rows, rowsInPiece, threads,
    [&](std::int64_t begin, std::int64_t end)
    {
      for (std::int64_t ray = begin * columns; ray < end * columns; ++ray)
      {
        use(ray);
      }
    });
}

/// For each ray the nearest one that is not blocked, by rows and columns; -1 where there is none.
std::vector<std::int64_t> nearestOpen(const LightAtExit& light)
{
  constexpr std::int64_t none = -1;
  const std::int64_t columns = light.columns, rows = light.rows;
  std::vector<std::int64_t> nearest(light.size());
  for (std::size_t ray = 0; ray < nearest.size(); ++ray)
  {
    nearest[ray] = light.isBlocked[ray] != 0 ? none : static_cast<std::int64_t>(ray);
  }
  const auto distance = [&](std::int64_t from, std::int64_t to)
  {
    const std::int64_t x = from % columns - to % columns, y = from / columns - to / columns;
    return x * x + y * y;
  };
  const auto takeOf = [&](std::int64_t ray, std::int64_t neighbour)
  {
    std::int64_t& mine = nearest[static_cast<std::size_t>(ray)];
    const std::int64_t its = nearest[static_cast<std::size_t>(neighbour)];
    if (its != none && (mine == none || distance(ray, its) < distance(ray, mine)))
    {
      mine = its;
    }
  };
  // There and back, each ray looks at the neighbours that have been visited.
  for (const int way : { 1, -1 })
  {
    const std::int64_t last = columns * rows - 1;
    for (std::int64_t i = 0; i <= last; ++i)
    {
      const std::int64_t ray = way > 0 ? i : last - i;
      const std::int64_t column = ray % columns, row = ray / columns;
      const bool hasRow = way > 0 ? row > 0 : row + 1 < rows;
      if (way > 0 ? column > 0 : column + 1 < columns)
      {
        takeOf(ray, ray - way);
      }
      if (hasRow)
      {
        takeOf(ray, ray - way * columns);
      }
    }
  }
  return nearest;
}

/// Rays on a plane: how far from where they started, in rays, and their paths.
struct RaysOnPlane
{
  RayValues moved[2];
  RayValues path;
  RayValues ratio; ///< of areas between rays
};

RaysOnPlane raysOnPlane(const LightAtExit& light, double back, int threads)
{
  RaysOnPlane rays{ { RayValues(light.size()), RayValues(light.size()) }, RayValues(light.size()),
    RayValues(light.size()) };
  forEachRay(light.columns, light.rows, threads,
    [&](std::int64_t number)
    {
      const auto ray = static_cast<std::size_t>(number);
      const double eps[2] = { light.deflection[0][ray], light.deflection[1][ray] };
      const double square = std::min(0.99, eps[0] * eps[0] + eps[1] * eps[1]);
      const double cosine = std::sqrt(1 - square);
      for (int axis = 0; axis < 2; ++axis)
      {
        rays.moved[axis][ray] =
          (light.displacement[axis][ray] - back * eps[axis] / cosine) / light.spacing;
      }
      // 1 / cosine - 1, without losing small angles.
      const double longer = square / (cosine * (1 + cosine));
      rays.path[ray] = light.path[ray] - light.refractiveIndex * back * longer;
    });
  return rays;
}

/// The derivative along an axis by central differences, one-sided at the ends.
double differenceOf(const RayValues& values, std::int64_t at, std::int64_t index,
  std::int64_t points, std::int64_t stride)
{
  const std::int64_t before = index > 0 ? stride : 0, after = index + 1 < points ? stride : 0;
  return (values[static_cast<std::size_t>(at + after)] -
           values[static_cast<std::size_t>(at - before)]) *
    static_cast<double>(stride) / static_cast<double>(before + after);
}

void findRatios(RaysOnPlane& rays, std::int64_t columns, std::int64_t rows, int threads)
{
  forEachRay(columns, rows, threads,
    [&](std::int64_t ray)
    {
      double d[2][2];
      for (int axis = 0; axis < 2; ++axis)
      {
        d[axis][0] = differenceOf(rays.moved[axis], ray, ray % columns, columns, 1);
        d[axis][1] = differenceOf(rays.moved[axis], ray, ray / columns, rows, columns);
      }
      rays.ratio[static_cast<std::size_t>(ray)] = (1 + d[0][0]) * (1 + d[1][1]) - d[0][1] * d[1][0];
    });
}

double leastRatio(const RaysOnPlane& rays, const LightAtExit& light)
{
  double least = 1;
  for (std::size_t ray = 0; ray < light.size(); ++ray)
  {
    if (light.isBlocked[ray] == 0)
    {
      least = std::min(least, rays.ratio[ray]);
    }
  }
  return least;
}

/// Where the ray started that is at (column, row) of the plane: by Newton's method, which starts there.
struct Start
{
  double column, row;
};
Start startOf(const Spline (&moved)[2], double column, double row)
{
  constexpr int rounds = 6;
  constexpr double closeEnough = 1e-6; // rays
  Start start{ column, row };
  for (int round = 0; round < rounds; ++round)
  {
    const Spline::Sample u = moved[0].at(start.column, start.row);
    const Spline::Sample v = moved[1].at(start.column, start.row);
    const double missing[2] = { column - start.column - u.value, row - start.row - v.value };
    const double ratio = (1 + u.alongColumns) * (1 + v.alongRows) - u.alongRows * v.alongColumns;
    const double perRatio = 1 / std::max(ratio, leastTubeRatioAllowed);
    const double step[2] = { perRatio * ((1 + v.alongRows) * missing[0] - u.alongRows * missing[1]),
      perRatio * ((1 + u.alongColumns) * missing[1] - v.alongColumns * missing[0]) };
    start.column += step[0];
    start.row += step[1];
    if (std::abs(step[0]) + std::abs(step[1]) < closeEnough)
    {
      break;
    }
  }
  return start;
}

} // namespace

void LightAtExit::resize(std::int64_t ofColumns, std::int64_t ofRows)
{
  columns = ofColumns;
  rows = ofRows;
  const auto rays = static_cast<std::size_t>(columns * rows);
  for (RayValues* values :
    { &path, &deflection[0], &deflection[1], &displacement[0], &displacement[1] })
  {
    values->assign(rays, 0);
  }
  passing.assign(rays, 1);
  isBlocked.assign(rays, 0);
}

void continueBehindBodies(LightAtExit& light)
{
  const auto isOpen = [](unsigned char blocked) { return blocked == 0; };
  if (std::all_of(light.isBlocked.begin(), light.isBlocked.end(), isOpen))
  {
    return;
  }
  const std::vector<std::int64_t> nearest = nearestOpen(light);
  for (std::size_t ray = 0; ray < light.size(); ++ray)
  {
    if (light.isBlocked[ray] != 0 && nearest[ray] >= 0)
    {
      const auto from = static_cast<std::size_t>(nearest[ray]);
      light.path[ray] = light.path[from];
      for (int axis = 0; axis < 2; ++axis)
      {
        light.deflection[axis][ray] = light.deflection[axis][from];
        light.displacement[axis][ray] = light.displacement[axis][from];
      }
    }
  }
}

double bestPlane(const LightAtExit& light, double otherwise)
{
  constexpr double hardlyBent =
    1e-9; // radians, root of the mean square: 1e-11 m of path in a centimetre
  double across = 0, squares = 0;
  for (std::size_t ray = 0; ray < light.size(); ++ray)
  {
    for (int axis = 0; axis < 2 && light.isBlocked[ray] == 0; ++axis)
    {
      const double eps = light.deflection[axis][ray];
      across += light.displacement[axis][ray] * eps;
      squares += eps * eps;
    }
  }
  const bool isBent =
    squares > hardlyBent * hardlyBent * static_cast<double>(std::max<std::size_t>(1, light.size()));
  return isBent ? across / squares : otherwise;
}

double linearAt(const std::vector<float>& values, std::int64_t columns, std::int64_t rows,
  double column, double row)
{
  const double x = std::clamp(column, 0., static_cast<double>(columns - 1));
  const double y = std::clamp(row, 0., static_cast<double>(rows - 1));
  const auto i = std::min(static_cast<std::int64_t>(x), columns - 2);
  const auto j = std::min(static_cast<std::int64_t>(y), rows - 2);
  const double fx = x - static_cast<double>(i), fy = y - static_cast<double>(j);
  const float* low = values.data() + j * columns + i;
  const float* high = low + columns;
  return (1 - fy) * ((1 - fx) * static_cast<double>(low[0]) + fx * static_cast<double>(low[1])) +
    fy * ((1 - fx) * static_cast<double>(high[0]) + fx * static_cast<double>(high[1]));
}

LightOnPlane bringToPlane(const LightAtExit& light, double back, int threads)
{
  const std::int64_t columns = light.columns, rows = light.rows;
  RaysOnPlane rays = raysOnPlane(light, back, threads);
  findRatios(rays, columns, rows, threads);
  LightOnPlane plane{ columns, rows, light.spacing, RayValues(light.size()),
    RayValues(light.size()), std::vector<float>(light.size()), leastRatio(rays, light) };
  if (!(plane.leastTubeRatio > leastTubeRatioAllowed))
  {
    std::ostringstream text;
    text << "Rays cross within the flow (their least ratio of areas is " << plane.leastTubeRatio
         << "), so that light has no one path to its far side, and no wave image can be made of "
            "rays. Set LightModel to "
            "Rays, or leave out what bends light so strongly.";
    throw Error(text.str());
  }
  const Spline moved[2] = { Spline(rays.moved[0], columns, rows),
    Spline(rays.moved[1], columns, rows) };
  const Spline path(rays.path, columns, rows), ratio(rays.ratio, columns, rows);
  forEachRay(columns, rows, threads,
    [&](std::int64_t number)
    {
      const auto at = static_cast<std::size_t>(number);
      const Start start = startOf(
        moved, static_cast<double>(number % columns), static_cast<double>(number / columns));
      plane.path[at] = path.at(start.column, start.row).value;
      plane.amplitude[at] =
        1 / std::sqrt(std::max(ratio.at(start.column, start.row).value, leastTubeRatioAllowed));
      // A spline would overshoot at a body's edge.
      plane.passing[at] =
        static_cast<float>(linearAt(light.passing, columns, rows, start.column, start.row));
    });
  return plane;
}

} // namespace schlieren
