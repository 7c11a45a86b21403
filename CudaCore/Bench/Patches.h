// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Bench/Scouts.h"
#include "Schlieren.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace schlieren
{

/// A rectangle of pixels on the film, and the one around which the rays start that land there.
struct Patch
{
  std::int64_t column, row; ///< its lower left pixel
  double weight;            ///< how many pixels of the image each of its own stands for
  std::int64_t fromColumn, fromRow;
  std::int64_t margin = 0; ///< pixels around that
  std::int64_t columns = edge, rows = edge;

  static constexpr std::int64_t edge = 4; ///< pixels, but for a patch that is the whole image
};
using PatchList = std::vector<Patch>;

/// Where a patch lies.
enum class PatchPlace
{
  Body,
  Border, ///< of the data
  Elsewhere
};
constexpr std::size_t patchPlaces = 3;

/// Some thousand pixels, by place.
using PatchSet = std::array<PatchList, patchPlaces>;

/// Two sets of patches that have no pixel in common. They are closer together where the few pixels are that have the largest
/// errors: beside bodies, and where rays differ most from their neighbours. Where light is displaced all over the image there
/// is one patch, the image, which counts as one at a body.
struct PatchLayout
{
  PatchSet sets[2];
  PatchSet ofVoxels;     ///< those that are looked at with finer voxels: some of both sets
  PatchSet someOfVoxels; ///< a third of these
  bool isWhole = false;  ///< both sets are the image, set 0
};

/// `margin`: pixels around the image from which light may be bent into it.
PatchLayout layOutPatches(const Scouts& scouts, const View& view, std::int64_t margin);

} // namespace schlieren
