// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Bench/PatchFilm.h"

#include "Bench/StageSettings.h"
#include "Math/Units.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace schlieren
{

namespace
{

Projection projectionOfPart(const Projection& projection, double column, double row)
{
  Projection part = projection;
  part.inclination.atOrigin[0] += column * projection.inclination.perPixel;
  part.inclination.atOrigin[1] += row * projection.inclination.perPixel;
  return part;
}

FilmSettings settingsOf(const Patch& patch, const Scene& scene, int samples, int threads)
{
  FilmSettings settings = filmSettingsOf(scene);
  settings.width = static_cast<int>(patch.columns);
  settings.height = static_cast<int>(patch.rows);
  settings.samplesPerPixel = samples;
  settings.smoothingRadius = 0;
  settings.isOfCamera = false;
  settings.threads = threads;
  return settings;
}

/// What a shift by a pixel would change of the light, at the most, in any of its channels.
double slopeAt(std::size_t pixel, const std::vector<float>& light, const Patch& patch)
{
  const auto columns = static_cast<std::size_t>(patch.columns);
  const auto rows = static_cast<std::size_t>(patch.rows);
  const std::size_t column = pixel % columns, row = pixel / columns;
  const std::size_t channels = light.size() / (columns * rows);
  double slope = 0;
  const auto look = [&](bool isThere, std::size_t other)
  {
    for (std::size_t channel = 0; channel < channels && isThere; ++channel)
    {
      const float change = light[channels * other + channel] - light[channels * pixel + channel];
      slope = std::max(slope, std::abs(static_cast<double>(change)));
    }
  };
  look(column > 0, pixel - 1);
  look(column + 1 < columns, pixel + 1);
  look(row > 0, pixel - columns);
  look(row + 1 < rows, pixel + columns);
  return slope;
}

double differenceAt(std::size_t pixel, const PatchPixels& a, const PatchPixels& b,
  const Patch& patch, double factor, const Scene& scene, const Projection& projection)
{
  const Technique& technique = techniqueOf(scene.cutoff);
  if (technique.plane == RecordedPlane::Background)
  {
    const auto movedBy = [&](std::size_t axis)
    { return static_cast<double>(a.moved[2 * pixel + axis] - b.moved[2 * pixel + axis]); };
    return factor * projection.perDataUnit * std::hypot(movedBy(0), movedBy(1));
  }
  const std::size_t channels = a.light.size() / b.isLit.size();
  double ofLight = 0;
  for (std::size_t at = channels * pixel; at < channels * (pixel + 1); ++at)
  {
    ofLight = std::max(
      ofLight, std::abs(static_cast<double>(a.light[at]) - static_cast<double>(b.light[at])));
  }
  ofLight *= factor;
  if (technique.plane == RecordedPlane::Screen)
  {
    return std::max(0., ofLight - invisibleShift * slopeAt(pixel, b.light, patch));
  }
  if (technique.hasFringes)
  {
    // The light of a fringe changes by pi of its range in a fringe, at the most.
    const double ofPath =
      b.isClear[pixel] ? factor * std::abs(a.path[pixel] - b.path[pixel]) / scene.wavelength : 0;
    return std::max(ofLight / pi, ofPath);
  }
  return ofLight;
}

} // namespace

PatchFilm::PatchFilm(const Patch& patch, const Scene& scene, const Cutoffs& cutoff,
  const Projection& projection, int samples, int threads)
  : patch_(patch)
  , projection_(projectionOfPart(
      projection, static_cast<double>(patch.fromColumn), static_cast<double>(patch.fromRow)))
  , settings_(settingsOf(patch, scene, samples, threads))
  , film_(settings_)
{
  const std::int64_t rays = (patch.columns + 2 * patch.margin) * (patch.rows + 2 * patch.margin);
  film_.begin({ cutoff, projection_, patch.margin, rays * passesToHold(samples) });
  // What lands on a patch from elsewhere counts as a whole.
  const bool isOfPlace = patch.fromColumn == patch.column && patch.fromRow == patch.row;
  const auto pixels = static_cast<std::size_t>(patch.columns * patch.rows);
  pixels_.hasMet.assign(pixels, !isOfPlace);
  pixels_.isLit.assign(pixels, !isOfPlace);
  pixels_.isStopped.assign(pixels, false);
}

void PatchFilm::add(const TracedPass& traced, const Pass& pass)
{
  const auto before = static_cast<float>(film_.passes());
  const bool isFirst = before == 0;
  film_.add(traced, pass, schlieren::Rays::Go, {});
  const std::int64_t columns = patch_.columns + 2 * patch_.margin;
  rays_.resize(traced.exits.size(), { 0, { 0, 0 } });
  for (std::size_t n = 0; n < rays_.size(); ++n)
  {
    const RayExit& exit = traced.exits[n];
    if (exit.fate == RayFate::Left && rays_[n].blocked == before)
    {
      const auto ray = static_cast<std::int64_t>(n);
      const FilmShift shift = shiftOnFilm(exit.deflection, exit.displacement, pass.columnOf(ray),
        pass.rowOf(ray), pass.tilt, projection_);
      for (std::size_t axis = 0; axis < 2; ++axis)
      {
        rays_[n].moved[axis] = projection_.perDataUnit * shift.moved[axis];
      }
    }
    rays_[n].blocked += exit.fate == RayFate::Blocked ? 1 : 0;
  }
  std::size_t pixel = 0;
  for (std::int64_t row = patch_.margin; row < patch_.margin + patch_.rows; ++row)
  {
    for (std::int64_t column = patch_.margin; column < patch_.margin + patch_.columns; ++column)
    {
      const RayExit& exit = traced.exits[static_cast<std::size_t>(row * columns + column)];
      pixels_.hasMet[pixel] = pixels_.hasMet[pixel] || exit.fate != RayFate::Missed;
      pixels_.isLit[pixel] = pixels_.isLit[pixel] || exit.reachesFilm();
      pixels_.isStopped[pixel] = pixels_.isStopped[pixel] || exit.fate == RayFate::Blocked;
      if (isFirst)
      {
        pixels_.isClear.push_back(exit.reachesFilm());
      }
      ++pixel;
    }
  }
}

Image PatchFilm::image()
{
  Image image;
  image.width = settings_.width;
  image.height = settings_.height;
  film_.develop(image);
  return image;
}

PatchPixels PatchFilm::develop()
{
  const Image image = this->image();
  for (RaysOfPixel& ray : rays_)
  {
    ray.blocked /= static_cast<float>(film_.passes());
  }
  const EdgePixels edges(rays_, patch_.columns, patch_.margin);
  for (std::int64_t n = 0; n < patch_.columns * patch_.rows; ++n)
  {
    const std::int64_t column = n % patch_.columns, row = n / patch_.columns;
    pixels_.areAtEdge.push_back(edges.isLit(column, row));
    pixels_.withRays += edges.hasRays(column, row) ? 1 : 0;
  }
  const PixelArray<float>& light = image.color.empty() ? image.intensity : image.color;
  pixels_.light.assign(light.begin(), light.end());
  pixels_.path.assign(image.opticalPathDifference.begin(), image.opticalPathDifference.end());
  const PixelArray<float> moved = backgroundDisplacement(image, projection_);
  pixels_.moved.assign(moved.begin(), moved.end());
  return std::move(pixels_);
}

void addDifferences(const PatchPixels& a, const PatchPixels& b, const Patch& patch, double factor,
  const Scene& scene, const Projection& projection, Differences& differences, Edges edges,
  const std::vector<bool>* areCounted)
{
  for (std::size_t pixel = 0; pixel < b.isLit.size(); ++pixel)
  {
    if (b.hasMet[pixel] && b.isLit[pixel] && (!areCounted || (*areCounted)[pixel]) &&
      (edges == Edges::Count || !(a.isStopped[pixel] || b.isStopped[pixel])))
    {
      const double difference = differenceAt(pixel, a, b, patch, factor, scene, projection);
      differences.push_back({ difference, patch.weight });
    }
  }
}

void addSlopesAtEdges(
  const PatchPixels& pixels, const Patch& patch, const Scene& scene, Differences& differences)
{
  const double unit = techniqueOf(scene.cutoff).hasFringes ? 1 / pi : 1;
  for (std::size_t pixel = 0; pixel < pixels.isLit.size(); ++pixel)
  {
    if (pixels.hasMet[pixel] && pixels.isLit[pixel])
    {
      const double slope = pixels.isStopped[pixel] ? unit * slopeAt(pixel, pixels.light, patch) : 0;
      differences.push_back({ slope, patch.weight });
    }
  }
}

} // namespace schlieren
