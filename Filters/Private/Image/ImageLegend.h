// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Image/ImageOutput.h"

class vtkImageData;
struct SchlierenSettings;

namespace schlieren
{
struct Image;
struct Scene;
} // namespace schlieren

namespace filters
{

/// Adds to the image's field data what a legend shows, see vtkSchlierenFilter. `isKept`: k is that of an earlier image;
/// `colors`: how the image's light becomes bytes.
void addLegend(vtkImageData* output, const SchlierenSettings& settings,
  const schlieren::Scene& scene, const schlieren::Image& image, bool isKept, ColorScale colors);

} // namespace filters
