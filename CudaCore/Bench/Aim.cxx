// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// Images whose settings are found so that they keep a target error: see Scene::targetError.
#include "Bench/Stages.h"

#include <utility>

namespace schlieren
{

template <class Real>
Pilot<Real>& Bench::Stages::pilotFor(MediumOnDevices<Real>& onDevices, const Light& light,
  const UnfinishedImage& request, Image& image)
{
  const Field& field = request.field;
  const Scene& scene = request.scene;
  const bool wantsAllPixels = scene.estimatesErrors || scene.errorNorm == ErrorNorm::Largest;
  const RaysOfView rays = raysFor(onDevices, light, request, image);
  const Projection projection = projectionFor(rays.settings, light, request, image);
  return targets.pilotOf<Real>(
    { rays.key, field.lengthScale, projection, scene.filmEstimator, scene.seed, wantsAllPixels },
    [&]
    {
      const PilotBench<Real> bench{ &onDevices.medium, light, scene, projection, rays.settings,
        rays.margin };
      return std::make_unique<Pilot<Real>>(
        bench, deflectionErrors(onDevices.medium, light, field, image), wantsAllPixels);
    });
}

template <class Real>
bool Bench::Stages::findSettings(Aim& ofImage, const Watch& watch)
{
  const Field& field = ofImage.field;
  Scene& scene = ofImage.scene;
  UnfinishedImage request(field, scene);
  Image image = begin(request);
  MediumInUse<Real> inUse(media, field, clearedFor(request));
  const Light light = prepareMedium(inUse, request, watch, image);
  if (watch.isAborted())
  {
    return true;
  }
  if (inUse.seesChange())
  {
    clearRays();
  }
  const Medium<Real>& medium = inUse.medium();
  Pilot<Real>& pilot = pilotFor(inUse.onDevices(), light, request, image);
  const double k = scene.kScale.value_or(
    automaticK(pilot.view().strongDeflection, techniqueOf(scene.cutoff).fullScale));
  const PixelPlaces pixels = pixelPlacesOf(image.frame, scene.view, light);
  if (ofImage.isPaused)
  {
    pilot.resume();
  }
  else
  {
    pilot.begin(scene, k, pixels);
  }
  const KnownErrors known = knownErrors(
    pilot.bench(), pilot.view(), deflectionErrors(medium, light, field, image).medium, k);
  if (refine(known, image.medium.isMemoryShort, scene))
  {
    return false;
  }
  const bool hasWalls =
    !medium.solid.empty() || (medium.tree && !medium.tree->gasDistances().empty());
  AccurateSettings chosen =
    chooseFor(pilot, hasWalls, known, targets.lastFor(scene), watch.monitor());
  ofImage.isPaused = pilot.isPaused();
  if (watch.isAborted() || ofImage.isPaused)
  {
    return true;
  }
  chosen.accuracy.ofData = scene.estimatesDataError
    ? errorOfData(pilot, field, columnOf(scene, light, image.frame, 0), chosen.step, k, pixels,
        watch.monitor())
    : Accuracy().ofData;
  targets.keep(scene, chosen);
  Scene accurate = scene;
  accurate.stepSize = chosen.step;
  accurate.adaptiveTolerance = adaptiveToleranceFor(chosen.step, scene.adaptiveTolerance);
  accurate.samplesPerPixel = chosen.samples;
  ofImage.request = std::make_unique<UnfinishedImage>(field, accurate);
  ofImage.request->device = ofImage.device;
  ofImage.request->accuracy = chosen.accuracy;
  return true;
}

void Bench::Stages::beginAim(const Field& field, const Scene& scene, Device device)
{
  aim.emplace(Aim{ field, scene, device });
  Scene& accurate = aim->scene;
  accurate.interpolation = Interpolation::Cubic;
  accurate.homogeneityTolerance = 0;
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
    request = std::make_unique<UnfinishedImage>(ofImage.field, first);
    request->device = ofImage.device;
  }
  Image image = render(std::move(request), monitor);
  if (!image.aborted)
  {
    ofImage.isShown = image.finished;
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
    while (!watch.isAborted() && !find())
    {
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
  Image nothing = begin(UnfinishedImage(ofImage.field, ofImage.scene));
  nothing.finished = false;
  aim = std::move(ofImage);
  return nothing;
}

} // namespace schlieren
