// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// What waves make of a straight edge in the plane where undisturbed light of each point of the source is a point (Fourier
// plane): the sum of the images of the source's points, whose waves do not interfere (Abbe).
#pragma once

#include "Waves/ScreenWaves.h"

#include <vector>

namespace schlieren
{

/// A straight edge and the source's image there, as angles: places by the focal length.
struct Edge
{
  double angle = 0;     ///< degrees, from u to v: light that is bent so passes
  double place = 0;     ///< from the middle of the source's image along `angle`, radians
  double source = 0;    ///< width of the source's image along `angle`, radians
  int points = 32;      ///< of the source
  bool isOther = false; ///< the edge is on the other side
};

/// The fraction of its light that each pixel receives, by undisturbed light without an edge: see fieldBefore. The distance of
/// `screen` is that of the plane in focus. Empty if aborted.
std::vector<float> lightBehindEdge(const LightAtExit& light, const Screen& screen, const Edge& edge,
  const Monitor& monitor, WaveReport& report);

} // namespace schlieren
