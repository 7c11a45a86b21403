// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Bench/RayCache.h"

#include "Bench/CutoffMaker.h"

#include <utility>
#include <vector>

namespace schlieren
{

bool RayCache::prepare(const RaysKey& key, std::int64_t margin)
{
  if (key_ && key_->tie() == key.tie() && margin_ >= margin)
  {
    return false;
  }
  spare_ = std::move(passes_);
  passes_.clear();
  inScratch_ = -1;
  strong_.reset();
  histogram_.reset();
  key_ = key;
  margin_ = margin;
  return true;
}

const std::vector<MovedRay>& RayCache::movedIn(
  const ViewKey& key, const std::function<std::vector<MovedRay>()>& find)
{
  if (!moved_ || moved_->first.tie() != key.tie())
  {
    moved_.emplace(key, find());
  }
  return moved_->second;
}

void RayCache::prepareScratch(std::int64_t number, const Pass& pass, Device device)
{
  const auto rays = static_cast<std::size_t>(pass.columns * pass.rows);
  if (inScratch_ == number)
  {
    return;
  }
  if (scratch_.bytes() == 0 && !spare_.empty())
  {
    scratch_ = std::move(spare_.back());
    spare_.pop_back();
  }
  const std::size_t room =
    scratch_.onDevice ? scratch_.onDevice->size() : scratch_.exits.capacity();
  if (room < rays || room / 2 > rays)
  {
    spare_.clear(); // first: two sets of rays at once might not fit
    scratch_ = {};
  }
  if (device == Device::Cpu)
  {
    scratch_.resize(pass);
  }
  inScratch_ = number;
  isScratchTraced_ = false;
}

const TracedPass* RayCache::raysOf(std::int64_t number, const Pass& pass, Device device,
  std::size_t memoryBudget, const Trace& trace)
{
  const auto index = static_cast<std::size_t>(number);
  if (index < passes_.size())
  {
    return &passes_[index];
  }
  prepareScratch(number, pass, device);
  if (!isScratchTraced_)
  {
    // All passes of an image in one place.
    const bool isWantedOnHost = !passes_.empty() && !passes_.front().onDevice;
    isScratchTraced_ = trace(scratch_, isWantedOnHost);
  }
  if (!isScratchTraced_)
  {
    return nullptr;
  }
  if (index == passes_.size() && (passes_.size() + 1) * scratch_.bytes() <= memoryBudget &&
    (!scratch_.onDevice || canKeepOnCuda(scratch_.bytes())))
  {
    passes_.push_back(std::move(scratch_));
    scratch_ = {};
    inScratch_ = -1;
    return &passes_.back();
  }
  return &scratch_;
}

void RayCache::request(const TracedPass& traced, const TracedRays& rays, std::int64_t number,
  const Scene& scene, const DeflectionErrors& errors)
{
  if (number == 0 && scene.histogramSize > 0 &&
    (!histogram_ || histogram_->size() != scene.histogramSize ||
      histogram_->passes() > scene.samplesPerPixel))
  {
    histogram_.emplace(scene.histogramSize);
  }
  const bool isKWanted =
    number == 0 && techniqueOf(scene.cutoff).hasK() && !scene.kScale && !strong_;
  const bool isHistogramWanted = scene.histogramSize > 0 && histogram_->passes() == number;
  if (isHistogramWanted && traced.onDevice)
  {
    histogram_->add(*traced.onDevice, rays.pass, scene.view.width, scene.view.height);
  }
  else if (isHistogramWanted)
  {
    histogram_->add(rays, scene.view.width, scene.view.height, scene.threads);
  }
  if (isKWanted)
  {
    strong_ = traced.onDevice ? schlieren::strongDeflection(*traced.onDevice, rays.pass,
                                  scene.view.width, scene.view.height, errors)
                              : schlieren::strongDeflection(
                                  rays, scene.view.width, scene.view.height, errors, scene.threads);
  }
}

void RayCache::finish()
{
  scratch_ = {};
  inScratch_ = -1;
  spare_.clear();
}

void RayCache::clear()
{
  moved_.reset();
  key_.reset();
  passes_.clear();
  finish();
}

} // namespace schlieren
