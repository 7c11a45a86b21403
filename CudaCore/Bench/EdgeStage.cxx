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

bool EdgeTiles::arePossible(const Scene& scene, const Light& light, double moved)
{
  constexpr double mostMoved = 2.5;
  return moved <= mostMoved && techniqueOf(scene.cutoff).plane == RecordedPlane::Focus &&
    !isOfCamera(scene.cutoff) && !(light.pupilTilt > 0) && scene.smoothingRadius <= 0;
}

PatchList EdgeTiles::in(const PixelArray<float>& blockedFraction, const View& view, double moved)
{
  constexpr std::int64_t edge = Patch::edge, longest = 16; // tiles
  const std::int64_t around = 1 + std::llround(moved);
  const std::int64_t columns = (view.width + edge - 1) / edge,
                     rows = (view.height + edge - 1) / edge;
  std::vector<bool> isWanted(static_cast<std::size_t>(columns * rows));
  const auto isEdgeIn = [&](std::int64_t left, std::int64_t low)
  {
    bool stopsSome = false, stopsAll = true;
    for (std::int64_t row = std::max<std::int64_t>(0, low - around);
         row < std::min<std::int64_t>(view.height, low + edge + around); ++row)
    {
      for (std::int64_t column = std::max<std::int64_t>(0, left - around);
           column < std::min<std::int64_t>(view.width, left + edge + around); ++column)
      {
        const float blocked = blockedFraction[static_cast<std::size_t>(row * view.width + column)];
        stopsSome = stopsSome || blocked > 0;
        stopsAll = stopsAll && blocked >= 1;
      }
    }
    return stopsSome && !stopsAll;
  };
  for (std::size_t n = 0; n < isWanted.size(); ++n)
  {
    const auto tile = static_cast<std::int64_t>(n);
    isWanted[n] = isEdgeIn(tile % columns * edge, tile / columns * edge);
  }
  PatchList tiles;
  for (std::int64_t row = 0; row < rows; ++row)
  {
    for (std::int64_t column = 0; column < columns; ++column)
    {
      const auto countFrom = [&](std::int64_t right, std::int64_t up)
      {
        std::int64_t count = 0;
        for (std::int64_t i = column, j = row; i < columns && j < rows && count < longest &&
             isWanted[static_cast<std::size_t>(j * columns + i)];
             i += right, j += up)
        {
          ++count;
        }
        return count;
      };
      const std::int64_t along = countFrom(1, 0), upwards = countFrom(0, 1);
      if (along == 0)
      {
        continue;
      }
      const std::int64_t wide = along >= upwards ? along : 1, high = along >= upwards ? 1 : upwards;
      for (std::int64_t n = 0; n < wide * high; ++n)
      {
        isWanted[static_cast<std::size_t>((row + n / wide) * columns + column + n % wide)] = false;
      }
      const std::int64_t left = column * edge, low = row * edge;
      tiles.push_back({ left, low, 1, left, low, marginFor(moved),
        std::min(wide * edge, view.width - left), std::min(high * edge, view.height - low) });
    }
  }
  return tiles;
}

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
  rays_.prepare(key, scene_.samplesAtEdges, edges.tiles);
  while (edges.images.size() < edges.tiles.size())
  {
    const std::size_t first = edges.images.size(), end = endOfChunk(first);
    const TracedPass* traced = raysOf(edges.chunks, first, end);
    if (traced == nullptr || watch_.isAborted())
    {
      return false;
    }
    request_.momentumDrift = std::max(request_.momentumDrift, traced->worstDrift);
    expose(*traced, first, end);
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
    aimPass(passes.back(), number, scene_, view_.light);
  }
  return passes;
}

template <class Real>
std::int64_t EdgeStage<Real>::raysOf(const Patch& tile) const
{
  return scene_.samplesAtEdges * (tile.columns + 2 * tile.margin) * (tile.rows + 2 * tile.margin);
}

template <class Real>
std::size_t EdgeStage<Real>::endOfChunk(std::size_t first) const
{
  constexpr std::int64_t raysAtOnce = std::int64_t{ 1 } << 20;
  const PatchList& tiles = request_.edges->tiles;
  std::size_t end = first;
  for (std::int64_t rays = 0; end < tiles.size() && rays < raysAtOnce; ++end)
  {
    rays += raysOf(tiles[end]);
  }
  return end;
}

template <class Real>
const TracedPass* EdgeStage<Real>::raysOf(std::size_t chunk, std::size_t first, std::size_t end)
{
  if (chunk < rays_.chunks_.size())
  {
    return &rays_.chunks_[chunk];
  }
  const PatchList& tiles = request_.edges->tiles;
  std::vector<Pass> all;
  for (std::size_t n = first; n < end; ++n)
  {
    for (Pass& pass : passesOf(tiles[n]))
    {
      pass.firstColumn += tiles[n].column;
      pass.firstRow += tiles[n].row;
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
void EdgeStage<Real>::expose(const TracedPass& traced, std::size_t first, std::size_t end)
{
  UnfinishedImage::Edges& edges = *request_.edges;
  std::vector<const RayExit*> exits{ traced.exits.data() }; // of each tile
  for (std::size_t n = first; n < end; ++n)
  {
    exits.push_back(exits.back() + raysOf(edges.tiles[n]));
  }
  edges.images.resize(end);
  parallelFor(static_cast<std::int64_t>(end - first), 1, scene_.threads,
    [&](std::int64_t from, std::int64_t to)
    {
      for (auto n = static_cast<std::size_t>(from); n < static_cast<std::size_t>(to); ++n)
      {
        const Patch& tile = edges.tiles[first + n];
        PatchFilm film(
          tile, scene_, request_.image->cutoff(), view_.projection, scene_.samplesAtEdges, 1);
        const RayExit* ray = exits[n];
        std::deque<TracedPass> all; // until the image is there
        for (const Pass& pass : passesOf(tile))
        {
          RayExits& ofPass = all.emplace_back().exits;
          ofPass.assign(ray, ray + pass.columns * pass.rows);
          ray += ofPass.size();
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
