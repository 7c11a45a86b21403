// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace schlieren
{

/// A connection to another process of the same program on the same kind of processor. Messages arrive complete and in
/// order. It is used by one thread.
class Channel
{
public:
  Channel() = default;
  Channel(const Channel&) = delete;
  Channel& operator=(const Channel&) = delete;
  virtual ~Channel() = default;

  /// Of a small message, returns at once; of a large one, when the other process has received it.
  virtual void send(std::vector<char> message) = 0;
  /// The same to several, this one and others of its kind, which may pass it on to each other.
  virtual void sendWith(const std::vector<Channel*>& others, std::vector<char> message)
  {
    for (Channel* other : others)
    {
      other->send(message);
    }
    send(std::move(message));
  }
  /// Whether a message has arrived. Does not wait.
  virtual bool hasMessage() = 0;
  /// The next message, once there is one.
  virtual std::vector<char> receive() = 0;
  /// False once the other process has left: it answers nothing any more.
  virtual bool isOpen() const = 0;

  /// Its own: no channel of this process has had it before.
  std::uint64_t number() const { return number_; }

private:
  static std::uint64_t nextNumber()
  {
    static std::atomic<std::uint64_t> last{ 0 };
    return ++last;
  }
  const std::uint64_t number_ = nextNumber();
};

} // namespace schlieren
