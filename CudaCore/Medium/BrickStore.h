// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

namespace schlieren
{

/// Memory of bricks and of maps of walls, each in one piece and addressed by its number.
template <class Real>
class BrickStore
{
public:
  /// `usual`: bytes that there may be of it all.
  BrickStore(std::int64_t samplesPerBrick, std::size_t usual);

  /// Brick 0 remains, with zeros.
  void clear();

  std::int32_t addBrick(const std::vector<Real>& samples);
  std::int32_t addMap(const std::vector<std::int16_t>& distances);
  void removeBrick(std::int32_t brick) { freeBricks_.push_back(brick); }
  void removeMap(std::int32_t map) { freeMaps_.push_back(map); }

  /// Keeps those that are named, in this order; brick 0 is among them, as the first.
  void arrange(const std::vector<std::int32_t>& bricks, const std::vector<std::int32_t>& maps);

  const std::vector<Real>& samples() const { return samples_; }
  const std::vector<std::int16_t>& gasDistances() const { return gasDistances_; }
  std::size_t bytesUsed() const;
  std::size_t bytesOfBrick() const { return perBrick_ * sizeof(Real); }
  std::size_t bytesOfMap() const { return perBrick_ * sizeof(std::int16_t); }

private:
  void reserve(std::size_t samples);

  std::size_t perBrick_;
  std::size_t usual_;
  std::vector<Real> samples_;
  std::vector<std::int16_t> gasDistances_;
  std::vector<std::int32_t> freeBricks_, freeMaps_;
};

} // namespace schlieren
