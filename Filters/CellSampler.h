// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "CellTree.h"

#include "Medium/MediumSource.h"

namespace refractivity
{

/**
 * What meshes hold at their points, interpolated in their cells to the points of lattices.
 *
 * Cells look for the points that they hold. Of several cells that hold a point the one that holds it best
 * counts (see MeshCell::find), of these the first. So what a point gets does not depend on the lattice,
 * rounding apart. May be used from many threads at once.
 */
class CellSampler
{
public:
  /// The tree must outlive this.
  explicit CellSampler(const CellTree& tree);

  /// Sets `values` and `found`, 1 or 0, at all points of a lattice; values are 0 where no cell is.
  void sample(const schlieren::Lattice& lattice, double* values, unsigned char* found) const;

private:
  const CellTree& Tree;
};

} // namespace refractivity
