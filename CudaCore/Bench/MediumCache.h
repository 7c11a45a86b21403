// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// The media of benches: made once, used until another one is wanted, and by several benches where these may.
#pragma once

#include "Medium/Medium.h"
#include "Rays/Cuda/CudaTracer.h"
#include "Rays/Ranks/ProcessTracer.h"
#include "Schlieren.h"

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <tuple>
#include <utility>
#include <variant>

namespace schlieren
{

/// What a cached medium was built from.
struct MediumKey
{
  std::array<std::int64_t, 3> dimensions;
  Vector origin;
  Vector spacing;
  std::array<double, 9> direction;
  std::uint64_t version;
  const void* samples;
  double offset;
  std::optional<double> ambient;
  Interpolation interpolation;
  Precision precision;
  double tolerance; ///< of a source, as the next; else 0
  std::size_t memory;

  static MediumKey of(const Field& field, const Scene& scene);

  auto tie() const
  {
    return std::tie(dimensions, origin, spacing, direction, version, samples, offset, ambient,
      interpolation, precision, tolerance, memory);
  }
};

/// The medium of a field, on its grid, or within the scene's tolerance without any voxels yet.
template <class Real>
Medium<Real> mediumFor(const Field& field, const Scene& scene);

/// A medium, and what has been made of it to trace rays.
template <class Real>
class MediumOnDevices
{
public:
  explicit MediumOnDevices(Medium<Real> ofField)
    : medium(std::move(ofField))
  {
  }

  std::atomic<bool> isInUse{ false };
  Medium<Real> medium;
  std::int64_t changes = 0; ///< of its voxels

  /// Puts the medium on the device where it is not there yet. Throws DeviceError.
  CudaTracer<Real>& cudaTracer();
  ProcessTracer<Real>& processTracer();
  void leaveDevice() { cuda_.reset(); }

  /// Makes the voxels of a source that a view needs and that are not there. False where they do not fit. `isShared`: other
  /// benches keep theirs.
  bool refineFor(const Column& column, bool isShared, const Monitor& monitor);

private:
  std::unique_ptr<CudaTracer<Real>> cuda_;
  std::unique_ptr<ProcessTracer<Real>> together_;
};

template <class Real>
struct MediumOfBench
{
  static constexpr std::int64_t noChange = -1;

  std::shared_ptr<MediumOnDevices<Real>> shared;
  std::int64_t changesSeen = noChange; ///< those that the bench's rays are of
  std::optional<Column> refinedFor;    ///< the last view whose voxels were made, as the next
  std::int64_t changesThen = noChange; ///< of the medium
};

class MediumCache
{
public:
  /// `work`: counts the media that are made.
  explicit MediumCache(Work& work)
    : work_(work)
  {
  }

  /// Takes the next media from these, or adds them; null: from none.
  void setMedia(std::shared_ptr<SharedMedia> media) { media_ = std::move(media); }

  bool holds(const Field& field, const Scene& scene) const;
  /// Gives a scene with a target error what the medium of its field that is there has: finer voxels, double precision.
  void adopt(const Field& field, Scene& scene) const;
  /// The medium of a field. What was there before it is freed first: two media at once might not fit.
  template <class Real>
  MediumOfBench<Real>& mediumOf(const Field& field, const Scene& scene);
  /// Replaces a medium by one for this bench alone. Where that fails there is none.
  template <class Real>
  void remake(MediumOfBench<Real>& current, const Field& field, const Scene& scene);

  /// Gives the device's memory back.
  void leaveDevice();

private:
  /// Lowers the tolerance of the medium that is there, where nothing else has changed and others do not use it: what has been
  /// made stays.
  template <class Real>
  bool refineWhatIsThere(const Field& field, const Scene& scene);
  template <class Real>
  std::shared_ptr<MediumOnDevices<Real>> make(const Field& field, const Scene& scene);

  Work& work_;
  std::shared_ptr<SharedMedia> media_; ///< may be null
  std::optional<MediumKey> key_;
  std::variant<std::monostate, MediumOfBench<float>, MediumOfBench<double>> medium_;
};

/// The medium of a field, in which its bench is at work as long as this is there. Where another bench is at work in it,
/// one is made for this bench alone.
template <class Real>
class MediumInUse
{
public:
  MediumInUse(MediumCache& cache, const Field& field, const Scene& scene);
  ~MediumInUse() { release(); }
  MediumInUse(const MediumInUse&) = delete;
  MediumInUse& operator=(const MediumInUse&) = delete;

  MediumOnDevices<Real>& onDevices() const { return *current_.shared; }
  const Medium<Real>& medium() const { return onDevices().medium; }

  /// Makes the voxels of a source that a view needs and that are not there.
  void refine(const Column& column, const Monitor& monitor);

  /// Whether the medium has changed since the last call.
  bool seesChange();

private:
  bool acquire();
  void release();
  void useOwn();
  bool refineOnce(const Column& column, const Monitor& monitor);

  MediumCache& cache_;
  const Field& field_;
  const Scene& scene_;
  MediumOfBench<Real>& current_;
  bool isMine_ = false;
};

} // namespace schlieren
