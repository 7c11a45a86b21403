// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Writes bricks as bytes for another rank.
#include "Medium/Tree/Brick.h"

#include "Medium/Tree/CountedBytes.h"

#include <cstring>
#include <type_traits>

namespace schlieren
{

namespace
{

/// What has one size in all bricks.
template <class Real>
struct Head
{
  typename Leaf<Real>::Kind kind;
  Real offset;
  BrickFacts facts;
};

} // namespace

template <class Real>
std::vector<char> Brick<Real>::toBytes() const
{
  const Head<Real> head{ kind, offset, facts };
  static_assert(std::is_trivially_copyable_v<Head<Real>>);
  std::vector<char> bytes(sizeof(head));
  std::memcpy(bytes.data(), &head, sizeof(head));
  appendCounted(samples, bytes);
  appendCounted(gasDistances, bytes);
  return bytes;
}

template <class Real>
Brick<Real> Brick<Real>::fromBytes(const std::vector<char>& bytes, std::size_t samplesPerBrick)
{
  Brick brick;
  Head<Real> head;
  const char* next = bytes.data();
  std::size_t left = bytes.size();
  const auto isOf = [samplesPerBrick](const auto& values)
  { return values.empty() || values.size() == samplesPerBrick; };
  bool isWhole = left >= sizeof(head);
  if (isWhole)
  {
    std::memcpy(&head, next, sizeof(head));
    next += sizeof(head);
    left -= sizeof(head);
    isWhole = takeCounted(next, left, brick.samples) &&
      takeCounted(next, left, brick.gasDistances) && left == 0 && isOf(brick.samples) &&
      isOf(brick.gasDistances);
  }
  if (!isWhole)
  {
    throw Error("Another process has sent a brick of the medium that cannot be read. Are all "
                "processes of the same version of this plugin?");
  }
  brick.kind = head.kind;
  brick.offset = head.offset;
  brick.facts = head.facts;
  return brick;
}

template struct Brick<float>;
template struct Brick<double>;

} // namespace schlieren
