// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// What waves make of an image whose light passes the plane where undisturbed light of each point of the source is a point
// (Fourier plane): of a mask there, and of another wave in the image's plane. Waves of different points of the source do not
// interfere: their images are added (Abbe).
#pragma once

#include "Waves/ScreenWaves.h"
#include "Waves/WavePixels.h"

#include <array>
#include <complex>
#include <functional>
#include <optional>
#include <vector>

namespace schlieren
{

/// Places in the Fourier plane by the focal length, along u and v: radians.
using Angles = std::array<double, 2>;

/// By what the amplitude of light is multiplied that meets the plane in a cell as large as `cell` around `place`: the mean over
/// it. A cell without a size is undisturbed light, which is a point.
using Mask = std::function<std::complex<double>(const Angles& place, const Angles& cell)>;

/// A straight edge. Light passes that is bent along `degrees`, from u to v, by more than `place`.
Mask edgeMask(double degrees, double place);
/// A disc, and what is around it. Where its diameter is 0 only undisturbed light meets it, wherever that is.
Mask discMask(double diameter, std::complex<double> disc, std::complex<double> around);
/// A filter that lets a fraction of the light pass, and does not delay it.
Mask filterMask(std::function<double(const Angles& place)> transmission);

/// A point of the source, and its part of the source's light.
struct SourcePoint
{
  Angles place{ 0, 0 };
  double light = 1;
};

/// What makes an image of a plane in focus. All of the light of `points` is 1.
struct Imaging
{
  Mask mask{}; ///< none: all light passes
  std::vector<SourcePoint> points{ {} };
  /// The phase, in turns, by which undisturbed light is ahead of a reference beam of as much light: the image is then that of
  /// both, less by a factor of 4. Columns and rows are the image's pixels.
  std::optional<EvenPhase> reference{};
};

/// The light of pixels that nothing disturbs, without a reference beam and a tilt of all light.
double undisturbedLight(const Imaging& imaging);

/// The light of each pixel, by undisturbed light without a mask: see fieldBefore. The distance of `screen` is that of the plane
/// in focus. Empty if aborted.
std::vector<float> lightInFocus(const LightAtExit& light, const Screen& screen,
  const Imaging& imaging, const Monitor& monitor, WaveReport& report);

} // namespace schlieren
