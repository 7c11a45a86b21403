// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Film/Image.h"
#include "Rays/TracedRays.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace schlieren
{

/// What the first of a pixel's rays carries, which starts in the pixel's centre. Where
/// that does not reach the film, or all are wanted, the sums over those that do.
struct PixelRays
{
  double deflection[2]{ 0, 0 };
  double displacement[2]{ 0, 0 };
  double opticalPathDifference = 0;
  std::int32_t summed = 0;    ///< rays
  std::int32_t hasCentre = 0; ///< 1: all of this is the first ray's
  std::int32_t blocked = 0;
  std::int32_t rays = 0;

  SCHLIEREN_HD void add(const RayExit& exit, bool areAllWanted)
  {
    const bool isFirst = rays == 0 && !areAllWanted;
    ++rays;
    blocked += exit.fate == RayFate::Blocked ? 1 : 0;
    if (exit.reachesFilm() && hasCentre == 0)
    {
      hasCentre = isFirst ? 1 : 0;
      ++summed;
      for (int axis = 0; axis < 2; ++axis)
      {
        deflection[axis] += exit.deflection[axis];
        displacement[axis] += static_cast<double>(exit.displacement[axis]);
      }
      opticalPathDifference += exit.opticalPathDifference;
    }
  }
};

/// Where an image holds what its light carries, row by row: in the memory of the host or of the device.
struct CentreArrays
{
  float* deflection;             ///< 2 per pixel
  float* displacement;           ///< 2 per pixel
  double* opticalPathDifference; ///< metres
  float* blockedFraction;

  SCHLIEREN_HD void set(std::int64_t pixel, const PixelRays& rays) const
  {
    // A division takes as long as all the rest, and most pixels need none.
    const double perRay = rays.summed > 1 ? 1. / rays.summed : 1;
    for (int axis = 0; axis < 2; ++axis)
    {
      deflection[2 * pixel + axis] = static_cast<float>(rays.deflection[axis] * perRay);
      displacement[2 * pixel + axis] = static_cast<float>(rays.displacement[axis] * perRay);
    }
    opticalPathDifference[pixel] =
      rays.summed > 1 ? rays.opticalPathDifference / rays.summed : rays.opticalPathDifference;
    blockedFraction[pixel] =
      rays.blocked > 0 ? static_cast<float>(rays.blocked) / static_cast<float>(rays.rays) : 0;
  }
};

/// Makes room for these arrays in an image.
CentreArrays centreArraysOf(Image& image, std::size_t pixels);

/// What light carries at the pixels' centres. A mean over all rays of a pixel would belong to another place: the mean
/// place of a few samples is not the centre. Only where the centre is dark is it the mean over the rays beside it; and where
/// each ray comes through another place of a camera's aperture.
/// Each pixel is summed in the order of the passes, so that no result depends on the number of threads, or on which
/// passes come at once.
class CentreValues
{
public:
  CentreValues(int width, int height, int threads)
    : width_(width)
    , height_(height)
    , threads_(threads)
  {
  }

  /// Makes all values means over their pixels' rays.
  void wantAll() { areAllWanted_ = true; }

  /// Adds passes that more will follow. The first of all starts in the centres.
  void add(const std::vector<TracedRays>& passes);

  /// Adds the last passes and writes the values into the image. Pixels from which no ray reaches the film hold 0.
  void develop(const std::vector<TracedRays>& last, Image& image) const;

private:
  /// Calls use(pixel, its rays) with what is known and these passes.
  template <class Use>
  void forEachPixel(const std::vector<TracedRays>& passes, const Use& use) const;

  std::int64_t width_;
  std::int64_t height_;
  int threads_;
  bool areAllWanted_ = false;
  std::vector<PixelRays> pixels_; ///< of what has been added; most often nothing
};

} // namespace schlieren
