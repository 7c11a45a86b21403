// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rays/BrickChannels.h"

#include "Rays/DistributedRays.h"
#include "Schlieren.h"

#include <chrono>
#include <cstring>
#include <string>
#include <thread>

namespace schlieren
{

void throwAbsentOwner(std::int32_t owner)
{
  throw Error("Rank " + std::to_string(owner) +
    " does not answer, or has not enough memory for its part of the medium, which no other rank "
    "has. See what that rank has reported, then update again, or switch Distributed Medium off.");
}

void BrickChannels::begin(const BrickLayout& layout, std::size_t bytesOfReal)
{
  layout_ = layout;
  bytesOfReal_ = static_cast<std::uint32_t>(bytesOfReal);
  tree_ = newNumber();
  puts_.assign(channels_.size(), 0);
  for (std::int32_t owner = 1; owner < count(); ++owner)
  {
    put(owner, DeliveredBricks<float>{}.toBytes()); // no bricks: the same of doubles
  }
}

void BrickChannels::put(std::int32_t owner, const std::vector<char>& bricks)
{
  Channel& channel = *channels_[static_cast<std::size_t>(owner - 1)];
  if (!channel.isOpen())
  {
    throwAbsentOwner(owner);
  }
  BricksMessage head;
  head.bytesOfReal = bytesOfReal_;
  head.number = puts_[static_cast<std::size_t>(owner - 1)]++;
  head.tree = tree_;
  head.layout = layout_;
  std::vector<char> message = messageOf(head, bricks.size());
  if (!bricks.empty())
  {
    std::memcpy(message.data() + sizeof(head), bricks.data(), bricks.size());
  }
  channel.send(std::move(message));
}

std::vector<std::vector<LeafSums>> BrickChannels::sumUp(
  const std::vector<std::vector<LeafSegment>>& ofOwners)
{
  const std::vector<std::vector<char>> answers =
    request(RayWorker::SumUp, ofOwners, sizeof(LeafSums));
  std::vector<std::vector<LeafSums>> sums(answers.size());
  for (std::size_t owner = 0; owner < answers.size(); ++owner)
  {
    sums[owner] = valuesFrom<LeafSums>(0, answers[owner]);
  }
  return sums;
}

std::vector<std::vector<char>> BrickChannels::fetch(
  const std::vector<std::vector<std::int32_t>>& ofOwners)
{
  return request(RayWorker::FetchBricks, ofOwners,
    static_cast<std::size_t>(layout_.samplesPerBrick) * bytesOfReal_);
}

/// Of each owner but this process so many bytes for each item.
template <class Item>
std::vector<std::vector<char>> BrickChannels::request(
  std::uint32_t kind, const std::vector<std::vector<Item>>& ofOwners, std::size_t bytesOfAnswer)
{
  BricksMessage head;
  head.kind = kind;
  head.bytesOfReal = bytesOfReal_;
  head.number = newNumber();
  head.tree = tree_;
  head.layout = layout_;
  for (std::size_t owner = 1; owner < ofOwners.size(); ++owner)
  {
    const std::size_t bytes = ofOwners[owner].size() * sizeof(Item);
    if (bytes > 0)
    {
      std::vector<char> message = messageOf(head, bytes);
      std::memcpy(message.data() + sizeof(head), ofOwners[owner].data(), bytes);
      channels_[owner - 1]->send(std::move(message));
    }
  }
  std::vector<std::vector<char>> answers(ofOwners.size());
  for (std::size_t owner = 1; owner < ofOwners.size(); ++owner)
  {
    Channel& channel = *channels_[owner - 1];
    const std::size_t bytes = ofOwners[owner].size() * bytesOfAnswer;
    for (bool isThere = bytes == 0; !isThere;)
    {
      if (!channel.hasMessage())
      {
        if (!channel.isOpen())
        {
          throwAbsentOwner(static_cast<std::int32_t>(owner));
        }
        std::this_thread::sleep_for(std::chrono::microseconds(20));
        continue;
      }
      std::vector<char> answer = channel.receive();
      AdvancedMessage got;
      if (!read(answer, got) || got.number != head.number)
      {
        continue; // of what has failed
      }
      if (got.kind != RayWorker::Found || answer.size() != sizeof(got) + bytes)
      {
        throwAbsentOwner(static_cast<std::int32_t>(owner));
      }
      answer.erase(answer.begin(), answer.begin() + sizeof(got));
      answers[owner] = std::move(answer);
      isThere = true;
    }
  }
  return answers;
}

} // namespace schlieren
