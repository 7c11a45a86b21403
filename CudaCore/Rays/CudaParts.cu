// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rays/CudaParts.h"

#include <algorithm>
#include <array>
#include <cstring>

namespace schlieren
{

namespace
{

/// Where maps begin behind samples: what any load of a kernel may be aligned to.
constexpr std::size_t alignment = 256;

std::size_t aligned(std::size_t bytes) { return (bytes + alignment - 1) / alignment * alignment; }

template <class Real>
std::size_t bytesOfSamples(const MediumArrays<Real>& medium)
{
  return static_cast<std::size_t>(medium.view.brickStride) * sizeof(Real);
}

template <class Real>
std::size_t bytesOfMap(const MediumArrays<Real>& medium)
{
  return static_cast<std::size_t>(medium.view.brickStride) * sizeof(std::int16_t);
}

/// Sends pieces of the host's memory to consecutive places of the device's: while some are on their way, the next ones are
/// put together.
class Sender
{
public:
  explicit Sender(char* to)
    : to_(to)
  {
  }

  void add(const void* piece, std::size_t bytes)
  {
    const char* from = static_cast<const char*>(piece);
    while (bytes > 0)
    {
      const std::size_t here = std::min(bytes, bytesOfLot - filled_);
      std::memcpy(lots_[current_].bytes.data() + filled_, from, here);
      filled_ += here;
      from += here;
      bytes -= here;
      if (filled_ == bytesOfLot)
      {
        send();
      }
    }
  }

  /// What follows goes to another place.
  void moveTo(char* place)
  {
    send();
    to_ = place;
  }

  /// All of it is there.
  void finish()
  {
    send();
    for (const Lot& lot : lots_)
    {
      lot.stream.wait(doing);
    }
  }

private:
  static constexpr const char* doing = "Copying a part of the medium";
  static constexpr std::size_t bytesOfLot = std::size_t{ 1 } << 20;

  struct Lot
  {
    CudaHostBuffer bytes{ bytesOfLot };
    CudaStream stream;
  };

  void send()
  {
    Lot& lot = lots_[current_];
    checkCuda(
      cudaMemcpyAsync(to_, lot.bytes.data(), filled_, cudaMemcpyHostToDevice, lot.stream.get()),
      doing);
    to_ += filled_;
    filled_ = 0;
    current_ = 1 - current_;
    lots_[current_].stream.wait(doing); // before it is filled again
  }

  char* to_;
  std::array<Lot, 2> lots_;
  std::size_t current_ = 0;
  std::size_t filled_ = 0; ///< of the current one
};

} // namespace

template <class Real>
std::size_t CudaParts<Real>::bytesOfStructure(const MediumArrays<Real>& medium)
{
  return medium.leaves.count * sizeof(Leaf<Real>) +
    (medium.roots.count + medium.children.count) * sizeof(std::int32_t);
}

template <class Real>
std::size_t CudaParts<Real>::bytesOfBricks(const MediumArrays<Real>& medium)
{
  return medium.samples.count * sizeof(Real) + medium.gasDistances.count * sizeof(std::int16_t);
}

template <class Real>
CudaParts<Real>::CudaParts(
  const MediumArrays<Real>& medium, const Vec3<double>& along, std::size_t bytes)
  : medium_(medium)
  , parts_(divideTree(medium.view, medium.leaves.count, along,
      bytes - std::min(bytes, bytesOfSamples(medium) + alignment)))
  , leaves_(medium.leaves.first, medium.leaves.first + medium.leaves.count)
  // Brick 0, and one brick at least.
  , bricks_(std::max(bytes, 2 * bytesOfSamples(medium) + bytesOfMap(medium) + alignment))
  , leavesOnDevice_(medium.leaves.count)
  , roots_(medium.roots.first, medium.roots.count, "Copying the medium's tree")
  , children_(medium.children.first, medium.children.count, "Copying the medium's tree")
  , view_(medium.view)
{
  for (std::size_t leaf = 0; leaf < leaves_.size(); ++leaf)
  {
    const std::int32_t part = parts_.ofLeaf[leaf];
    leaves_[leaf].brick = part != TreeParts::none ? ~part : leaves_[leaf].brick;
  }
  checkCuda(cudaMemset(bricks_.data(), 0, bytesOfSamples(medium)), "Clearing the first brick");
  view_.leaves = leavesOnDevice_.data();
  view_.finder.roots = roots_.data();
  view_.finder.children = children_.data();
}

template <class Real>
void CudaParts<Real>::load(std::int32_t part)
{
  if (part == loaded_)
  {
    return;
  }
  if (loaded_ != TreeParts::none)
  {
    for (std::size_t n = parts_.begin(loaded_); n < parts_.end(loaded_); ++n)
    {
      leaves_[static_cast<std::size_t>(parts_.leaves[n])].brick = ~loaded_;
    }
  }
  loaded_ = TreeParts::none;

  const std::size_t ofSamples = bytesOfSamples(medium_), ofMap = bytesOfMap(medium_);
  std::vector<const char*> maps;
  std::int32_t bricks = 1;
  Sender sender(bricks_.data() + ofSamples);
  for (std::size_t n = parts_.begin(part); n < parts_.end(part); ++n)
  {
    const auto number = static_cast<std::size_t>(parts_.leaves[n]);
    const Leaf<Real>& from = medium_.leaves.first[number];
    Leaf<Real>& to = leaves_[number];
    to.brick = 0;
    if (from.brick != 0)
    {
      sender.add(medium_.samples.first + std::int64_t{ from.brick } * view_.brickStride, ofSamples);
      to.brick = bricks++;
    }
    if (from.map >= 0)
    {
      to.map = static_cast<std::int32_t>(maps.size());
      maps.push_back(reinterpret_cast<const char*>(
        medium_.gasDistances.first + std::int64_t{ from.map } * view_.brickStride));
    }
  }
  const std::size_t firstMap = aligned(static_cast<std::size_t>(bricks) * ofSamples);
  sender.moveTo(bricks_.data() + firstMap);
  for (const char* map : maps)
  {
    sender.add(map, ofMap);
  }
  sender.finish();
  checkCuda(cudaMemcpy(leavesOnDevice_.data(), leaves_.data(), leaves_.size() * sizeof(leaves_[0]),
              cudaMemcpyHostToDevice),
    "Copying the medium's leaves");

  const std::int64_t ghost = medium_.view.samples - medium_.samples.first;
  view_.samples = reinterpret_cast<const Real*>(bricks_.data()) + ghost;
  view_.gasDistances = reinterpret_cast<const std::int16_t*>(bricks_.data() + firstMap) + ghost;
  loaded_ = part;
}

template class CudaParts<float>;
template class CudaParts<double>;

} // namespace schlieren
