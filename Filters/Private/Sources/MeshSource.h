// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Cells/CellSampler.h"
#include "Cells/CellTree.h"
#include "Cells/FieldsOfMesh.h"
#include "Cells/LatticesOfMesh.h"
#include "Input/FlatData.h"
#include "Walls/GasBoundary.h"

#include "vtkSmartPointer.h"

#include "Schlieren.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

class vtkDataObject;
class vtkDataSet;

namespace filters
{

/// State of a MeshSource that depends on the mesh alone, kept between time steps. It needs no
/// dataset.
struct SourceMesh
{
  std::shared_ptr<const CellTree::Mesh> cells;
  std::shared_ptr<const GasBoundary> boundary;
  std::shared_ptr<LatticesOfMesh> lattices; // null in the first time step
};

std::vector<vtkDataSet*> pointersTo(const std::vector<vtkSmartPointer<vtkDataSet>>& leaves);

/// Returns the bounds of visible cells; with hidden cells, which are bodies, those of all points.
schlieren::Box boundsOf(
  const CellTree& cells, const std::vector<vtkSmartPointer<vtkDataSet>>& leaves);

/// The refractivity of meshes, for bricks of the tracer.
class MeshSource : public schlieren::MediumSource
{
public:
  /// `leaves`: with N at their points, see preparedLeaves(). `bodies`: may be null. `flatAxis`: the
  /// axis across which both were flat (see extruded()), or -1.
  MeshSource(const std::vector<vtkSmartPointer<vtkDataSet>>& leaves, vtkDataObject* bodies,
    Outside outside, CellTree::Reconstruction reconstruction, const WorkProgress& progress,
    int flatAxis = -1);

  /// Makes the source of other values on the same mesh: see keyOf().
  MeshSource(const std::vector<vtkSmartPointer<vtkDataSet>>& leaves, const SourceMesh& mesh,
    const WorkProgress& progress, int flatAxis = -1);
  SourceMesh mesh() const { return { this->Cells.mesh(), this->Boundary, this->Lattices }; }

  /// Returns whether sheets, which are found by values, are equal for the values of these leaves.
  static bool hasSameSheets(
    const SourceMesh& mesh, const std::vector<vtkSmartPointer<vtkDataSet>>& leaves);

  /// Hashes what the mesh of a source depends on, except sheets.
  static std::uint64_t keyOf(const std::vector<vtkSmartPointer<vtkDataSet>>& leaves,
    vtkDataObject* bodies, Outside outside, CellTree::Reconstruction reconstruction);

  /// Adds a field: `leaves` as in the constructor, with the field at their points; NaN: no value.
  void addField(const std::vector<vtkSmartPointer<vtkDataSet>>& leaves,
    const WorkProgress& progress = WorkProgress());

  bool hasGas() const { return this->Cells.size() > 0; }
  /// Returns whether bodies meet the bounds of the gas.
  bool meetsBodies() const;

  schlieren::Box bounds() const override;
  double ambient() const override;
  std::array<double, 3> voxelShape() const override;
  bool isFlat() const override { return this->FlatAxis >= 0; }
  std::array<double, 9> direction() const override { return directionAcross(this->FlatAxis); }
  Content contentOf(const schlieren::Box& box) const override;
  void sample(const schlieren::Lattice& lattice, double* refractivity, schlieren::Place* places,
    float* distances) const override
  {
    this->sampleWithFields(lattice, refractivity, places, distances, nullptr);
  }

  bool dependsOnLattice() const override { return true; } // within rounding
  int fields() const override { return this->Fields.count(); }
  FieldRange rangeOfField(int field, const schlieren::Box& box) const override
  {
    return this->Fields.rangeOf(field, box);
  }
  void sampleWithFields(const schlieren::Lattice& lattice, double* refractivity,
    schlieren::Place* places, float* distances, double* values) const override;

private:
  std::vector<vtkSmartPointer<vtkDataSet>> Leaves;
  CellTree Cells;
  CellSampler Values;
  std::shared_ptr<const GasBoundary> Boundary;
  std::shared_ptr<LatticesOfMesh> Lattices;
  int FlatAxis;
  double Ambient; // NaN: no boundary
  schlieren::Box Bounds;

  FieldsOfMesh Fields;
};

} // namespace filters
