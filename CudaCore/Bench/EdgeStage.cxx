// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Bench/EdgeStage.h"

#include "Bench/PatchFilm.h"
#include "Bench/StageSettings.h"
#include "Device/Parallel.h"

#include <algorithm>
#include <chrono>
#include <utility>

namespace schlieren
{

namespace
{

template <class T>
void pastePixels(const PixelArray<T>& from, const Patch& tile, const EdgePixels& pixels,
  std::int64_t width, PixelArray<T>& to)
{
  const auto perPixel = static_cast<std::int64_t>(from.size()) / (tile.columns * tile.rows);
  for (std::int64_t n = 0; n < tile.columns * tile.rows; ++n)
  {
    const std::int64_t column = tile.column + n % tile.columns, row = tile.row + n / tile.columns;
    if (pixels.isLit(column, row))
    {
      std::copy_n(
        from.data() + perPixel * n, perPixel, to.data() + perPixel * (row * width + column));
    }
  }
}

} // namespace

void EdgeRays::prepare(const RaysKey& key, int samples, const EdgePixels& pixels)
{
  if (!key_ || key_->tie() != key.tie() || samples_ != samples || !(pixels_ == pixels))
  {
    clear();
    key_ = key;
    samples_ = samples;
    pixels_ = pixels;
  }
}

template <class Real>
EdgeStage<Real>::EdgeStage(const ViewSetup<Real>& view, UnfinishedImage& request,
  const Watch& watch, EdgeRays& rays, Work& work)
  : view_(view)
  , request_(request)
  , watch_(watch)
  , rays_(rays)
  , work_(work)
  , scene_(request.scene)
{
  if (!EdgeTiles::arePossible(scene_, view.light, view.movedInFocus))
  {
    scene_.samplesAtEdges = 0;
  }
  scene_.samplesPerPixel = scene_.samplesAtEdges;
}

template <class Real>
bool EdgeStage<Real>::trace(const RaysKey& key)
{
  if (scene_.samplesAtEdges == 0)
  {
    return true;
  }
  if (!request_.edges)
  {
    request_.edges.emplace();
    request_.edges->pixels = findPixels();
    request_.edges->tiles = EdgeTiles::in(request_.edges->pixels, scene_.view, view_.movedInFocus);
  }
  UnfinishedImage::Edges& edges = *request_.edges;
  RaysKey ofEdges = key;
  ofEdges.points = pointsOfPixel(scene_.samplesAtEdges, scene_, view_.light);
  rays_.prepare(ofEdges, scene_.samplesAtEdges, edges.pixels);
  while (edges.images.size() < edges.tiles.size())
  {
    const std::size_t first = edges.images.size(), end = endOfChunk(first);
    const auto tiles = edges.tiles.cbegin();
    const RaysOfTiles rays(tiles + static_cast<std::ptrdiff_t>(first),
      tiles + static_cast<std::ptrdiff_t>(end), edges.pixels, scene_.samplesAtEdges);
    const TracedPass* traced = trace(rays, edges.chunks, first, end);
    if (traced == nullptr || watch_.isAborted())
    {
      return false;
    }
    request_.momentumDrift = std::max(request_.momentumDrift, traced->worstDrift);
    expose(*traced, rays, first, end);
    ++edges.chunks;
  }
  if (watch_.monitor().progress)
  {
    watch_.monitor().progress(request_.progressOfRays(1, true));
  }
  return true;
}

template <class Real>
EdgePixels EdgeStage<Real>::findPixels() const
{
  const Image image = request_.image->centres();
  const std::int64_t around = EdgeTiles::marginFor(view_.movedInFocus);
  std::vector<RaysOfPixel> rays;
  for (std::int64_t j = -around; j < image.height + around; ++j)
  {
    for (std::int64_t i = -around; i < image.width + around; ++i)
    {
      // What is outside of the image is as its border.
      const auto row = std::clamp<std::int64_t>(j, 0, image.height - 1);
      const auto column = std::clamp<std::int64_t>(i, 0, image.width - 1);
      const auto n = static_cast<std::size_t>(row * image.width + column);
      const double deflection[2] = { image.deflection[2 * n], image.deflection[2 * n + 1] };
      const float displacement[2] = { image.displacement[2 * n], image.displacement[2 * n + 1] };
      const FilmShift shift = shiftOnFilm(deflection, displacement, static_cast<double>(column),
        static_cast<double>(row), Pass{}.tilt, view_.projection);
      rays.push_back({ image.blockedFraction[n],
        { view_.projection.perDataUnit * shift.moved[0],
          view_.projection.perDataUnit * shift.moved[1] } });
    }
  }
  return { rays, image.width, around };
}

template <class Real>
std::vector<Pass> EdgeStage<Real>::passesOf(const Patch& tile) const
{
  std::vector<Pass> passes;
  for (int number = 0; number < scene_.samplesAtEdges; ++number)
  {
    passes.push_back({ -tile.margin, -tile.margin, tile.columns + 2 * tile.margin,
      tile.rows + 2 * tile.margin, { 0, 0 } });
    aimPass(passes.back(), number, scene_.samplesAtEdges, scene_, view_.light);
  }
  return passes;
}

template <class Real>
std::size_t EdgeStage<Real>::endOfChunk(std::size_t first) const
{
  constexpr std::int64_t raysAtOnce = std::int64_t{ 1 } << 20;
  const PatchList& tiles = request_.edges->tiles;
  std::size_t end = first;
  for (std::int64_t rays = 0; end < tiles.size() && rays < raysAtOnce; ++end)
  {
    const Patch& tile = tiles[end];
    for (std::int64_t n = 0; n < tile.columns * tile.rows; ++n)
    {
      const bool hasRays =
        request_.edges->pixels.hasRays(tile.column + n % tile.columns, tile.row + n / tile.columns);
      rays += hasRays ? scene_.samplesAtEdges : 0;
    }
  }
  return end;
}

template <class Real>
const TracedPass* EdgeStage<Real>::trace(
  const RaysOfTiles& rays, std::size_t chunk, std::size_t first, std::size_t end)
{
  if (chunk < rays_.chunks_.size())
  {
    return &rays_.chunks_[chunk];
  }
  std::vector<Pass> all;
  for (const Patch& rectangle : rays.rectangles())
  {
    for (Pass& pass : passesOf(rectangle))
    {
      pass.firstColumn += rectangle.column;
      pass.firstRow += rectangle.row;
      all.push_back(pass);
    }
  }
  const Passes passes(all);
  TracedPass& traced = rays_.scratch_;
  if (traced.tilesDone == 0)
  {
    traced.resize(passes);
  }
  const auto start = std::chrono::steady_clock::now();
  const bool isTraced = view_.tracer.trace(view_.task, passes, traced, monitorOf(first, end));
  request_.traceSeconds +=
    std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (!isTraced)
  {
    return nullptr;
  }
  work_.raysTraced += traced.crossed;
  if (chunk == rays_.chunks_.size() && (chunk + 1) * traced.bytes() <= scene_.memoryBudget)
  {
    rays_.chunks_.push_back(std::move(traced));
    traced = {};
    return &rays_.chunks_.back();
  }
  return &traced;
}

template <class Real>
Monitor EdgeStage<Real>::monitorOf(std::size_t first, std::size_t end) const
{
  Monitor monitor = watch_.monitor();
  if (monitor.progress)
  {
    monitor.progress = [this, first, end](double fraction)
    {
      const double done = static_cast<double>(first) + fraction * static_cast<double>(end - first);
      watch_.monitor().progress(
        request_.progressOfRays(done / static_cast<double>(request_.edges->tiles.size()), true));
    };
  }
  return monitor;
}

template <class Real>
void EdgeStage<Real>::expose(
  const TracedPass& traced, const RaysOfTiles& rays, std::size_t first, std::size_t end)
{
  UnfinishedImage::Edges& edges = *request_.edges;
  for (const RayExit& exit : traced.exits)
  {
    edges.counts.add(exit);
  }
  constexpr RayExit none{ { 0, 0 }, { 0, 0 }, 0, RayFate::Turned, 0 }; // lights nothing
  edges.images.resize(end);
  parallelFor(static_cast<std::int64_t>(end - first), 1, scene_.threads,
    [&](std::int64_t from, std::int64_t to)
    {
      for (auto n = static_cast<std::size_t>(from); n < static_cast<std::size_t>(to); ++n)
      {
        const Patch& tile = edges.tiles[first + n];
        PatchFilm film(
          tile, scene_, request_.image->cutoff(), view_.projection, scene_.samplesAtEdges, 1);
        std::deque<TracedPass> all; // until the image is there
        for (const Pass& pass : passesOf(tile))
        {
          RayExits& ofPass = all.emplace_back().exits;
          const auto number = static_cast<int>(all.size()) - 1;
          for (std::int64_t row = pass.firstRow; row < pass.firstRow + pass.rows; ++row)
          {
            for (std::int64_t column = pass.firstColumn; column < pass.firstColumn + pass.columns;
                 ++column)
            {
              const auto ray = rays.ray(tile.column + column, tile.row + row, number);
              ofPass.push_back(ray ? traced.exits[*ray] : none);
            }
          }
          film.add(all.back(), pass);
        }
        edges.images[first + n] = film.image();
      }
    });
}

template <class Real>
void EdgeStage<Real>::paste(Image& image) const
{
  image.samplesAtEdges = scene_.samplesAtEdges;
  const std::size_t tiles = request_.edges ? request_.edges->tiles.size() : 0;
  for (std::size_t n = 0; n < tiles; ++n)
  {
    const Patch& tile = request_.edges->tiles[n];
    const Image& ofTile = request_.edges->images[n];
    const auto paste = [&](auto PixelsOfImage)
    {
      pastePixels(
        ofTile.*PixelsOfImage, tile, request_.edges->pixels, image.width, image.*PixelsOfImage);
    };
    paste(&Image::intensity);
    paste(&Image::color);
    paste(&Image::deflection);
    paste(&Image::opticalPathDifference);
    paste(&Image::displacement);
    paste(&Image::blockedFraction);
  }
  const RayCounts counts = request_.edges ? request_.edges->counts : RayCounts{};
  image.raysTraced += counts.crossed;
  image.stepsTaken += counts.steps;
  image.raysBlocked += counts.blocked;
  image.raysLost += counts.lost;
}

template class EdgeStage<float>;
template class EdgeStage<double>;

} // namespace schlieren
