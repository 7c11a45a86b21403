// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Schlieren.h"

namespace filters
{

/// Averages images of the same size. The mean of equal images is exactly equal to them.
class MeanImage
{
public:
  void Add(schlieren::Image&& image);
  schlieren::Image Take(); ///< returns the mean and clears it

private:
  schlieren::Image Mean;
  int Images = 0;
};

/// Adds the numbers of rays and steps, and the time.
void addRays(schlieren::Image& sum, const schlieren::Image& image);

} // namespace filters
