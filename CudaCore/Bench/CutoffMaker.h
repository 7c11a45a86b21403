// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Optics/Cutoffs.h"
#include "Schlieren.h"

#include <array>
#include <memory>
#include <vector>

namespace schlieren
{

/// What the pixels of an image show.
struct PixelPlaces
{
  double size; ///< data units of the image
  /// Of what is behind the flow: data units, and where its u = v = 0 is, pixels from the centre of pixel (0, 0).
  double sizeBehind = size;
  std::array<double, 2> zeroBehind{ 0, 0 };
};

/// Makes cutoffs, and owns the tables that they look up.
class CutoffMaker
{
public:
  CutoffMaker() = default;
  CutoffMaker(const CutoffMaker&) = delete;
  CutoffMaker& operator=(const CutoffMaker&) = delete;

  /// The cutoff of a scene that has been validated. Its table is valid until the next call. Of a camera in front of a
  /// background, the pattern there.
  Cutoffs cutoffOf(const Scene& scene, double k, const PixelPlaces& pixels);

private:
  Cutoffs patternOf(const Scene& scene, const PixelPlaces& pixels);
  Cutoffs interferogram(const Scene& scene, double pixelSize);
  Table linearImage(const std::shared_ptr<const RgbImage>& image);

  std::vector<float> table_;
  std::shared_ptr<const RgbImage> image_; ///< that table_ was made of, or null
};

} // namespace schlieren
