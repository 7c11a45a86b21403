// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// One node of the medium's tree: the gradients of the fields that rays gather there.
#pragma once

#include "Medium/Samples/Leaves.h"
#include "Medium/Samples/MediumSource.h"

#include <array>
#include <vector>

namespace schlieren
{

/// Says by how much a node is too coarse for its fields. All of what a ray gathers of them, of all together.
struct FieldFacts
{
  /// Error because samples are as far apart as they are; 0 along an axis on which the cells are no finer.
  std::array<double, 3> error{ 0, 0, 0 };
  /// Error because of what lies between samples that are further apart than cells along this axis.
  std::array<double, 3> hidden{ 0, 0, 0 };
  double range = 0;     ///< of the samples, as what a ray may gather
  double neglected = 0; ///< the same, where nothing was made of it
};

struct FieldBrick
{
  /// Gradients as FieldGradients::values, laid out like the samples of a brick: by the smallest spacing of the tree's
  /// coarsest voxels. Empty: all are 0.
  std::vector<float> gradients;
  FieldFacts facts;
};

/// Values of fields at n^3 points around a node, or at n^2 of one layer.
struct FieldSamples
{
  std::array<double, 3> voxel;
  BrickShape shape = BrickShape::Cube;
  int n = 0;
  int margin = 0;             ///< points beyond the node, more than the apron of what is made
  std::vector<double> values; ///< field after field
};

/// What the fields of a source may let a ray gather in a box, at most.
double largestGathered(const MediumSource& source, const Box& box);

/// `isGas`: which points count; empty: all. Gradients are central differences, one-sided ones beside points that do not
/// count, and the mean of the neighbours' where these are no gas; 0 where a field has no value. They are by `unit`.
/// Makes the gradients of a node, none where they are `negligible`.
FieldBrick fieldBrickOf(const MediumSource& source, const Box& box, const FieldSamples& samples,
  const std::vector<unsigned char>& isGas, const std::array<double, 3>& cellSize, int apron,
  double unit, double negligible);

} // namespace schlieren
