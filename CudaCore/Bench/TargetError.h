// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// The cheapest settings that keep a target error, found from patches of the image: see Scene::targetError.
//
// Errors of single settings are independent and add up in quadrature. That of a step is the difference to half of it, that
// of rays per pixel the difference to four times as many, times a factor for what these lack in their turn.
#pragma once

#include "Bench/Pilot.h"
#include "Bench/RayCache.h"
#include "Film/Image.h"

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <tuple>
#include <variant>

namespace schlieren
{

/// The rays per pixel that are tried.
constexpr std::array<int, 5> raysPerPixel{ 1, 4, 16, 32, 64 };

/// Errors that settings of rays do not lessen, in the unit of the target.
struct KnownErrors
{
  double voxels = 0;
  double rounding = 0;
};

/// What keeps the target, or comes closest.
struct AccurateSettings
{
  double step;            ///< voxels
  int samples;            ///< rays per pixel
  int samplesAtEdges = 0; ///< likewise, where edges of bodies are; 0: as many
  Accuracy accuracy{};
};

/// The tolerance of a source's medium for a target: no coarser than 0.01. Of an interferogram it follows from the most
/// fringes that the data can make.
double toleranceForTarget(const Field& field, const Scene& scene);

/// The errors of a pilot's medium for its view. Unknown if aborted or paused.
template <class Real>
KnownErrors knownErrors(Pilot<Real>& pilot, const Monitor& monitor);

/// Whether a medium with finer voxels or double precision is needed: `scene` has its settings then.
bool refine(const KnownErrors& known, bool isMemoryShort, Scene& scene);

/// Chooses settings for the pilot's scene, verifies them with other pixels, and chooses finer ones, at most twice, where that
/// shows that they do not keep the target. Begins with the settings of another image of the same technique, which may be
/// null, and takes them where they keep it and are not much finer than it wants. Nothing is chosen if aborted.
template <class Real>
AccurateSettings chooseFor(Pilot<Real>& pilot, const KnownErrors& known,
  const AccurateSettings* before, const Monitor& monitor);

/// What a pilot's rays and patches are of.
struct PilotKey
{
  ViewKey view;
  Device device;
  double lengthScale;
  Projection projection;
  std::uint32_t seed;

  auto tie() const
  {
    const Projection& p = projection;
    return std::tuple_cat(view.tie(),
      std::tie(device, lengthScale, p.distance, p.perDataUnit, p.pathPerDataUnit, p.exitRatio,
        p.perSourceDistance, p.isOfCamera, seed));
  }
};

/// Keeps what images with a target error hand on: the pilot of a view, and the settings of the last image.
class TargetCache
{
public:
  /// The pilot of a key, which is made where it is another one.
  template <class Real>
  Pilot<Real>& pilotOf(
    const PilotKey& key, const std::function<std::unique_ptr<Pilot<Real>>()>& make)
  {
    using Owned = std::unique_ptr<Pilot<Real>>;
    if (!key_ || key_->tie() != key.tie() || !std::holds_alternative<Owned>(pilot_))
    {
      clear();
      pilot_ = make();
      key_ = key;
    }
    return *std::get<Owned>(pilot_);
  }

  /// The settings of the last image, if its technique and target were these; else null.
  const AccurateSettings* lastFor(const Scene& scene) const
  {
    const bool isOfThese =
      last_ && cutoff_ == scene.cutoff && last_->accuracy.target == scene.targetError;
    return isOfThese ? &*last_ : nullptr;
  }
  void keep(const Scene& scene, const AccurateSettings& settings)
  {
    cutoff_ = scene.cutoff;
    last_ = settings;
  }

  /// Drops the pilot, before its medium goes.
  void clear()
  {
    pilot_ = std::monostate{};
    key_.reset();
  }

private:
  std::optional<PilotKey> key_;
  std::variant<std::monostate, std::unique_ptr<Pilot<float>>, std::unique_ptr<Pilot<double>>>
    pilot_;
  Cutoff cutoff_ = Cutoff::KnifeEdge;
  std::optional<AccurateSettings> last_;
};

} // namespace schlieren
