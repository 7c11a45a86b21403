// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Film/Development.h"

#include "Film/NoiseFilters.h"
#include "Rays/Light.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace schlieren
{

Films filmsOf(
  const Scene& scene, const Cutoffs& cutoff, std::optional<Tint> tint, std::int64_t mostRays)
{
  const View& view = scene.view;
  Films films(channelsOf(cutoff), std::move(tint), view.width, view.height, mostRays);
  if (countsSamples(scene.noiseFilter, scene.noiseFilterRadius))
  {
    films.samples = std::make_unique<Films>(
      Shadowgraph::channels, std::nullopt, view.width, view.height, mostRays);
  }
  return films;
}

void develop(Films& films, const Scene& scene, Image& image)
{
  const View& view = scene.view;
  image.light = films.balance(scene.samplesPerPixel);
  image.intensity = films.developIntensity(scene.samplesPerPixel, scene.threads);
  if (films.isColored())
  {
    image.color = films.developColor(scene.samplesPerPixel, scene.threads);
  }
  const PixelArray<float> samples =
    films.samples ? films.samples->developIntensity(1, scene.threads) : PixelArray<float>();
  films.planes.clear(); // the filters want memory, too
  for (PixelArray<float>* picture : { &image.intensity, &image.color })
  {
    *picture = filtered(std::move(*picture), view.width, view.height, scene.noiseFilter,
      scene.noiseFilterRadius, samples, scene.threads);
  }
}

PixelArray<float> undisturbedPicture(const Scene& scene, const Cutoffs& cutoff,
  const Projection& projection, std::int64_t margin, std::int64_t mostRays, const Monitor& monitor)
{
  Pass pass{ -margin, -margin, scene.view.width + 2 * margin, scene.view.height + 2 * margin,
    { 0, 0 } };
  const std::vector<RayExit> exits(static_cast<std::size_t>(pass.columns * pass.rows));
  Films films = filmsOf(scene, cutoff, {}, mostRays);
  for (std::int64_t number = 0; number < scene.samplesPerPixel; ++number)
  {
    if (monitor.aborted && monitor.aborted())
    {
      return {};
    }
    pass.offset = pixelOffset(number, scene.seed);
    expose({ { pass, exits.data(), nullptr } }, cutoff, projection, margin, scene.filmEstimator,
      scene.threads, films);
  }
  Image image;
  develop(films, scene, image);
  return std::move(image.intensity);
}

PixelArray<float> backgroundDisplacement(const Image& image, double distance)
{
  PixelArray<float> moved(image.displacement.size());
  for (std::size_t i = 0; i < moved.size(); i += 2)
  {
    const double eps[2] = { static_cast<double>(image.deflection[i]),
      static_cast<double>(image.deflection[i + 1]) };
    const double way = distance / std::sqrt(std::max(1 - eps[0] * eps[0] - eps[1] * eps[1], 1e-30));
    for (std::size_t axis = 0; axis < 2; ++axis)
    {
      moved[i + axis] =
        static_cast<float>(static_cast<double>(image.displacement[i + axis]) + way * eps[axis]);
    }
  }
  return moved;
}

} // namespace schlieren
