// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Schlieren.h"

namespace filters
{

/// The mean of images of the same size: what a film has summed up of all of them. The mean of equal images is that
/// image, to the last bit.
class MeanImage
{
public:
  void Add(schlieren::Image&& image);
  schlieren::Image Take(); ///< and nothing is left

private:
  schlieren::Image Mean;
  int Images = 0;
};

} // namespace filters
