// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Bench/MediumCache.h"

#include <algorithm>
#include <mutex>
#include <type_traits>
#include <utility>
#include <vector>

namespace schlieren
{

namespace
{

/// A medium that is there as long as a bench uses it.
template <class Real>
using WeakMedium = std::weak_ptr<MediumOnDevices<Real>>;

} // namespace

MediumKey MediumKey::of(const Field& field, const Scene& scene)
{
  const bool hasSource = field.source != nullptr;
  const void* samples = hasSource ? static_cast<const void*>(field.source.get())
    : field.singles != nullptr    ? static_cast<const void*>(field.singles)
                                  : static_cast<const void*>(field.doubles);
  const Grid& grid = field.grid;
  return { grid.dimensions, grid.origin, grid.spacing, grid.direction, field.version, samples,
    field.offset, field.ambient, scene.interpolation, scene.precision,
    hasSource ? scene.mediumTolerance : 0, hasSource ? scene.mediumMemory : 0 };
}

template <class Real>
Medium<Real> mediumFor(const Field& field, const Scene& scene)
{
  return field.source
    ? buildTree<Real>(
        field, { scene.mediumTolerance, scene.mediumMemory, scene.interpolation, scene.threads })
    : buildMedium<Real>(field, scene.interpolation, scene.threads);
}

template <class Real>
CudaTracer<Real>& MediumOnDevices<Real>::cudaTracer()
{
  if (!cuda_)
  {
    cuda_ = std::make_unique<CudaTracer<Real>>(medium);
  }
  return *cuda_;
}

template <class Real>
ProcessTracer<Real>& MediumOnDevices<Real>::processTracer()
{
  if (!together_)
  {
    together_ = std::make_unique<ProcessTracer<Real>>(medium);
  }
  return *together_;
}

template <class Real>
bool MediumOnDevices<Real>::refineFor(const Column& column, bool isShared, const Monitor& monitor)
{
  if (refine(medium, column, monitor, isShared ? Unneeded::Stays : Unneeded::Goes))
  {
    ++changes;
    cuda_.reset();
    together_.reset();
  }
  return !medium.tree->lacksRoom();
}

struct SharedMedia::Entries
{
  struct Entry
  {
    MediumKey key;
    std::variant<WeakMedium<float>, WeakMedium<double>> medium;

    bool isThere() const
    {
      return std::visit([](const auto& current) { return !current.expired(); }, medium);
    }
  };
  std::mutex mutex;
  std::vector<Entry> all;

  void dropThoseGone()
  {
    all.erase(
      std::remove_if(all.begin(), all.end(), [](const Entry& entry) { return !entry.isThere(); }),
      all.end());
  }

  template <class Real>
  std::shared_ptr<MediumOnDevices<Real>> find(const MediumKey& key)
  {
    const std::lock_guard<std::mutex> lock(mutex);
    const auto found = std::find_if(
      all.begin(), all.end(), [&](const Entry& entry) { return entry.key.tie() == key.tie(); });
    return found != all.end() ? std::get<WeakMedium<Real>>(found->medium).lock() : nullptr;
  }

  /// Gives a medium another key. False where others use it.
  template <class Real>
  bool rename(const std::shared_ptr<MediumOnDevices<Real>>& medium, const MediumKey& key)
  {
    const std::lock_guard<std::mutex> lock(mutex);
    if (medium.use_count() > 1)
    {
      return false;
    }
    for (Entry& entry : all)
    {
      const auto* own = std::get_if<WeakMedium<Real>>(&entry.medium);
      entry.key = own && own->lock() == medium ? key : entry.key;
    }
    return true;
  }

