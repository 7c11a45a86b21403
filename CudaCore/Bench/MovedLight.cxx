// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Bench/MovedLight.h"

#include "Bench/Scouts.h"
#include "Film/Shading.h"
#include "Rays/RayStarts.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace schlieren
{

template <class Real>
std::vector<MovedRay> lookAtLight(const Tracer<Real>& tracer, RayTask<Real> task, const View& view)
{
  constexpr double pixelsByRays = 64, fewest = 256, most = 16384;
  constexpr std::int64_t rowsOfBand = 4; // packs of rays are of as many rows at the most
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
  Projection toSlopes{ 1, 1, 0, task.light.inclination };
  toSlopes.exitRatio = task.light.faces.ratio;
  std::vector<MovedRay> moved;
  const RayExit* exit = traced.exits.data();
  for (const Pass& band : bands)
  {
    for (std::int64_t ray = 0; ray < band.columns * band.rows; ++ray, ++exit)
    {
      if (exit->fate != RayFate::Left)
      {
        continue;
      }
      constexpr float none[2] = { 0, 0 };
      const FilmShift slope = shiftOnFilm(
        exit->deflection, none, band.columnOf(ray), band.rowOf(ray), band.tilt, toSlopes);
      moved.push_back({ { static_cast<double>(exit->displacement[0]),
                          static_cast<double>(exit->displacement[1]) },
        { slope.moved[0], slope.moved[1] } });
    }
  }
  return moved;
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

} // namespace schlieren
