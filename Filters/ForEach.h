// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkSMPTools.h"

#include <cstddef>

namespace filters
{

/// Calls work(i) for i < count from several threads.
template <class Work>
void forEach(std::size_t count, const Work& work)
{
  vtkSMPTools::For(0, static_cast<vtkIdType>(count), 1,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i)
      {
        work(i);
      }
    });
}

} // namespace filters