  template <class Real>
  void add(const MediumKey& key, const std::shared_ptr<MediumOnDevices<Real>>& medium)
  {
    const std::lock_guard<std::mutex> lock(mutex);
    dropThoseGone();
    all.push_back({ key, WeakMedium<Real>(medium) });
  }
};

SharedMedia::SharedMedia()
  : entries_(std::make_unique<Entries>())
{
}

SharedMedia::~SharedMedia() = default;

int SharedMedia::count() const
{
  const std::lock_guard<std::mutex> lock(entries_->mutex);
  entries_->dropThoseGone();
  return static_cast<int>(entries_->all.size());
}

bool MediumCache::holds(const Field& field, const Scene& scene) const
{
  return key_ && key_->tie() == MediumKey::of(field, scene).tie();
}

void MediumCache::adopt(const Field& field, Scene& scene) const
{
  if (!key_)
  {
    return;
  }
  Scene like = scene;
  like.mediumTolerance = key_->tolerance;
  like.precision = key_->precision;
  const bool isFiner = !(key_->tolerance > scene.mediumTolerance) &&
    (key_->precision == Precision::Double || scene.precision == Precision::Single);
  if (isFiner && holds(field, like))
  {
    scene = like;
  }
}

template <class Real>
std::shared_ptr<MediumOnDevices<Real>> MediumCache::make(const Field& field, const Scene& scene)
{
  ++work_.mediumBuilds;
  return std::make_shared<MediumOnDevices<Real>>(mediumFor<Real>(field, scene));
}

template <class Real>
MediumOfBench<Real>& MediumCache::mediumOf(const Field& field, const Scene& scene)
{
  if (!holds(field, scene) && !refineWhatIsThere<Real>(field, scene))
  {
    key_.reset();
    medium_ = std::monostate{};
    const MediumKey key = MediumKey::of(field, scene);
    MediumOfBench<Real> current;
    if (media_)
    {
      current.shared = media_->entries_->find<Real>(key);
    }
    if (!current.shared)
    {
      current.shared = make<Real>(field, scene);
      if (media_)
      {
        media_->entries_->add(key, current.shared);
      }
    }
    medium_ = std::move(current);
    key_ = key;
  }
  return std::get<MediumOfBench<Real>>(medium_);
}

template <class Real>
bool MediumCache::refineWhatIsThere(const Field& field, const Scene& scene)
{
  const MediumKey key = MediumKey::of(field, scene);
  MediumKey like = key;
  like.tolerance = key_ ? key_->tolerance : 0;
  auto* current = std::get_if<MediumOfBench<Real>>(&medium_);
  if (!key_ || key_->tie() != like.tie() || !(key.tolerance < like.tolerance) || !current ||
    (media_ && !media_->entries_->rename(current->shared, key)))
  {
    return false;
  }
  current->shared->medium.tree->lowerTolerance(key.tolerance);
  current->refinedFor.reset();
  key_ = key;
  return true;
}

template <class Real>
void MediumCache::remake(MediumOfBench<Real>& current, const Field& field, const Scene& scene)
{
  const std::optional<MediumKey> key = std::exchange(key_, std::nullopt);
  current = {}; // first: two media at once might not fit
  current.shared = make<Real>(field, scene);
  key_ = key;
}

void MediumCache::leaveDevice()
{
  std::visit(
    [](auto& current)
    {
      if constexpr (!std::is_same_v<std::decay_t<decltype(current)>, std::monostate>)
      {
        if (current.shared)
        {
          current.shared->leaveDevice();
        }
      }
    },
    medium_);
}

template <class Real>
MediumInUse<Real>::MediumInUse(MediumCache& cache, const Field& field, const Scene& scene)
  : cache_(cache)
  , field_(field)
  , scene_(scene)
  , current_(cache.mediumOf<Real>(field, scene))
{
  if (!acquire())
  {
    useOwn();
  }
}

template <class Real>
bool MediumInUse<Real>::acquire()
{
  isMine_ = !onDevices().isInUse.exchange(true);
  return isMine_;
}

template <class Real>
void MediumInUse<Real>::release()
{
  if (isMine_)
  {
    onDevices().isInUse = false;
    isMine_ = false;
  }
}

template <class Real>
void MediumInUse<Real>::useOwn()
{
  release();
  cache_.remake(current_, field_, scene_);
  acquire();
}

template <class Real>
void MediumInUse<Real>::refine(const Column& column, const Monitor& monitor)
{
  if (current_.refinedFor && current_.refinedFor->tie() == column.tie() &&
    current_.changesThen == onDevices().changes)
  {
    return; // to find out that nothing is missing takes long, too
  }
  current_.refinedFor.reset();
  if (!refineOnce(column, monitor))
  {
    useOwn();
    refineOnce(column, monitor);
  }
  if (!monitor.aborted || !monitor.aborted())
  {
    current_.refinedFor = column;
    current_.changesThen = onDevices().changes;
  }
}

template <class Real>
bool MediumInUse<Real>::refineOnce(const Column& column, const Monitor& monitor)
{
  return onDevices().refineFor(column, current_.shared.use_count() > 1, monitor);
}

template <class Real>
bool MediumInUse<Real>::seesChange()
{
  return std::exchange(current_.changesSeen, onDevices().changes) != onDevices().changes;
}

template Medium<float> mediumFor(const Field&, const Scene&);
template Medium<double> mediumFor(const Field&, const Scene&);
template class MediumOnDevices<float>;
template class MediumOnDevices<double>;
template class MediumInUse<float>;
template class MediumInUse<double>;

} // namespace schlieren
