// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "CellSampler.h"
#include "CellTree.h"
#include "GasBoundary.h"

#include "vtkSmartPointer.h"

#include "Schlieren.h"

#include <vector>

class vtkDataObject;
class vtkDataSet;

namespace refractivity
{

/// The refractivity of meshes, box by box, for the tracer.
class MeshSource : public schlieren::MediumSource
{
public:
  /// `leaves`: with N at their points, see prepared(). `bodies`: may be null. Throws std::runtime_error where there
  /// is no gas.
  MeshSource(const std::vector<vtkSmartPointer<vtkDataSet>>& leaves, vtkDataObject* bodies,
    Outside outside, CellTree::Reconstruction reconstruction);

  schlieren::Box bounds() const override;
  double ambient() const override;
  std::array<double, 3> voxelShape() const override;
  Content contentOf(const schlieren::Box& box) const override;
  void sample(const schlieren::Lattice& lattice, double* refractivity, schlieren::Place* places,
    float* distances) const override;

private:
  schlieren::Place placeAt(const std::array<double, 3>& point) const;

  std::vector<vtkSmartPointer<vtkDataSet>> Leaves;
  CellTree Cells;
  CellSampler Values;
  GasBoundary Boundary;
};

} // namespace refractivity
