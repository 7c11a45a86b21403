// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Bench/StageSettings.h"
#include "Optics/AutomaticK.h"
#include "Optics/DeflectionHistogram.h"
#include "Rays/TracedPass.h"
#include "Rays/TracedRays.h"
#include "Schlieren.h"

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

namespace schlieren
{

/// Where the light of cached rays came from. What does not matter to it has its default.
struct LightKey
{
  bool isOfCamera = false;
  std::optional<double> distance;
  SourceShape shape = SourceShape::Point;
  double width = 0, length = 0; ///< of an extended source, as the next two
  double angle = 0;
  double film = 0;
  ExitFaces faces = noFaces;
  Aperture aperture; ///< of a camera, with what all of its passes are
  int passes = 0;

  auto tie() const
  {
    return std::tuple_cat(std::tie(isOfCamera, distance, shape, width, length, angle, film,
                            faces.refract, faces.ratio, passes),
      aperture.tie());
  }

  static LightKey of(const Scene& scene, const Frame& frame, double film, const ExitFaces& faces)
  {
    LightKey key;
    key.faces = faces;
    key.isOfCamera = schlieren::isOfCamera(scene.cutoff);
    key.aperture = apertureOf(scene, frame, faces);
    if (key.aperture.slope > 0)
    {
      key.passes = scene.samplesPerPixel;
      return key;
    }
    if (key.isOfCamera)
    {
      return key;
    }
    key.distance = frame.pupil > 0 ? std::nullopt : scene.source.distance;
    key.shape = scene.source.shape;
    if (key.shape != SourceShape::Point)
    {
      key.width = scene.source.width;
      key.film = film;
    }
    if (key.shape == SourceShape::Slit)
    {
      key.length = scene.source.length;
      key.angle = scene.knifeEdgeAngle;
    }
    return key;
  }
};

inline auto tieOf(const Frame& frame)
{
  return std::tie(frame.u, frame.v, frame.w, frame.origin, frame.pixelSize, frame.entry, frame.exit,
    frame.pupil, frame.focus);
}

/// What a view is of, apart from which medium.
struct ViewKey
{
  Frame frame;
  int width, height;
  KernelChoice kernel;
  LightKey light;
  std::int64_t changes; ///< of the medium's voxels

  auto tie() const
  {
    return std::tuple_cat(light.tie(), tieOf(frame),
      std::tie(width, height, kernel.path, kernel.integrator, kernel.interpolation, changes));
  }
};

/// What cached rays were traced with, the medium apart.
struct RaysKey
{
  ViewKey view;
  RaySettings settings;
  std::uint32_t seed;
  Device device;
  int points; ///< of a pixel, see pointsOfPixel()

  auto tie() const
  {
    return std::tuple_cat(view.tie(),
      std::tie(settings.stepVoxels, settings.adaptiveTolerance, settings.lengthScale, seed, device,
        points));
  }
};

/// Keeps the rays of a view, pass by pass, and what has been learnt from them, until others are wanted; also a pass whose
/// tracing is unfinished.
class RayCache
{
public:
  /// Drops what is cached where it is not that of `key`, or has less around the image than `margin`.
  /// Returns whether it was.
  bool prepare(const RaysKey& key, std::int64_t margin);
  std::int64_t margin() const { return margin_; } ///< of the rays that are cached
  /// Whether rays of this view are cached, whatever they were traced with.
  bool areOf(const Frame& frame, const View& view) const
  {
    return key_ && !passes_.empty() && tieOf(key_->view.frame) == tieOf(frame) &&
      key_->view.width == view.width && key_->view.height == view.height;
  }

  /// How far a view's light is moved, which is found where it is that of another one.
  const std::vector<MovedRay>& movedIn(
    const ViewKey& key, const std::function<std::vector<MovedRay>()>& find);

  /// Traces a pass, or resumes it. False if aborted or paused. `isWantedOnHost`: or else where it was traced.
  using Trace = std::function<bool(TracedPass& traced, bool isWantedOnHost)>;

  /// The rays of a pass, cached or traced now; null if aborted or paused.
  const TracedPass* raysOf(std::int64_t number, const Pass& pass, Device device,
    std::size_t memoryBudget, const Trace& trace);
  /// Whether these rays stay where they are when the next pass is requested.
  bool holds(const TracedPass& traced) const { return &traced != &scratch_; }

  /// Learns from the rays of a pass what has not been requested of them before: how strongly they are bent, for
  /// automatic k, and where they meet the cutoff plane.
  void request(const TracedPass& traced, const TracedRays& rays, std::int64_t number,
    const Scene& scene, const DeflectionErrors& errors);
  double strongDeflection() const { return *strong_; }
  Histogram histogram() const { return histogram_->histogram(); }

  /// Gives back the memory that only served to make more rays.
  void finish();
  /// All of it, for rays in another medium or on another device.
  void clear();

private:
  /// Makes scratch_ the place for the rays of a pass, where it is not that already.
  void prepareScratch(std::int64_t number, const Pass& pass, Device device);

  std::optional<std::pair<ViewKey, std::vector<MovedRay>>> moved_; ///< in the last view
  std::optional<RaysKey> key_;
  std::int64_t margin_ = 0;
  std::deque<TracedPass> passes_;                ///< from pass 0 on
  std::deque<TracedPass> spare_;                 ///< whose memory serves again
  TracedPass scratch_;                           ///< a pass that is being traced, or is not cached
  std::int64_t inScratch_ = -1;                  ///< its number; -1: no rays are there
  bool isScratchTraced_ = false;                 ///< all of it
  std::optional<double> strong_;                 ///< deflection, once automatic k has requested it
  std::optional<DeflectionHistogram> histogram_; ///< likewise
};

} // namespace schlieren
