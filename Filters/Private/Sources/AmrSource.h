// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Amr/AmrField.h"
#include "Common/WorkProgress.h"
#include "Input/FlatData.h"
#include "Schlieren.h"
#include "Walls/GasBoundary.h"

#include <memory>
#include <vector>

class vtkDataObject;

namespace filters
{

/// The refractivity of adaptive meshes with values in cells, for the tracer. Solid cells are walls
/// with the cells' edges.
class AmrSource : public schlieren::MediumSource
{
public:
  /// `levels`: turned if flat (see turnedAcrossZ()). `bodies`: may be null.
  AmrSource(const AmrLevels& levels, const Source& source, vtkDataObject* bodies, Outside outside,
    Tally& tally, const WorkProgress& progress = WorkProgress());

  /// Adds a field of the same blocks: `source` has its values in cells, NaN where there is none.
  void addField(const AmrLevels& levels, const Source& source);

  bool hasGas() const { return this->Refractivity.ownCells() > 0; }
  /// Returns whether bodies meet the bounds of the gas.
  bool meetsBodies() const { return this->Boundary->hasBodiesIn(this->bounds()); }

  schlieren::Box bounds() const override { return this->Refractivity.bounds(); }
  double ambient() const override { return weightedMedian(this->Refractivity.outerValues()); }
  std::array<double, 3> voxelShape() const override { return this->Refractivity.voxelShape(); }
  bool isFlat() const override { return this->Refractivity.flatAxis() >= 0; }
  std::array<double, 9> direction() const override
  {
    return directionAcross(this->Refractivity.flatAxis());
  }
  Content contentOf(const schlieren::Box& box) const override;
  void sample(const schlieren::Lattice& lattice, double* refractivity, schlieren::Place* places,
    float* distances) const override;
  bool dependsOnLattice() const override { return true; }

  int fields() const override { return static_cast<int>(this->Fields.size()); }
  FieldRange rangeOfField(int field, const schlieren::Box& box) const override;
  void sampleWithFields(const schlieren::Lattice& lattice, double* refractivity,
    schlieren::Place* places, float* distances, double* values) const override;

private:
  void sampleFields(const schlieren::Lattice& lattice, double* values) const;

  AmrField Refractivity;
  std::shared_ptr<const GasBoundary> Boundary;
  std::vector<std::unique_ptr<const AmrField>> Fields;
};

} // namespace filters
