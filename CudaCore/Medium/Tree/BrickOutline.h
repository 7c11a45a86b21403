// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Medium/Tree/Brick.h"

namespace schlieren
{

/// What is known of a brick before it is sampled.
template <class Real>
struct BrickMaker<Real>::Outline
{
  Box box; ///< with its apron
  MediumSource::Content content;
  double lowest, highest; ///< nu of its data
  bool hasEdges, hasFields;
  bool isSampled;    ///< false: `brick` is all there is to it
  Brick<Real> brick; ///< as yet
};

} // namespace schlieren
