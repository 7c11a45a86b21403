// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace schlieren
{

/// Counts what this program holds through operator new, which PeakMemory.cxx replaces: bytes requested,
/// so that the count is the same everywhere. One at a time.
class PeakMemory
{
public:
  PeakMemory();

  /// The most that was allocated at once since the constructor, beyond what was allocated then.
  std::size_t bytes() const;

private:
  std::size_t before_;
};

/// As long as it is there, one request of this thread for memory fails: the first where `number` is 0, and so on.
class FailingAllocation
{
public:
  explicit FailingAllocation(int number);
  ~FailingAllocation();
  FailingAllocation(const FailingAllocation&) = delete;
  FailingAllocation& operator=(const FailingAllocation&) = delete;

  bool hasFailed() const;
};

} // namespace schlieren
