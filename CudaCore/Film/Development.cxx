// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Film/Development.h"

#include "Film/Smoothing.h"
#include "Rays/RayStarts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace schlieren
{

Films filmsOf(const FilmSettings& settings, const Cutoffs& cutoff, std::int64_t maxRays)
{
  return { channelsOf(cutoff), settings.width, settings.height, maxRays };
}

void develop(const Films& films, std::int64_t passes, int threads, Image& image)
{
  const auto raysPerPixel = static_cast<double>(passes);
  image.light = films.balance(raysPerPixel);
  image.intensity = films.developIntensity(raysPerPixel, threads);
  if (films.isColored())
  {
    image.color = films.developColor(raysPerPixel, threads);
  }
}

void smooth(const FilmSettings& settings, Image& image)
{
  for (PixelArray<float>* pixels : { &image.intensity, &image.color })
  {
    *pixels = smoothed(std::move(*pixels), settings.width, settings.height,
      settings.smoothingRadius, settings.threads);
  }
}

bool UndisturbedImage::addPass(Device device, const Monitor& monitor)
{
  const std::int64_t margin = exposure_.margin;
  Pass pass{ -margin, -margin, settings_.width + 2 * margin, settings_.height + 2 * margin,
    { 0, 0 } };
  if (!films_)
  {
    films_ = filmsOf(settings_, exposure_.cutoff, exposure_.maxRays);
    const auto rays = static_cast<std::size_t>(pass.columns * pass.rows);
    if (device == Device::Cuda)
    {
      exitsOnDevice_ = std::make_unique<CudaPass>(rays);
      exitsOnDevice_->makeUndisturbed();
      filmOnDevice_ = std::make_unique<CudaFilm>(*films_);
    }
    else
    {
      exits_.assign(rays, {});
    }
  }
  pass.offset = pixelOffset(passes_, settings_.seed);
  pass.side = sideOf(settings_.samplesPerPixel);
  const std::array<double, 2> place = pupilPoint(passes_, settings_.samplesPerPixel);
  for (std::size_t axis = 0; axis < 2; ++axis)
  {
    pass.tilt[axis] = exposure_.projection.pupilTilt * place[axis];
  }
  if (filmOnDevice_)
  {
    filmOnDevice_->expose(*exitsOnDevice_, pass, exposure_.cutoff, exposure_.projection, margin);
  }
  else
  {
    exposeFrom(nextRow_, { { pass, exits_.data() } }, exposure_.cutoff, exposure_.projection,
      margin, settings_.threads, *films_, monitor);
  }
  passes_ += nextRow_ == 0 ? 1 : 0;
  return nextRow_ == 0;
}

PixelArray<float> UndisturbedImage::develop()
{
  if (filmOnDevice_)
  {
    filmOnDevice_->develop(*films_);
  }
  Image image;
  schlieren::develop(*films_, passes_, settings_.threads, image);
  smooth(settings_, image);
  return std::move(image.intensity);
}

PixelArray<float> backgroundDisplacement(const Image& image, const Projection& projection)
{
  PixelArray<float> moved(image.displacement.size());
  for (std::size_t pixel = 0; 2 * pixel < moved.size(); ++pixel)
  {
    const float* eps = &image.deflection[2 * pixel];
    const float* displacement = &image.displacement[2 * pixel];
    const auto width = static_cast<std::size_t>(image.width);
    const FilmShift shift =
      shiftOnFilm({ static_cast<double>(eps[0]), static_cast<double>(eps[1]) },
        { displacement[0], displacement[1] }, static_cast<double>(pixel % width),
        static_cast<double>(pixel / width), { 0, 0 }, projection);
    moved[2 * pixel] = static_cast<float>(shift.moved[0]);
    moved[2 * pixel + 1] = static_cast<float>(shift.moved[1]);
  }
  return moved;
}

} // namespace schlieren
