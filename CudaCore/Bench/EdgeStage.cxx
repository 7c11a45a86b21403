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
void pastePixels(
  const PixelArray<T>& from, const Patch& tile, std::int64_t width, PixelArray<T>& to)
{
  const std::size_t pixels = static_cast<std::size_t>(tile.columns * tile.rows);
  const auto perPixel = static_cast<std::int64_t>(from.size() / pixels);
  for (std::int64_t row = 0; row < tile.rows; ++row)
  {
    std::copy_n(from.data() + perPixel * row * tile.columns, perPixel * tile.columns,
      to.data() + perPixel * ((tile.row + row) * width + tile.column));
  }
}

} // namespace

void EdgeRays::prepare(const RaysKey& key, int samples, const PatchList& tiles)
{
  const auto isSame = [](const Patch& a, const Patch& b)
  { return a.column == b.column && a.row == b.row; };
  if (!key_ || key_->tie() != key.tie() || samples_ != samples ||
    !std::equal(tiles_.begin(), tiles_.end(), tiles.begin(), tiles.end(), isSame))
  {
    clear();
    key_ = key;
    samples_ = samples;
    tiles_ = tiles;
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
    request_.edges->tiles =
      EdgeTiles::in(request_.image->blockedFraction(), scene_.view, view_.movedInFocus);
  }
  UnfinishedImage::Edges& edges = *request_.edges;
  RaysKey ofEdges = key;
  ofEdges.points = pointsOfPixel(scene_.samplesAtEdges, scene_, view_.light);
  rays_.prepare(ofEdges, scene_.samplesAtEdges, edges.tiles);
  while (edges.images.size() < edges.tiles.size())
  {
    const std::size_t first = edges.images.size(), end = endOfChunk(first);
    const auto tiles = edges.tiles.cbegin();
    const RaysOfTiles rays(tiles + static_cast<std::ptrdiff_t>(first),
      tiles + static_cast<std::ptrdiff_t>(end), scene_.samplesAtEdges);
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
    rays +=
      scene_.samplesAtEdges * (tile.columns + 2 * tile.margin) * (tile.rows + 2 * tile.margin);
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
              ofPass.push_back(
                traced.exits[rays.ray(tile.column + column, tile.row + row, number)]);
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
    { pastePixels(ofTile.*PixelsOfImage, tile, image.width, image.*PixelsOfImage); };
    paste(&Image::intensity);
    paste(&Image::color);
    paste(&Image::deflection);
    paste(&Image::opticalPathDifference);
    paste(&Image::displacement);
    paste(&Image::blockedFraction);
    image.raysTraced += ofTile.raysTraced;
    image.stepsTaken += ofTile.stepsTaken;
    image.raysBlocked += ofTile.raysBlocked;
    image.raysLost += ofTile.raysLost;
  }
}

template class EdgeStage<float>;
template class EdgeStage<double>;

} // namespace schlieren
