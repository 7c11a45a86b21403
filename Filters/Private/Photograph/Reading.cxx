// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Photograph/Reading.h"

#include "PhotographSettings.h"

#include "vtkImageData.h"
#include "vtkMath.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace filters
{

namespace
{

using Settings = PhotographSettings;

constexpr float saturated = 0.985f; // brighter pixels of the photograph may have had more light

Point2 pairOf(const double (&values)[2]) { return { values[0], values[1] }; }

} // namespace

Place placeOf(const Grid& image, const Grid& photograph, const PhotographSettings& settings)
{
  const double aspect = settings.PixelAspect;
  if (settings.Placement == Settings::PLACE_TWO_POINTS)
  {
    return placeByPoints(pairOf(settings.PhotographPoint1), pairOf(settings.PhotographPoint2),
      pairOf(settings.FlowPoint1), pairOf(settings.FlowPoint2), aspect);
  }
  const double filling = image.rows * image.spacing[1] / (photograph.rows * photograph.spacing[1]);
  Place place{ photograph.middle(), image.middle(), filling, 0, aspect };
  if (settings.Placement == Settings::PLACE_BY_HAND ||
    settings.Placement == Settings::PLACE_ONE_POINT)
  {
    place.rotation = vtkMath::RadiansFromDegrees(settings.PhotographRotation);
    place.scale = settings.PhotographScale > 0 ? settings.PhotographScale : filling;
    place.position = pairOf(settings.PhotographPosition);
  }
  if (settings.Placement == Settings::PLACE_ONE_POINT)
  {
    place.anchor = pairOf(settings.PhotographPoint1);
    place.position = pairOf(settings.FlowPoint1);
  }
  return place;
}

Photograph readPhotograph(vtkImageData* photograph, vtkImageData* withoutFlow, int factor,
  const PhotographSettings& settings)
{
  Photograph result;
  const double white = whiteOf(photograph, withoutFlow);
  result.values = luminanceOf(photograph, white, factor, result.grid);
  if (withoutFlow)
  {
    Grid same;
    result.withoutFlow = luminanceOf(withoutFlow, white, factor, same);
    if (same.columns != result.grid.columns || same.rows != result.grid.rows)
    {
      throw std::runtime_error(
        "The photograph without flow has another number of pixels than the photograph. Take both "
        "with the same camera, and cut both alike.");
    }
  }
  result.used = Plane(result.grid.columns, result.grid.rows);
  std::vector<float> dark; // beyond the mirror and what its edge scatters
  for (int row = 0; row < result.grid.rows; ++row)
  {
    for (int column = 0; column < result.grid.columns; ++column)
    {
      const auto [x, y] = result.grid.at(column, row);
      const double distance =
        std::hypot(x - settings.MirrorCenter[0], y - settings.MirrorCenter[1]);
      const bool isInside = !(settings.MirrorRadius > 0) || distance < settings.MirrorRadius;
      result.used(column, row) = isInside && result.values(column, row) < saturated ? 1.f : 0.f;
      if (!isInside && distance > 1.1 * settings.MirrorRadius)
      {
        dark.push_back(result.values(column, row));
      }
    }
  }
  result.isBlackKnown = settings.BlackLevel >= 0 || dark.size() > 100;
  std::vector<float> all = result.values.values;
  result.black = settings.BlackLevel >= 0 ? settings.BlackLevel
    : result.isBlackKnown                 ? quantile(dark, 0.5)
                                          : std::clamp<double>(quantile(all, 0.001), 0, 0.19);
  return result;
}

Exposure exposureOf(
  const Photograph& photograph, const Place& place, const Grid& image, const Plane& open)
{
  const auto there = [&](const Plane& plane)
  { return plane.values.empty() ? Plane() : resampled(plane, photograph.grid, place, image); };
  Exposure exposure{ there(photograph.values), there(photograph.withoutFlow),
    there(photograph.used) };
  for (std::size_t i = 0; i < exposure.known.size(); ++i)
  {
    // Along a body's edge, light depends on where exactly the edge is.
    const bool isEdge = open.values[i] > 0 && open.values[i] < 1;
    exposure.known.values[i] = exposure.known.values[i] > 0.999f && !isEdge ? 1.f : 0.f;
  }
  return exposure;
}

std::vector<float> knownValues(const Plane& plane, const Plane& known)
{
  std::vector<float> values;
  for (std::size_t i = 0; i < plane.size(); ++i)
  {
    if (known.values[i] > 0 && std::isfinite(plane.values[i]))
    {
      values.push_back(plane.values[i]);
    }
  }
  return values;
}

} // namespace filters
