// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Medium/Samples/Field.h"
#include "Medium/Samples/Interpolation.h"
#include "Medium/Samples/Prefilter.h"
#include "Medium/Samples/SteepestPlace.h"
#include "Medium/Tree/MediumTree.h"
#include "Types.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace schlieren
{

/// The medium: relative refractivity nu = (N - N_ref) / (1 + N_ref) ready for interpolation, and
/// where it is solid.
template <class Real>
struct Medium
{
  PaddedVolume<Real> volume;              ///< of an image
  std::vector<std::uint32_t> solid;       ///< one bit per sample, ghosts too; empty without solids
  std::unique_ptr<MediumTree<Real>> tree; ///< of a source, instead of both

  double ambient = 0;            ///< N_ref
  double largestN = 0;           ///< largest |N|: what the samples' rounding is relative to
  double rangeOfNu = 0;          ///< highest less lowest nu of the gas's samples
  double largestNu = 0;          ///< no interpolated |nu| is larger (up to the spline's overshoot)
  Vec3<double> slope{ 0, 0, 0 }; ///< no interpolated |d nu / d index| is larger, axis by axis
  SteepestPlace steepest{};      ///< box by box of 8 voxels an edge; of a tree, brick by brick

  MediumView<Real> view() const;
};

/// Builds the medium. Solids are where `field.valid` is 0 or a sample is not finite; they, and transparent
/// places, take values spread from the gas around them, so that they pull at no gradient next to them.
/// Throws Error.
template <class Real>
Medium<Real> buildMedium(const Field& field, Interpolation interpolation, int threads);

/// The medium of field.source, of which nothing but its coarsest voxels need be there yet: see refine.
template <class Real>
Medium<Real> buildTree(const Field& field, const TreeSettings& settings);

/// Makes the voxels that a view needs. Returns whether there are new ones.
template <class Real>
bool refine(Medium<Real>& medium, const Column& column, const Monitor& monitor,
  Unneeded ofOthers = Unneeded::Goes);

/// A copy of one with a tree.
template <class Real>
Medium<Real> copyOf(const Medium<Real>& medium);

/// The same with finer voxels in parts of the image of the last view: see MediumTree::refineFurther().
template <class Real>
Medium<Real> finerIn(
  Medium<Real> medium, double tolerance, std::vector<Column::Part> parts, const Monitor& monitor);

} // namespace schlieren
