// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Film/PixelArray.h"
#include "Types.h"

#include <cstdint>
#include <limits>
#include <string>

namespace schlieren
{

/// What contributes most to an image's error.
enum class ErrorSource
{
  None,
  Steps,        ///< Scene::stepSize
  RaysPerPixel, ///< Scene::samplesPerPixel
  Voxels,       ///< Scene::mediumTolerance: of meshes
  Rounding      ///< Scene::precision
};

/// The error of an image, found from patches of its pixels: see Scene::targetError.
struct Accuracy
{
  double target = 0;  ///< 0: none was requested, and nothing else is known
  double reached = 0; ///< of 99 % of the pixels whose light has crossed the data
  double largest = 0; ///< of the pixels that were looked at
  ErrorSource limit = ErrorSource::None;
  bool isKept() const { return reached <= target; }
};

/// The image and what is known about it. Arrays are row-major, bottom row first.
struct Image
{
  int width = 0;
  int height = 0;
  Frame frame;

  PixelArray<float> intensity;  ///< per pixel; undisturbed: see Cutoff; luminance of a colour
  PixelArray<float> color;      ///< 3 per pixel, linear; empty where nothing colours
  PixelArray<float> background; ///< per pixel, of Cutoff::Background: the same without the flow
  /// 2 per pixel, data units, likewise: the place of the pattern that is seen, less the one seen without the
  /// flow. What is seen has moved in the opposite direction.
  PixelArray<float> backgroundDisplacement;
  double patternPixel = 0; ///< data units, likewise: the side of a pixel where the pattern is
  /// 2 per pixel: direction cosines along u and v, in what light leaves the data into. This and the next two are those of
  /// the ray through the pixel's centre, from the middle of the light source; where that ends in a solid, the mean of
  /// the pixel's rays that do not.
  PixelArray<float> deflection;
  /// Per pixel, metres, against undisturbed light; on the same plane as displacement.
  PixelArray<double> opticalPathDifference;
  /// 2 per pixel: at the exit plane, data units; with a perspective, and of Cutoff::Background, where rays go from the
  /// camera on, at the entry plane.
  PixelArray<float> displacement;
  PixelArray<float> blockedFraction; ///< per pixel: fraction of rays that a solid stopped

  Device device = Device::Cpu; ///< where the rays were traced
  int threads = 0;             ///< on the CPU
  int processes = 1;           ///< that traced rays
  std::string deviceNote;      ///< why Device::Auto left a device that answers; else empty
  PathModel pathModel = PathModel::Refracted;   ///< the one used
  Integrator integrator = Integrator::Leapfrog; ///< the one used
  double kScale = 0;                            ///< the k used; 0 where there is no cutoff
  double screenDistance = 0;                    ///< of a shadowgraph, the one used, data units
  double undisturbedLevel = 1;                  ///< intensity of light that nothing bends
  /// Fraction of the rays that start in the image and reach the film: cut off at the darkest or brightest light.
  double saturatedFraction = 0;
  LightBalance light;
  Histogram histogram;
  double ambient = 0;           ///< the ambient refractivity used
  double exitRefractivity = 0;  ///< of what light leaves the data into
  std::int64_t raysTraced = 0;  ///< rays of this image that crossed the grid
  std::int64_t stepsTaken = 0;  ///< integration steps of these rays
  std::int64_t raysBlocked = 0; ///< rays that a solid stopped
  std::int64_t raysLost = 0;    ///< rays trapped in the medium (step limit) or turned back by it
  double traceSeconds = 0;      ///< spent tracing for it; 0 when cached rays were re-shaded
  /// Worst | |p| / n - 1 | of refracted rays where they leave the grid: 0 for exact ones, so that it shows
  /// the error of steps and interpolation.
  double momentumDrift = 0;
  double steepestChange = 0; ///< of the index, by that of the surroundings, over one voxel
  Vector steepestPlace{};    ///< about where that is, data units
  MediumStatistics medium;   ///< of a Field's source
  Accuracy accuracy;
  LightModel lightModel = LightModel::Rays; ///< the one used
  WaveReport waves;                         ///< but of LightModel::Rays
  std::string lightNote;                    ///< of waves in focus: what rays suffice for
  bool aborted = false;                     ///< the monitor stopped it; all arrays are empty

  /// False where the monitor has paused it, and Bench::resume continues it. The arrays then hold the image of
  /// the samples so far (the histogram may know of more), or are empty where this call has completed none.
  bool finished = true;
  int samples = 0;         ///< per pixel, that the image is of
  int samplesPerPixel = 0; ///< that the finished image is of
  int samplesAtEdges = 0;  ///< likewise, where bodies' edges are; 0: as many as elsewhere
  double stepSize = 0;     ///< voxels
};

} // namespace schlieren
