// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Bench/PassLoop.h"

#include <algorithm>
#include <chrono>

namespace schlieren
{

template <class Real>
PassLoop<Real>::PassLoop(const ViewSetup<Real>& ofView, UnfinishedImage& request,
  const Watch& watch, RayCache& rays, CutoffMaker& cutoffs, Work& work)
  : view_(ofView)
  , request_(request)
  , watch_(watch)
  , rays_(rays)
  , cutoffs_(cutoffs)
  , work_(work)
{
  const View& view = request.scene.view;
  const std::int64_t around = rays.margin();
  pass_ = { -around, -around, view.width + 2 * around, view.height + 2 * around, { 0, 0 } };
}

template <class Real>
bool PassLoop<Real>::run()
{
  bool continues = completeUndisturbed(watch_.monitor());
  while (continues && request_.image->passes() < request_.scene.samplesPerPixel)
  {
    // What has taken more than a call is shown before the next pass hides it.
    if (watch_.mayPause() && request_.hasBeenSilent && request_.isNewImageThere())
    {
      break;
    }
    continues = addPass();
    if (!continues || watch_.isPaused())
    {
      break;
    }
  }
  return continues;
}

template <class Real>
bool PassLoop<Real>::addPass()
{
  const Scene& scene = request_.scene;
  ProgressiveImage& image = *request_.image;
  const std::int64_t number = image.passes();
  Monitor monitor = monitorOfPass(number);
  aimPass(pass_, number, scene.samplesPerPixel, scene, view_.task.light);
  const double tracedBefore = request_.traceSeconds;
  const TracedPass* traced = rays_.raysOf(number, pass_, request_.device,
    request_.keepsRays ? scene.memoryBudget : 0,
    [&](TracedPass& place, bool isWantedOnHost) { return trace(place, isWantedOnHost, monitor); });
  const bool hasTraced = request_.traceSeconds > tracedBefore;
  if (traced == nullptr || watch_.isAborted() || (hasTraced && watch_.isPaused()))
  {
    return false;
  }
  request_.momentumDrift = std::max(request_.momentumDrift, traced->worstDrift);
  const TracedRays rays{ pass_, traced->exits.data() };
  rays_.request(*traced, rays, number, scene, view_.errors);
  if (!image.isBegun())
  {
    begin();
  }
  monitor.progress = {};
  return image.add(*traced, pass_, rays_.holds(*traced) ? Rays::Stay : Rays::Go, monitor) &&
    completeUndisturbed(monitor);
}

template <class Real>
Monitor PassLoop<Real>::monitorOfPass(std::int64_t number) const
{
  Monitor monitor = watch_.monitor();
  if (monitor.progress)
  {
    monitor.progress = [this, number](double fraction)
    {
      watch_.monitor().progress(request_.progressOfRays(
        (static_cast<double>(number) + fraction) / request_.scene.samplesPerPixel));
    };
  }
  return monitor;
}

template <class Real>
bool PassLoop<Real>::completeUndisturbed(const Monitor& monitor)
{
  return !watch_.mayPause() || request_.image->completeUndisturbed(monitor);
}

template <class Real>
void PassLoop<Real>::begin()
{
  const Scene& scene = request_.scene;
  if (techniqueOf(scene.cutoff).hasK())
  {
    request_.kScale = scene.kScale
      ? *scene.kScale
      : automaticK(rays_.strongDeflection(), techniqueOf(scene.cutoff).fullScale);
  }
  const View& view = scene.view;
  const std::int64_t margin = view_.margin;
  request_.image->begin({ cutoffs_.cutoffOf(scene, request_.kScale, view_.pixels), view_.projection,
    margin,
    (view.width + 2 * margin) * (view.height + 2 * margin) * passesToHold(scene.samplesPerPixel) });
}

template <class Real>
bool PassLoop<Real>::trace(TracedPass& traced, bool isWantedOnHost, const Monitor& monitor)
{
  const auto start = std::chrono::steady_clock::now();
  const std::int64_t countedBefore = traced.tilesDone > 0 ? traced.crossed : 0;
  const bool isTraced = view_.tracer.trace(view_.task, pass_, traced, monitor, isWantedOnHost);
  request_.traceSeconds +=
    std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (isTraced || request_.device == Device::Cpu)
  {
    work_.raysTraced += traced.crossed - countedBefore;
  }
  return isTraced;
}

template class PassLoop<float>;
template class PassLoop<double>;

} // namespace schlieren
