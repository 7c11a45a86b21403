// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Medium/Tree/Brick.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace schlieren
{

/// What is known of a brick before it is sampled.
template <class Real>
struct BrickMaker<Real>::Outline
{
  Box box; ///< with its apron
  MediumSource::Content content;
  double lowest, highest; ///< nu of its data
  bool hasEdges;
  bool isSampled;    ///< false: `brick` is all there is to it
  Brick<Real> brick; ///< as yet
};

/// Bricks that are sampled together, with one lattice.
template <class Real>
struct BrickMaker<Real>::Sampled
{
  NodePlace first;                   ///< the node where the lattice begins
  std::array<std::int32_t, 3> nodes; ///< along each axis
  bool hasEdges;                     ///< any of them
  std::vector<std::size_t> bricks;   ///< which requests
};

/// What the source says of their lattice.
template <class Real>
struct BrickMaker<Real>::Values
{
  Lattice lattice;
  std::vector<double> nu;
  std::vector<Place> places;
  std::vector<float> distances; ///< empty: no edges
};

} // namespace schlieren
