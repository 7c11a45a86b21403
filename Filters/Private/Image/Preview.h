// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Schlieren.h"

namespace filters
{

/// Makes previews: images of the same view with fewer pixels and one ray for each. `reduction`:
/// pixels of the full image for each pixel of the preview, along each axis.

/// Returns the pixels along a side of the preview, at least 1.
int previewPixels(int pixels, int reduction);

/// Returns the view of the preview: exact along one axis; along the other, up to one pixel larger
/// if `reduction` does not divide the pixels. `frame`: that of the full image.
schlieren::View previewView(
  const schlieren::View& view, const schlieren::Frame& frame, int reduction);

/// Returns a reduction for a first preview without noticeable delay.
int reductionAtFirst(const schlieren::View& view);

/// Changes a full image's scene to that of the preview. Lengths in pixels keep their size in data
/// units; an automatic background's period remains resolved.
void makePreview(schlieren::Scene& scene, const schlieren::Frame& frame, int reduction);

} // namespace filters
