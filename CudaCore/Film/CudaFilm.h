// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Film/Film.h"
#include "Film/PixelMeans.h"
#include "Film/RayCounts.h"
#include "Film/Shading.h"
#include "Rays/CudaPass.h"

#include <cstdint>
#include <memory>

namespace schlieren
{

/// A picture that is summed up on the first CUDA device from rays that are there already, ray by ray as on
/// the CPU and without contracted multiplications, so that not a bit differs. Throws DeviceError.
class CudaFilm
{
public:
  /// Of the size and the fixed-point scale of `film`.
  explicit CudaFilm(const Film& film);
  ~CudaFilm();

  /// Adds the rays of the picture and of `margin` pixels around it to picture, means and counts. `traced`
  /// covers `held`, which has at least that margin. Defined for the cutoffs in Optics/Cutoffs.h.
  template <class CutoffKind>
  void shade(const CutoffKind& cutoff, const Projection& projection, const CudaPass& traced,
    const Pass& held, std::int64_t margin);

  /// Hands over what has been summed up.
  RayCounts develop(Film& film, PixelMeans& means) const;

private:
  struct DeviceMemory;
  std::unique_ptr<DeviceMemory> memory_;
};

} // namespace schlieren
