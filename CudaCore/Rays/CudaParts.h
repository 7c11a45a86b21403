// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Device/CudaBuffer.h"
#include "Medium/TreeParts.h"
#include "Rays/CudaTracer.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace schlieren
{

/// A tree on a device that has memory for a part of its bricks: one part after the other takes the same place. Throws
/// DeviceError.
template <class Real>
class CudaParts
{
public:
  /// `medium`, which must outlive it, is a tree. `bytes`: of the device's memory for the bricks of a part; more, if there is
  /// a larger brick. `along`: the direction of light.
  CudaParts(const MediumArrays<Real>& medium, const Vec3<double>& along, std::size_t bytes);

  /// What the device needs for all of a tree but its bricks.
  static std::size_t bytesOfStructure(const MediumArrays<Real>& medium);
  static std::size_t bytesOfBricks(const MediumArrays<Real>& medium);

  std::int32_t count() const { return parts_.count(); }
  /// Sends the bricks of a part, and leaves: those of other parts are not resident, their `brick` is ~part.
  void load(std::int32_t part);
  const MediumView<Real>& view() const
  {
    return view_;
  } ///< on the device, of the part that is there

private:
  const MediumArrays<Real>& medium_;
  TreeParts parts_;
  std::vector<Leaf<Real>> leaves_; ///< as they are sent
  std::int32_t loaded_ = TreeParts::none;
  CudaBuffer<char> bricks_; ///< samples, then maps
  CudaBuffer<Leaf<Real>> leavesOnDevice_;
  CudaBuffer<std::int32_t> roots_, children_;
  MediumView<Real> view_;
};

} // namespace schlieren
