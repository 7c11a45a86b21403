// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Sources/Revolution.h"

#include "Schlieren.h"

#include <array>
#include <cstddef>
#include <memory>
#include <vector>

namespace filters
{

/// The refractivity of a body of revolution from the source of a section, the plane of its axis on
/// both sides: that at (x, r) for points (x, y, z), interpolated between rows of equal r.
class RevolvedSource : public schlieren::MediumSource
{
public:
  RevolvedSource(
    std::shared_ptr<const schlieren::MediumSource> section, const Revolution& revolution);

  const schlieren::MediumSource* section() const { return this->Section.get(); }

  schlieren::Box bounds() const override { return this->Of.box(); }
  double ambient() const override { return this->Section->ambient(); }
  std::array<double, 3> voxelShape() const override;
  Content contentOf(const schlieren::Box& box) const override;
  void sample(const schlieren::Lattice& lattice, double* refractivity, schlieren::Place* places,
    float* distances) const override;
  bool dependsOnLattice() const override { return true; } // distances of rows depend on it

private:
  struct Rows;

  schlieren::Box sectionOf(const schlieren::Box& box) const;
  Rows rowsFor(const schlieren::Lattice& lattice, double spacing, double nearest, double farthest,
    bool hasDistances) const;

  std::shared_ptr<const schlieren::MediumSource> Section;
  Revolution Of;
  std::size_t Along, Away; // axes of the section along the axis of revolution, and across it
  schlieren::Box BoundsOfSection;
};

} // namespace filters
