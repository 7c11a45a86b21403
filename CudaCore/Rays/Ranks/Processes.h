// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

namespace schlieren
{

/// The other ranks: processes of the same program, on the same kind of processor, which do what this one requests.
class Processes
{
public:
  Processes() = default;
  Processes(const Processes&) = delete;
  Processes& operator=(const Processes&) = delete;
  virtual ~Processes() = default;

  /// How many there are besides this one.
  virtual int others() const = 0;

  /// Sends one request to all of them, calls `meanwhile` here, and returns their answers, in a fixed order. Throws what
  /// has gone wrong on any rank, once all have answered. Called by one thread.
  virtual std::vector<std::vector<char>> request(
    const std::vector<char>& message, const std::function<void()>& meanwhile) = 0;

  /// What a ProcessTracer has found out about them.
  struct KnownOfRays
  {
    std::array<std::uint64_t, 6> arrays{}; ///< versions of those of a RayTask that they have
    double secondsPerTile = 0;             ///< of all processes together; 0: not known yet
  };
  KnownOfRays& ofRays() { return ofRays_; }

private:
  KnownOfRays ofRays_;
};

} // namespace schlieren
