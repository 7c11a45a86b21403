// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Schlieren.h"

namespace filters
{

/// For a window to show while things move: an image that lies where the whole one does, with fewer pixels and
/// one ray for each. `reduction`: pixels of the whole image, along each axis, that one of it stands for.

/// Pixels along a side of the preview, at least 1.
int previewPixels(int pixels, int reduction);

/// Its view: the same place, exactly along one axis; along the other, where `reduction` does not divide the
/// pixels, up to a pixel more. `frame`: that of the whole image.
schlieren::View previewView(
  const schlieren::View& view, const schlieren::Frame& frame, int reduction);

/// For a first one that takes no noticeable time.
int reductionAtFirst(const schlieren::View& view);

/// Makes of a whole image's scene that of the preview. What counts in pixels keeps its size in data
/// units; but a background whose period is left to the filter stays coarse enough to be seen.
void makePreview(schlieren::Scene& scene, const schlieren::Frame& frame, int reduction);

} // namespace filters
