// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// More rays where edges of bodies are: light changes from one side of an edge to the other at once, which takes more rays per
// pixel than gas does.
#pragma once

#include "Bench/EdgeTiles.h"
#include "Bench/RayCache.h"
#include "Bench/UnfinishedImage.h"
#include "Bench/ViewSetup.h"
#include "Bench/Watch.h"
#include "Schlieren.h"

#include <cstddef>
#include <deque>
#include <optional>
#include <vector>

namespace schlieren
{

/// The rays of edges, which are cached until others are wanted.
class EdgeRays
{
public:
  /// Drops what is cached where it is not of these.
  void prepare(const RaysKey& key, int samples, const EdgePixels& pixels);
  void clear() { *this = {}; }

private:
  template <class Real>
  friend class EdgeStage;

  std::optional<RaysKey> key_;
  int samples_ = 0;
  EdgePixels pixels_;
  std::deque<TracedPass> chunks_; ///< of consecutive tiles
  TracedPass scratch_;            ///< the next one, which a pause may have interrupted
};

/// Traces Scene::samplesAtEdges rays per pixel where edges light an image that has all of its passes, and replaces these pixels.
template <class Real>
class EdgeStage
{
public:
  /// All stay with their owner.
  EdgeStage(const ViewSetup<Real>& view, UnfinishedImage& request, const Watch& watch,
    EdgeRays& rays, Work& work);

  /// False if aborted or paused before all are traced.
  bool trace(const RaysKey& key);
  /// Writes their pixels into the finished image.
  void paste(Image& image) const;

private:
  /// By the rays that the image has.
  EdgePixels findPixels() const;
  std::vector<Pass> passesOf(const Patch& tile) const;
  /// The end of those that are traced at once from a tile on.
  std::size_t endOfChunk(std::size_t first) const;
  /// The rays of some tiles, cached or traced now; null if aborted or paused.
  const TracedPass* trace(
    const RaysOfTiles& rays, std::size_t chunk, std::size_t first, std::size_t end);
  Monitor monitorOf(std::size_t first, std::size_t end) const;
  void expose(
    const TracedPass& traced, const RaysOfTiles& rays, std::size_t first, std::size_t end);

  const ViewSetup<Real>& view_;
  UnfinishedImage& request_;
  const Watch& watch_;
  EdgeRays& rays_;
  Work& work_;
  Scene scene_; ///< with the rays of edges
};

} // namespace schlieren
