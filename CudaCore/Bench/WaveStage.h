// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Replaces the light of a finished image by that of waves, where its scene wants these. Waves take one ray for each pixel, of
// the middle of the light source, and rays around the image; so they have passes of their own.
#pragma once

#include "Bench/RayCache.h"
#include "Bench/UnfinishedImage.h"
#include "Bench/ViewSetup.h"
#include "Bench/Watch.h"
#include "Schlieren.h"
#include "Waves/LightAtExit.h"
#include "Waves/ScreenWaves.h"

#include <cstdint>
#include <string>
#include <vector>

namespace schlieren
{

template <class Real>
class WaveStage
{
public:
  /// All stay with their owner.
  WaveStage(const ViewSetup<Real>& ofView, const UnfinishedImage& request, const Watch& watch,
    RayCache& rays, Work& work)
    : view_(ofView)
    , frame_(ofView.key.frame)
    , faces_(ofView.light.faces)
    , request_(request)
    , watch_(watch)
    , rays_(rays)
    , work_(work)
  {
  }

  /// Does nothing to an image of rays. False if aborted. Throws Error.
  bool run(Image& image);

private:
  /// Whether waves are to be made. Throws Error where they cannot.
  bool areWanted() const;
  Screen screenOf(const Image& image) const;
  /// What can abort waves, which cannot pause.
  Monitor withoutPauses() const;
  /// Pixels to trace around an image.
  std::int64_t borderOf(const Image& image, const Screen& screen) const;
  /// Traces the rays, and finds the slopes of a point source. False if aborted.
  bool trace(Image& image, Screen& screen, LightAtExit& light);
  const TracedPass* tracePass(
    std::int64_t number, const Pass& pass, const RayTask<Real>& task, Image& image);

  /// Empty if aborted.
  std::vector<float> makeLight(
    const LightAtExit& light, const Screen& screen, const Monitor& monitor, Image& image) const;

  const ViewSetup<Real>& view_;
  const Frame& frame_;
  const ExitFaces& faces_;
  const UnfinishedImage& request_;
  const Watch& watch_;
  RayCache& rays_;
  Work& work_;
};

} // namespace schlieren
