// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <benchmark/benchmark.h>

#include <chrono>

/// Calls makeImage() once per iteration, which returns the seconds that were spent tracing, and counts images per second
/// and how long tracing and all else take.
template <class MakeImage>
void timeImages(benchmark::State& state, const MakeImage& makeImage)
{
  double tracing = 0;
  const auto start = std::chrono::steady_clock::now();
  for (auto _ : state)
  {
    tracing += makeImage();
  }
  const double all =
    std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const auto images = static_cast<double>(state.iterations());
  state.counters["images/s"] = images / all;
  state.counters["trace/ms"] = 1e3 * tracing / images;
  state.counters["other/ms"] = 1e3 * (all - tracing) / images;
}
