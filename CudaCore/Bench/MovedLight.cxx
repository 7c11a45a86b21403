// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Bench/MovedLight.h"

#include "Bench/Scouts.h"
#include "Device/Parallel.h"
#include "Film/Shading.h"
#include "Rays/Cpu/CpuTracer.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace schlieren
{

template <class Real>
std::vector<MovedRay> lookAtLight(RayTask<Real> task, const View& view, int threads)
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
  const std::int64_t bands = (rows + rowsOfBand - 1) / rowsOfBand;
  Projection toSlopes{ 1, 1, 0, task.light.inclination };
  toSlopes.exitRatio = task.light.faces.ratio;
  std::vector<std::vector<MovedRay>> ofBands(static_cast<std::size_t>(bands));
  parallelFor(bands, 1, threads,
    [&](std::int64_t begin, std::int64_t end)
    {
      for (std::int64_t band = begin; band < end; ++band)
      {
        const std::int64_t row = band * rowsOfBand;
        const Pass pass{ 0, row, columns, std::min(rowsOfBand, rows - row), pixelOffset(band, 1) };
        TracedPass traced;
        traced.resize(pass, 0);
        traceOnCpu(task, pass, traced, 1, {});
        for (std::int64_t ray = 0; ray < pass.columns * pass.rows; ++ray)
        {
          const RayExit& exit = traced.exits[static_cast<std::size_t>(ray)];
          if (exit.fate != RayFate::Left)
          {
            continue;
          }
          constexpr float none[2] = { 0, 0 };
          const FilmShift slope = shiftOnFilm(
            exit.deflection, none, pass.columnOf(ray), pass.rowOf(ray), pass.tilt, toSlopes);
          ofBands[static_cast<std::size_t>(band)].push_back(
            { { static_cast<double>(exit.displacement[0]),
                static_cast<double>(exit.displacement[1]) },
              { slope.moved[0], slope.moved[1] } });
        }
      }
    });
  std::vector<MovedRay> moved;
  for (const std::vector<MovedRay>& band : ofBands)
  {
    moved.insert(moved.end(), band.begin(), band.end());
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

template std::vector<MovedRay> lookAtLight(RayTask<float>, const View&, int);
template std::vector<MovedRay> lookAtLight(RayTask<double>, const View&, int);

} // namespace schlieren
