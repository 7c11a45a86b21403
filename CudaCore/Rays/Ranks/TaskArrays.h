// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// What a worker has been sent of the arrays that tasks point to.
#pragma once

#include "Device/UninitialisedAllocator.h"
#include "Rays/Ranks/RayMessages.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

namespace schlieren
{

class TaskArrays
{
public:
  void clear() { arrays_ = {}; }

  /// A piece of an array, with an ArrayMessage before it.
  void keep(const std::vector<char>& message)
  {
    ArrayMessage head;
    if (!read(message, head) || head.array >= arraysOfTask)
    {
      return;
    }
    Array& array = arrays_[head.array];
    if (head.first == 0)
    {
      array = {}; // first: two at once might not fit
      array.bytes.resize(static_cast<std::size_t>(head.bytes));
      array.coming = head.version;
    }
    const std::size_t count = message.size() - sizeof(head);
    if (array.coming == head.version && array.known == head.first &&
      count <= array.bytes.size() - array.known)
    {
      std::copy_n(message.begin() + sizeof(head), count,
        array.bytes.begin() + static_cast<std::ptrdiff_t>(array.known));
      array.known += count;
      array.version = array.known == array.bytes.size() ? head.version : 0;
    }
  }

  /// Makes the task's pointers point to the arrays. False where one is not there. `request`: as TraceMessage has it.
  template <class Request>
  bool bind(Request& request) const
  {
    bool isComplete = true;
    forArrays(request.task,
      [&](std::size_t n, auto*& pointer)
      {
        using Value = std::remove_reference_t<decltype(*pointer)>;
        pointer = nullptr;
        if (request.offsets[n] != nowhere)
        {
          isComplete = isComplete && arrays_[n].version == request.versions[n];
        }
        if (request.offsets[n] != nowhere && isComplete)
        {
          const void* first = arrays_[n].bytes.data();
          pointer = static_cast<Value*>(first) + request.offsets[n];
        }
      });
    return isComplete;
  }

private:
  struct Array
  {
    std::uint64_t version = 0; ///< 0: there is none, or not all of it
    std::uint64_t coming = 0;  ///< version of which there are `known` bytes
    std::size_t known = 0;
    std::vector<char, UninitialisedAllocator<char>> bytes;
  };
  std::array<Array, arraysOfTask> arrays_;
};

} // namespace schlieren
