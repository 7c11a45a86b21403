// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Bench/MovedLight.h"

#include "Bench/Scouts.h"
#include "Film/Shading.h"
#include "Rays/RayStarts.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace schlieren
{

namespace
{

/// The ray of a number of a pass, by light whose slopes are the shifts of `toSlopes` at a distance of 1.
MovedRay movedRay(
  const RayExit& exit, const Pass& pass, std::int64_t ray, const Projection& toSlopes)
{
  constexpr float none[2] = { 0, 0 };
  const FilmShift slope =
    shiftOnFilm(exit.deflection, none, pass.columnOf(ray), pass.rowOf(ray), pass.tilt, toSlopes);
  return { { static_cast<double>(exit.displacement[0]), static_cast<double>(exit.displacement[1]) },
    { slope.moved[0], slope.moved[1] } };
}

Projection projectionToSlopes(const Light& light)
{
  Projection toSlopes{ 1, 1, 0, light.inclination };
  toSlopes.exitRatio = light.faces.ratio;
  return toSlopes;
}

constexpr std::int64_t rowsOfBand = 4; // packs of rays are of as many rows at the most
constexpr double apartBySquare = 0.25; // of neighbours

} // namespace

template <class Real>
std::vector<MovedRay> lookAtLight(const Tracer<Real>& tracer, RayTask<Real> task, const View& view)
{
  constexpr double pixelsByRays = 64, fewest = 256, most = 16384;
  const std::int64_t around = maxMargin(view);
  const std::int64_t width = view.width + 2 * around, height = view.height + 2 * around;
  const double wanted =
    std::clamp(static_cast<double>(view.width) * view.height / pixelsByRays, fewest, most);
  const double area = static_cast<double>(width) * static_cast<double>(height);
  const std::int64_t stride = std::max<std::int64_t>(1, std::llround(std::sqrt(area / wanted)));
  const double first = 0.5 * static_cast<double>(stride - 1) - static_cast<double>(around);
  task.light = lightOfPart(task.light, first, first, static_cast<double>(stride));
  const std::int64_t columns = (width + stride - 1) / stride, rows = (height + stride - 1) / stride;
  std::vector<Pass> bands;
  for (std::int64_t row = 0; row < rows; row += rowsOfBand)
  {
    const auto number = static_cast<std::int64_t>(bands.size());
    bands.push_back({ 0, row, columns, std::min(rowsOfBand, rows - row), pixelOffset(number, 1) });
  }
  const TracedPass traced = tracer.trace(task, bands);
  const Projection toSlopes = projectionToSlopes(task.light);
  std::vector<MovedRay> moved;
  const RayExit* exit = traced.exits.data();
  for (const Pass& band : bands)
  {
    for (std::int64_t ray = 0; ray < band.columns * band.rows; ++ray, ++exit)
    {
      if (exit->fate == RayFate::Left)
      {
        moved.push_back(movedRay(*exit, band, ray, toSlopes));
      }
    }
  }
  return moved;
}

template <class Real>
std::vector<MovedNeighbours> lookAtNeighbours(
  const Tracer<Real>& tracer, RayTask<Real> task, const View& view)
{
  constexpr double along = 128; // squares on the larger side
  const double stride = std::max(view.width, view.height) / along;
  const double first = 0.5 * (stride - 1);
  task.light = lightOfPart(task.light, first, first, stride);
  const auto columns = static_cast<std::int64_t>(std::ceil(view.width / stride));
  const auto rows = static_cast<std::int64_t>(std::ceil(view.height / stride));
  std::vector<Pass> bands; // three by three: with the neighbours to the right, and above
  for (std::int64_t row = 0; row < rows; row += rowsOfBand)
  {
    const PixelOffset at = pixelOffset(static_cast<std::int64_t>(bands.size()), 1);
    for (const auto& [right, up] :
      { std::pair{ 0., 0. }, { apartBySquare, 0. }, { 0., apartBySquare } })
    {
      bands.push_back(
        { 0, row, columns, std::min(rowsOfBand, rows - row), { at.column + right, at.row + up } });
    }
  }
  const TracedPass traced = tracer.trace(task, bands);
  const Projection toSlopes = projectionToSlopes(task.light);
  std::vector<MovedNeighbours> neighbours;
  const RayExit* exit = traced.exits.data();
  for (std::size_t band = 0; band < bands.size(); band += 3)
  {
    const std::int64_t rays = bands[band].columns * bands[band].rows;
    for (std::int64_t ray = 0; ray < rays; ++ray)
    {
      MovedNeighbours three{};
      three.apart = apartBySquare * stride;
      bool haveLeft = true;
      for (std::size_t i = 0; i < 3; ++i)
      {
        const RayExit& one = exit[static_cast<std::int64_t>(i) * rays + ray];
        haveLeft = haveLeft && one.fate == RayFate::Left;
        three.rays[i] = movedRay(one, bands[band + i], ray, toSlopes);
      }
      if (haveLeft)
      {
        neighbours.push_back(three);
      }
    }
    exit += 3 * rays;
  }
  return neighbours;
}

double maximumShift(const std::vector<MovedRay>& rays, double distance)
{
  double most = 0;
  for (const MovedRay& ray : rays)
  {
    most = std::max(most,
      std::hypot(ray.displacement[0] + distance * ray.slope[0],
        ray.displacement[1] + distance * ray.slope[1]));
  }
  return most;
}

template std::vector<MovedRay> lookAtLight(const Tracer<float>&, RayTask<float>, const View&);
template std::vector<MovedRay> lookAtLight(const Tracer<double>&, RayTask<double>, const View&);
template std::vector<MovedNeighbours> lookAtNeighbours(
  const Tracer<float>&, RayTask<float>, const View&);
template std::vector<MovedNeighbours> lookAtNeighbours(
  const Tracer<double>&, RayTask<double>, const View&);

} // namespace schlieren
