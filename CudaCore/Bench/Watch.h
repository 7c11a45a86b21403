// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Types.h"

namespace schlieren
{

/// A monitor whose answers are the last ones: once it has said stop, it does.
class Watch
{
public:
  explicit Watch(const Monitor& request)
  {
    monitor_.progress = request.progress;
    if (request.aborted)
    {
      monitor_.aborted = [this, &request] { return isAborted_ = isAborted_ || request.aborted(); };
    }
    if (request.paused)
    {
      monitor_.paused = [this, &request] { return isPaused_ = isPaused_ || request.paused(); };
    }
  }
  Watch(const Watch&) = delete;
  Watch& operator=(const Watch&) = delete;

  const Monitor& monitor() const { return monitor_; }
  bool mayPause() const { return static_cast<bool>(monitor_.paused); }
  bool isAborted() const { return monitor_.aborted && monitor_.aborted(); }
  bool isPaused() const { return monitor_.paused && monitor_.paused(); }

private:
  Monitor monitor_;
  bool isAborted_ = false;
  bool isPaused_ = false;
};

} // namespace schlieren
