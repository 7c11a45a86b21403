// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <utility>

namespace filters
{

/// Calls a function at the end of a scope.
class AtTheEnd
{
public:
  explicit AtTheEnd(std::function<void()> work)
    : Work(std::move(work))
  {
  }
  ~AtTheEnd() { this->Work(); }
  AtTheEnd(const AtTheEnd&) = delete;
  AtTheEnd& operator=(const AtTheEnd&) = delete;

private:
  const std::function<void()> Work;
};

} // namespace filters
