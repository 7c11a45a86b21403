// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Common/Triangles.h"

#include <cstdint>
#include <vector>

class vtkDataObject;

namespace filters
{

/// Bodies in the gas, given by surfaces (vtkPolyData, or a composite of them).
class BodySurfaces
{
public:
  /// Throws std::runtime_error for data other than surfaces.
  explicit BodySurfaces(vtkDataObject* bodies);
  BodySurfaces(const BodySurfaces&) = delete;
  BodySurfaces& operator=(const BodySurfaces&) = delete;

  /// Normals of closed parts point outward, if their triangles are all turned alike. Parts that
  /// enclose nothing are not closed.
  const Triangles& surface() const { return this->Surface; }
  const TriangleTree& tree() const { return this->Tree; }
  bool isOfClosed(std::int32_t triangle) const
  {
    return this->Parts[static_cast<std::size_t>(triangle)] >= 0;
  }

  /// Sets isInside[...] for the lattice points inside a closed part: those with an odd number of
  /// crossings before them along x (Nooruddin & Turk 2003). Parts may overlap or enclose each
  /// other.
  void findInside(const schlieren::Lattice& lattice, std::vector<unsigned char>& isInside) const;
  bool isInside(const Point& place) const;

private:
  Triangles Surface;
  std::int32_t NumberOfParts = 0;  // closed ones
  std::vector<std::int32_t> Parts; // of each triangle; -1: open
  TriangleTree Tree;
};

} // namespace filters
