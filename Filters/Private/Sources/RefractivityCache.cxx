// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Sources/RefractivityCache.h"

#include "vtkImageData.h"

#include "Schlieren.h"

#include <algorithm>
#include <mutex>
#include <utility>

namespace
{

struct Entry
{
  RefractivityKey Key;
  std::weak_ptr<const MadeRefractivity> Made;
};

struct Entries
{
  std::mutex Mutex;
  std::vector<Entry> All;
};

/// Never deleted, because filters may outlive static objects at exit.
Entries& entries()
{
  static auto& all = *new Entries;
  return all;
}

} // namespace

MadeRefractivity::MadeRefractivity() = default;

MadeRefractivity::~MadeRefractivity() = default;

bool MadeRefractivity::IsThere() const
{
  return this->Source || this->Image->GetNumberOfPoints() > 0;
}

std::shared_ptr<const MadeRefractivity> findRefractivity(const RefractivityKey& key)
{
  const std::lock_guard<std::mutex> lock(entries().Mutex);
  std::vector<Entry>& all = entries().All;
  const auto found =
    std::find_if(all.begin(), all.end(), [&](const Entry& entry) { return entry.Key == key; });
  return found != all.end() ? found->Made.lock() : nullptr;
}

void cacheRefractivity(RefractivityKey key, const std::shared_ptr<const MadeRefractivity>& made)
{
  const std::lock_guard<std::mutex> lock(entries().Mutex);
  std::vector<Entry>& all = entries().All;
  all.erase(std::remove_if(all.begin(), all.end(),
              [&](const Entry& entry) { return entry.Made.expired() || entry.Key == key; }),
    all.end());
  all.push_back({ std::move(key), made });
}

std::shared_ptr<schlieren::SharedMedia> mediaOfProcess()
{
  // Never deleted, like entries().
  static const auto& media =
    *new const std::shared_ptr<schlieren::SharedMedia>(std::make_shared<schlieren::SharedMedia>());
  return media;
}
