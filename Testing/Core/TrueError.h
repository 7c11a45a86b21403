// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// How far an image is from another one that is taken for the truth, by the definition of Scene::targetError.
#pragma once

#include "Fields.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

namespace schlieren
{

/// The largest difference of light to a neighbour.
inline double slopeAt(const Image& image, int column, int row)
{
  const auto light = [&](int i, int j)
  {
    return static_cast<double>(image.intensity[pixelOf(
      image, std::clamp(i, 0, image.width - 1), std::clamp(j, 0, image.height - 1))]);
  };
  double slope = 0;
  for (const int step : { -1, 1 })
  {
    slope = std::max({ slope, std::abs(light(column + step, row) - light(column, row)),
      std::abs(light(column, row + step) - light(column, row)) });
  }
  return slope;
}

/// Data units on the pattern of Cutoff::Background that a pixel shows.
inline double pixelOnBackground(const Frame& frame, const Scene& scene)
{
  const double distance = scene.background.distance.value_or(frame.exit - frame.entry);
  return frame.pixelSize *
    (frame.pupil > 0 ? 1 + (distance + frame.focus - frame.entry) / frame.pupil : 1);
}

/// At a pixel. The path counts where no body covers the pixel's centre, whose path it is.
inline double trueErrorAt(
  const Image& image, const Image& truth, const Scene& scene, std::size_t pixel, bool isClear)
{
  double ofLight = 0;
  const auto look = [&](const PixelArray<float>& a, const PixelArray<float>& b, std::size_t at) {
    ofLight = std::max(ofLight, std::abs(static_cast<double>(a[at]) - static_cast<double>(b[at])));
  };
  if (image.color.empty())
  {
    look(image.intensity, truth.intensity, pixel);
  }
  for (std::size_t channel = 0; channel < 3 && !image.color.empty(); ++channel)
  {
    look(image.color, truth.color, 3 * pixel + channel);
  }
  if (scene.cutoff == Cutoff::Background)
  {
    const auto off = [&](std::size_t axis)
    {
      return static_cast<double>(image.backgroundDisplacement[2 * pixel + axis]) -
        static_cast<double>(truth.backgroundDisplacement[2 * pixel + axis]);
    };
    return std::hypot(off(0), off(1)) / pixelOnBackground(truth.frame, scene);
  }
  if (scene.cutoff == Cutoff::Interferogram)
  {
    const double ofPath =
      std::abs(image.opticalPathDifference[pixel] - truth.opticalPathDifference[pixel]);
    return std::max(ofLight / pi, isClear ? ofPath / scene.wavelength : 0);
  }
  if (scene.cutoff == Cutoff::Shadowgraph)
  {
    const int column = static_cast<int>(pixel) % truth.width;
    const int row = static_cast<int>(pixel) / truth.width;
    return std::max(0., ofLight - 0.05 * slopeAt(truth, column, row));
  }
  return ofLight;
}

/// What 99 % of the pixels whose light has crossed the data do not exceed; 0 where there are none.
inline double trueError(
  const Image& image, const Image& truth, const Scene& scene,
  const std::function<bool(std::size_t pixel)>& hasCrossed,
  const std::function<bool(std::size_t pixel)>& isClear = [](std::size_t) { return true; })
{
  std::vector<double> errors;
  for (std::size_t pixel = 0; pixel < truth.intensity.size(); ++pixel)
  {
    if (hasCrossed(pixel))
    {
      const double error = trueErrorAt(image, truth, scene, pixel, isClear(pixel));
      errors.push_back(std::isnan(error) ? std::numeric_limits<double>::infinity() : error);
    }
  }
  if (errors.empty())
  {
    return 0;
  }
  const auto rank = static_cast<std::size_t>(0.99 * static_cast<double>(errors.size()));
  std::nth_element(
    errors.begin(), errors.begin() + static_cast<std::ptrdiff_t>(rank), errors.end());
  return errors[rank];
}

} // namespace schlieren
