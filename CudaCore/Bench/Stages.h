// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// What runs the stages in order and keeps their results: Bench.cxx for images, Aim.cxx for the settings that a target error
// needs.
#pragma once

#include "Bench/CutoffMaker.h"
#include "Bench/MediumCache.h"
#include "Bench/PassLoop.h"
#include "Bench/RayCache.h"
#include "Bench/StageSettings.h"
#include "Bench/TargetError.h"
#include "Bench/UnfinishedImage.h"
#include "Bench/Watch.h"
#include "Schlieren.h"

#include <cstdint>
#include <memory>
#include <optional>

namespace schlieren
{

/// What has been found out about an image whose settings are to keep its target error.
struct Aim
{
  Field field;
  Scene scene; ///< with the medium that the target needs, as far as that is known
  Device device;
  std::unique_ptr<UnfinishedImage> request{}; ///< with all settings, once they are found
  bool isPaused = false;
  bool isShown = false; ///< with one ray per pixel
};

/// Which rays a view needs, and how they are to be traced.
struct RaysOfView
{
  ViewKey key;
  RaySettings settings;
  std::int64_t margin; ///< pixels around the image from which light may be bent into it
};

inline Projection projectionFor(const RaySettings& settings, const Light& light,
  const UnfinishedImage& request, const Image& image)
{
  // Of straight rays all is of first order, and the bend makes nothing longer.
  const bool bends = settings.kernel.path != PathModel::Straight;
  return projectionOf(request.scene, image.frame, light,
    bends ? (1 + image.exitRefractivity) * request.field.lengthScale : 0);
}

inline Image abortedImage()
{
  Image image;
  image.aborted = true;
  return image;
}

template <class Real>
DeflectionErrors deflectionErrors(
  const Medium<Real>& medium, const Light& light, const Field& field, const Image& image)
{
  return { light.faces.ratio * noiseFloor(medium, field, light),
    light.faces.ratio * image.medium.deflectionError };
}

struct Bench::Stages
{
  Work work;
  Processes* processes = nullptr;              ///< null: there are no others
  std::unique_ptr<UnfinishedImage> unfinished; ///< after a pause
  std::optional<Aim> aim;                      ///< likewise, before that
  MediumCache media{ work };
  RayCache rays;
  RayCache waveRays; ///< those that waves are made of
  CutoffMaker cutoffs;
  TargetCache targets;

  void cancel()
  {
    unfinished.reset();
    aim.reset();
  }

  /// Begins an image with a target error, which renderAim() then makes. One that may be paused is first shown with one ray
  /// per pixel.
  void beginAim(const Field& field, const Scene& scene, Device device);
  /// Finds its settings, and then works on it. Keeps what has been found after a pause.
  Image renderAim(const Monitor& monitor);
  Image renderFirst(const Monitor& monitor);

  /// Works on an image until it is finished, aborted or paused, on the device of its scene, and keeps what is left after a
  /// pause.
  Image render(std::unique_ptr<UnfinishedImage> request, const Monitor& monitor);

private:
  /// What finds the settings for an image in this medium.
  template <class Real>
  Pilot<Real>& pilotFor(MediumOnDevices<Real>& onDevices, const Light& light,
    const UnfinishedImage& request, Image& image);
  /// Finds the settings with the medium of the scene. False if others are needed, which it then writes
  /// into the scene.
  template <class Real>
  bool findSettings(Aim& ofImage, const Watch& watch);

  /// Drops rays, before their medium goes or after it has changed.
  void clearRays()
  {
    rays.clear();
    waveRays.clear();
    targets.clear();
  }
  /// Drops them where another medium is to be made.
  const Scene& clearedFor(const UnfinishedImage& request);
  /// Which rays an image needs, and how they are to be traced; and where the medium is steepest.
  template <class Real>
  RaysOfView raysFor(MediumOnDevices<Real>& onDevices, const Light& light,
    const UnfinishedImage& request, Image& image);
  /// Finds the medium's voxels that a view needs, and its light.
  template <class Real>
  Light prepareMedium(
    MediumInUse<Real>& inUse, UnfinishedImage& request, const Watch& watch, Image& image);

  /// The same on the device of the request, without an answer to its failures.
  template <class Real>
  Image proceed(UnfinishedImage& request, const Watch& watch);

  /// An image without light.
  Image begin(const UnfinishedImage& request) const;
  /// Finds what the rays of an image are traced by, and drops other rays.
  template <class Real>
  RaysOfImage<Real> prepareRays(
    MediumOnDevices<Real>& medium, const Light& light, UnfinishedImage& request, Image& image);
  /// Writes what there is of an image into it. False if aborted.
  bool develop(bool hasAllPasses, UnfinishedImage& request, const Watch& watch, Image& image);

  /// What replaces a request that a device has failed; null where nothing can.
  static std::unique_ptr<UnfinishedImage> instead(
    const UnfinishedImage& request, const DeviceError& failure);
};

} // namespace schlieren
