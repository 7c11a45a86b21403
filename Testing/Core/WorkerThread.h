// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Processes that trace rays for another one: here threads that know each other by messages alone.
#pragma once

#include "Rays/RayWorker.h"
#include "Rays/TeamMessages.h"

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

namespace schlieren
{

/// Messages from one thread to another.
class Mail
{
public:
  void put(std::vector<char> message)
  {
    const std::lock_guard<std::mutex> guard(lock_);
    messages_.push_back(std::move(message));
    arrived_.notify_one();
  }
  bool isEmpty() const
  {
    const std::lock_guard<std::mutex> guard(lock_);
    return messages_.empty();
  }
  std::vector<char> take()
  {
    std::unique_lock<std::mutex> guard(lock_);
    arrived_.wait(guard, [this] { return !messages_.empty(); });
    std::vector<char> message = std::move(messages_.front());
    messages_.pop_front();
    return message;
  }

private:
  mutable std::mutex lock_;
  std::condition_variable arrived_;
  std::deque<std::vector<char>> messages_;
};

/// One end of a connection.
class End : public Channel
{
public:
  End(Mail& to, Mail& from, const std::atomic<bool>& isOpen)
    : to_(to)
    , from_(from)
    , isOpen_(isOpen)
  {
  }
  void send(std::vector<char> message) override
  {
    sent_ += message.size();
    to_.put(std::move(message));
  }
  /// As if this end passed it on to the others.
  void sendWith(const std::vector<Channel*>& others, std::vector<char> message) override
  {
    for (Channel* other : others)
    {
      static_cast<End*>(other)->to_.put(message);
    }
    send(std::move(message));
  }
  std::size_t sent() const { return sent_; } ///< bytes
  bool hasMessage() override { return !from_.isEmpty(); }
  std::vector<char> receive() override { return from_.take(); }
  bool isOpen() const override { return isOpen_; }

private:
  Mail& to_;
  Mail& from_;
  const std::atomic<bool>& isOpen_;
  std::size_t sent_ = 0;
};

/// A worker in a thread of its own.
class Worker
{
public:
  /// What goes wrong, once so many messages with tiles have come.
  enum class Fault
  {
    None,
    Forgets,         ///< the arrays
    Leaves,          ///< without an answer
    LosesEverything, ///< that it is sent from then on, but says so
    HasOtherDevice   ///< than the first process
  };
  explicit Worker(Fault fault = Fault::None, int after = 0)
    : fault_(fault)
    , after_(after)
    , thread_([this] { work(); })
  {
  }
  ~Worker()
  {
    toWorker_.put({});
    thread_.join();
  }
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  Channel* channel() { return &here_; }
  std::size_t bytesSent() const { return here_.sent(); } ///< by the process that it works for
  int arrays() const { return arrays_; }                 ///< that it was sent
  int tiles() const { return tiles_; }                   ///< messages with tiles

private:
  void work()
  {
    End there(fromWorker_, toWorker_, isOpen_);
    auto worker = std::make_unique<RayWorker>();
    for (;;)
    {
      std::vector<char> message = there.receive();
      if (message.empty())
      {
        break;
      }
      const std::uint32_t kind = RayWorker::kindOf(message);
      const bool isArray = kind == RayWorker::Array;
      arrays_ += isArray ? 1 : 0;
      tiles_ += isArray || kind == RayWorker::AskDevice ? 0 : 1;
      if (kind == RayWorker::AskDevice && fault_ == Fault::HasOtherDevice)
      {
        there.send(messageOf(DeviceMessage{ RayWorker::DeviceIs, 75 }));
        continue;
      }
      const bool isFaulty = tiles_ > after_;
      if (fault_ == Fault::Leaves && isFaulty)
      {
        isOpen_ = false;
      }
      if (!isOpen_ || (fault_ == Fault::LosesEverything && isFaulty && isArray))
      {
        continue;
      }
      if ((fault_ == Fault::Forgets && tiles_ == after_ + 1) ||
        (fault_ == Fault::LosesEverything && isFaulty))
      {
        worker = std::make_unique<RayWorker>();
      }
      worker->answer(std::move(message), there, 2);
    }
  }

  Mail toWorker_, fromWorker_;
  std::atomic<bool> isOpen_{ true };
  std::atomic<int> arrays_{ 0 }, tiles_{ 0 };
  Fault fault_;
  int after_;
  End here_{ toWorker_, fromWorker_, isOpen_ };
  std::thread thread_;
};

} // namespace schlieren
