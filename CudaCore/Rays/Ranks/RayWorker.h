// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

namespace schlieren
{

/// Traces rays for the ProcessTracer of another rank.
class RayWorker
{
public:
  /// `process`: the rank, of so many; that of the ProcessTracer is 0.
  RayWorker(int process, int processes);
  ~RayWorker();

  /// The first bytes of each request. Others have other numbers.
  enum Kind : std::uint32_t
  {
    Array = 100, ///< to be kept: a piece of an array of the medium
    Trace        ///< tiles
  };
  static std::uint32_t kindOf(const std::vector<char>& request);
  static bool isFor(std::uint32_t kind) { return kind >= Array && kind <= Trace; }

  /// Does what a request says. Throws Error where it cannot.
  std::vector<char> answer(const std::vector<char>& request, int threads);

private:
  struct Arrays;
  std::unique_ptr<Arrays> arrays_;
  int process_, processes_;
};

} // namespace schlieren
