// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// What runs the stages in order and keeps their results: Bench.cxx for images, Aim.cxx for the settings that a target error
// needs.
#pragma once

#include "Bench/CutoffMaker.h"
#include "Bench/EdgeStage.h"
#include "Bench/MediumCache.h"
#include "Bench/RayCache.h"
#include "Bench/TargetError.h"
#include "Bench/UnfinishedImage.h"
#include "Bench/ViewSetup.h"
#include "Bench/Watch.h"
#include "Schlieren.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace schlieren
{

/// What has been found out about an image whose settings are to keep its target error.
struct Aim
{
  Field field;
  Scene scene; ///< with the medium that the target needs, as far as that is known
  Device device;
  std::string deviceNote{};                   ///< why it is another one than was chosen at first
  bool hasLeftDevice = false;                 ///< to give its memory back
  std::unique_ptr<UnfinishedImage> request{}; ///< with all settings, once they are found
  bool isPaused = false;
  bool isShown = false; ///< with one ray per pixel
  std::optional<Image>
    shown{}; ///< if with the settings of the view's last image, which may be right
};

inline Image abortedImage()
{
  Image image;
  image.aborted = true;
  return image;
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
  EdgeRays edgeRays;
  CutoffMaker cutoffs;
  TargetCache targets;

  void cancel()
  {
    unfinished.reset();
    aim.reset();
  }

  /// Begins an image with a target error, which renderAim() then makes. One that may be paused is first shown with one ray
  /// per pixel, or with those of the view's last image.
  void beginAim(const Field& field, const Scene& scene, Device device);
  /// Finds its settings, and then works on it. Keeps what has been found after a pause.
  Image renderAim(const Monitor& monitor);
  Image renderFirst(const Monitor& monitor);

  /// Works on an image until it is finished, aborted or paused, on the device of its scene, and keeps what is left after a
  /// pause.
  Image render(std::unique_ptr<UnfinishedImage> request, const Monitor& monitor);

private:
  /// Finds the settings with the medium of the scene. False if others are needed, which it then writes
  /// into the scene.
  template <class Real>
  bool findSettings(Aim& ofImage, const Watch& watch);
  /// The same, or false after a failure of the device: with its memory given back, and then on the CPU.
  bool findOrChangeDevice(Aim& ofImage, const std::function<bool()>& find);

  /// Drops rays, before their medium goes or after it has changed.
  void clearRays()
  {
    rays.clear();
    waveRays.clear();
    edgeRays.clear();
    targets.clear();
  }
  /// Drops them where another medium is to be made.
  const Scene& clearedFor(const UnfinishedImage& request);
  /// Makes what a view needs of the medium and its rays. Nothing if aborted.
  template <class Real>
  std::optional<ViewSetup<Real>> setUp(
    MediumInUse<Real>& inUse, UnfinishedImage& request, const Watch& watch);

  /// The same on the device of the request, without an answer to its failures.
  template <class Real>
  Image proceed(UnfinishedImage& request, const Watch& watch);

  /// An image without light.
  Image imageOf(const UnfinishedImage& request) const;
  template <class Real>
  Image imageOf(const UnfinishedImage& request, const ViewSetup<Real>& view) const;
  /// Writes what there is of an image into it. False if aborted.
  bool develop(UnfinishedImage& request, const Watch& watch, Image& image);

  /// What replaces a request that a device has failed; null where nothing can.
  static std::unique_ptr<UnfinishedImage> instead(
    const UnfinishedImage& request, const DeviceError& failure);
};

} // namespace schlieren
