// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Film/Exposure.h"
#include "Film/Image.h"
#include "Rays/CudaPass.h"

#include <cstdint>
#include <memory>

namespace schlieren
{

/// An image that is summed up on the CUDA device, from rays that lie there. Not a bit differs from
/// that of expose() and of CentreValues: sums of light are whole numbers, and each pixel's rays are added up in
/// the order of the passes. Throws DeviceError.
class CudaFilm
{
public:
  /// Has as many planes as `films`, of their size and fixed-point scale. `raysPerBand`: so many
  /// are shaded, then deposited on the film, at a time, or some rows where these are more.
  explicit CudaFilm(const Films& films, std::int64_t raysPerBand = std::int64_t{ 1 } << 20);
  ~CudaFilm();

  /// Does what schlieren::expose does, and adds up counts and what pixels' rays carry, for rays that lie there: `traced`
  /// covers `pass`.
  void expose(const CudaPass& traced, const Pass& pass, const Cutoffs& cutoff,
    const Projection& projection, std::int64_t margin);

  /// Hands over the light that has been added up.
  RayCounts develop(Films& films) const;
  /// Writes into the image what light carries at the pixels' centres.
  void developCentres(Image& image) const;

private:
  struct DeviceMemory;
  std::unique_ptr<DeviceMemory> memory_;
};

} // namespace schlieren
