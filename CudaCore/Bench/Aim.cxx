// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// Images whose settings are found so that they keep a target error: see Scene::targetError.
#include "Bench/Stages.h"

#include "Device/DeviceError.h"

#include <utility>

namespace schlieren
{

namespace
{

/// Of an image's progress, where the first rays end that are shown, and the search for settings.
constexpr double progressOfFirst = 0.3, progressOfSearch = 0.4;

} // namespace

template <class Real>
bool Bench::Stages::findSettings(Aim& ofImage, const Watch& watch)
{
  const Field& field = ofImage.field;
  Scene& scene = ofImage.scene;
  UnfinishedImage request(field, scene);
  request.device = ofImage.device;
  request.progressFrom = ofImage.isShown ? progressOfFirst : 0;
  request.progressTo = progressOfSearch;
  MediumInUse<Real> inUse(media, field, clearedFor(request));
  const std::optional<ViewSetup<Real>> view = setUp(inUse, request, watch);
  if (!view)
  {
    return true;
  }
  scene.screenDistance = request.scene.screenDistance;
  Pilot<Real>& pilot = targets.pilotOf<Real>(
    { view->key, ofImage.device, field.lengthScale, view->projection, scene.seed },
    [&] { return std::make_unique<Pilot<Real>>(*view, scene); });
  const double k = scene.kScale.value_or(
    automaticK(pilot.view().strongDeflection, techniqueOf(scene.cutoff).fullScale));
  if (ofImage.isPaused)
  {
    pilot.resume(view->tracer);
  }
  else
  {
    pilot.begin(view->tracer, scene, k);
  }
  const KnownErrors known = knownErrors(pilot, watch.monitor());
  ofImage.isPaused = pilot.isPaused();
  if (watch.isAborted() || ofImage.isPaused)
  {
    return true;
  }
  const bool isMemoryShort = inUse.medium().tree && inUse.medium().tree->statistics().isMemoryShort;
  if (refine(known, isMemoryShort, scene))
  {
    return false;
  }
  AccurateSettings chosen = chooseFor(pilot, known, targets.lastFor(scene), watch.monitor());
  ofImage.isPaused = pilot.isPaused();
  if (watch.isAborted() || ofImage.isPaused)
  {
    return true;
  }
  targets.keep(scene, chosen);
  Scene accurate = scene;
  accurate.stepSize = chosen.step;
  accurate.adaptiveTolerance = adaptiveToleranceFor(chosen.step, scene.adaptiveTolerance);
  accurate.samplesPerPixel = chosen.samples;
  accurate.samplesAtEdges = chosen.samplesAtEdges;
  ofImage.request = std::make_unique<UnfinishedImage>(field, accurate);
  ofImage.request->device = ofImage.device;
  ofImage.request->deviceNote = ofImage.deviceNote;
  ofImage.request->progressFrom = progressOfSearch;
  ofImage.request->accuracy = chosen.accuracy;
  return true;
}

bool Bench::Stages::findOrChangeDevice(Aim& ofImage, const std::function<bool()>& find)
{
  try
  {
    return find();
  }
  catch (const DeviceError& failure)
  {
    clearRays();
    media.leaveDevice();
    const bool mayHaveRoom = dynamic_cast<const OutOfDeviceMemory*>(&failure) != nullptr;
    if (mayHaveRoom && !ofImage.hasLeftDevice)
    {
      ofImage.hasLeftDevice = true;
      return false;
    }
    if (ofImage.device == Device::Cpu || ofImage.scene.device == Device::Cuda)
    {
      throw;
    }
    ofImage.device = Device::Cpu;
    ofImage.deviceNote = failure.what();
    return false;
  }
  catch (...) // what another process may have thrown, after some of the rays
  {
    clearRays();
    throw;
  }
}

void Bench::Stages::beginAim(const Field& field, const Scene& scene, Device device)
{
  aim.emplace(Aim{ field, scene, device });
  Scene& accurate = aim->scene;
  accurate.interpolation = Interpolation::Cubic;
  accurate.samplesPerPixel = raysPerPixel.back();
  if (field.source)
  {
    accurate.mediumTolerance = toleranceForTarget(field, scene);
  }
  media.adopt(field, accurate);
}

Image Bench::Stages::renderFirst(const Monitor& monitor)
{
  Aim ofImage = std::move(*aim);
  aim.reset();
  std::unique_ptr<UnfinishedImage> request = std::move(unfinished);
  if (!request)
  {
    Scene first = ofImage.scene;
    first.targetError = 0;
    first.stepSize = longestStep;
    first.samplesPerPixel = 1;
    // The rays of an image that differs by its cutoff only are there already, and coarse ones would take their place.
    const AccurateSettings* before = targets.lastFor(ofImage.scene);
    if (before != nullptr && media.holds(ofImage.field, first) &&
      rays.areOf(frameOf(ofImage.field.grid, first.view), first.view))
    {
      first.stepSize = before->step;
      first.adaptiveTolerance = adaptiveToleranceFor(before->step, first.adaptiveTolerance);
      first.samplesPerPixel = before->samples;
      first.samplesAtEdges = before->samplesAtEdges;
    }
    request = std::make_unique<UnfinishedImage>(ofImage.field, first);
    request->device = ofImage.device;
    request->deviceNote = ofImage.deviceNote;
    request->progressTo = progressOfFirst;
  }
  Image image = render(std::move(request), monitor);
  if (!image.aborted)
  {
    ofImage.isShown = image.finished;
    if (image.finished && image.samplesPerPixel > 1)
    {
      ofImage.shown = image;
    }
    if (ofImage.scene.choosesScreen && image.screenDistance > 0)
    {
      ofImage.scene.screenDistance = image.screenDistance; // stays that of the first rays
    }
    image.finished = false;
    aim = std::move(ofImage);
  }
  return image;
}

Image Bench::Stages::renderAim(const Monitor& monitor)
{
  if (monitor.paused && !aim->isShown)
  {
    return renderFirst(monitor);
  }
  Aim ofImage = std::move(*aim);
  aim.reset();
  {
    const Watch watch(monitor);
    const auto find = [&]
    {
      return ofImage.scene.precision == Precision::Single ? findSettings<float>(ofImage, watch)
                                                          : findSettings<double>(ofImage, watch);
    };
    while (!watch.isAborted() && !findOrChangeDevice(ofImage, find))
    {
      ofImage.shown.reset(); // of another medium
    }
  }
  if (ofImage.request && ofImage.shown) // which may be the image that is wanted
  {
    const Scene& chosen = ofImage.request->scene;
    Image& image = *ofImage.shown;
    if (image.stepSize == chosen.stepSize && image.samplesPerPixel == chosen.samplesPerPixel &&
      image.samplesAtEdges == chosen.samplesAtEdges)
    {
      image.accuracy = ofImage.request->accuracy;
      image.finished = true;
      return std::move(image);
    }
  }
  if (ofImage.request)
  {
    return render(std::move(ofImage.request), monitor);
  }
  if (!ofImage.isPaused)
  {
    return abortedImage();
  }
  Image nothing = imageOf(UnfinishedImage(ofImage.field, ofImage.scene));
  nothing.finished = false;
  aim = std::move(ofImage);
  return nothing;
}

} // namespace schlieren
