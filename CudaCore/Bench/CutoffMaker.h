// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Optics/Cutoffs.h"
#include "Schlieren.h"

#include <memory>
#include <vector>

namespace schlieren
{

/// Makes cutoffs, and owns the tables that they look up.
class CutoffMaker
{
public:
  CutoffMaker() = default;
  CutoffMaker(const CutoffMaker&) = delete;
  CutoffMaker& operator=(const CutoffMaker&) = delete;

  /// The cutoff of a scene that has been validated, for pixels of pixelSize data units. Its table is valid
  /// until the next call. Of a camera in front of a background, the pattern there.
  Cutoffs cutoffOf(const Scene& scene, double k, double pixelSize);

private:
  Cutoffs patternOf(const Scene& scene, double pixelSize);
  Cutoffs interferogram(const Scene& scene, double pixelSize);
  Table linearImage(const std::shared_ptr<const RgbImage>& image);

  std::vector<float> table_;
  std::shared_ptr<const RgbImage> image_; ///< that table_ was made of, or null
};

} // namespace schlieren
