// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "PieceRanks.h"
#include "PieceWorker.h"

#include "Rays/Channel.h"

#include <atomic>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

namespace filters
{

/// Ranks that are queried through channels; the first one is this process.
class ChannelRanks : public PieceRanks
{
public:
  /// See PieceWorker.
  explicit ChannelRanks(vtkRefractiveIndex* self)
    : Own(self)
  {
  }

  /// To the others; null: one that is not there.
  void SetChannels(std::vector<schlieren::Channel*> channels)
  {
    this->Channels = std::move(channels);
  }
  PieceWorker& GetOwn() { return this->Own; }

  /// Whether other ranks make bricks of data that this one has alone.
  void SetHelp(bool help) { this->Help = help; }
  bool MayHelp() const override;

  std::size_t Count() const override { return this->Channels.size() + 1; }
  std::vector<std::vector<char>> Request(std::vector<std::vector<char>> requests,
    const std::function<void()>& meanwhile = nullptr) override;
  int GetThreads() const override { return this->Own.GetThreads(); }

private:
  PieceWorker Own;
  std::vector<schlieren::Channel*> Channels;
  std::atomic<bool> Help{ false };
};

} // namespace filters
