// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Common/WorkProgress.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace filters
{

/// Sorts in several threads: chunks of fixed size, which pairs of them are then merged from. (With
/// VTK's own threads vtkSMPTools::Sort() uses one.)
template <class Entry>
void sortInParallel(std::vector<Entry>& entries, const WorkProgress& progress = WorkProgress())
{
  constexpr std::size_t part = 1 << 15;
  const std::size_t count = entries.size();
  const auto at = [&](std::size_t i)
  { return entries.begin() + static_cast<std::ptrdiff_t>(std::min(i, count)); };
  const auto forParts = [&](std::size_t length, const auto& work)
  {
    vtkSMPTools::For(0, static_cast<vtkIdType>((count + length - 1) / length), 1,
      [&](vtkIdType begin, vtkIdType end)
      {
        for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i)
        {
          work(i * length);
        }
      });
  };
  forParts(part, [&](std::size_t first) { std::sort(at(first), at(first + part)); });
  progress.reach(0.3);
  std::vector<Entry> merged(count > part ? count : 0);
  for (std::size_t length = part; length < count; length *= 2)
  {
    forParts(2 * length,
      [&](std::size_t first)
      {
        std::merge(at(first), at(first + length), at(first + length), at(first + 2 * length),
          merged.begin() + static_cast<std::ptrdiff_t>(first));
      });
    entries.swap(merged);
    progress.reach(1 - 0.7 * static_cast<double>(part) / static_cast<double>(length));
  }
}

} // namespace filters
