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

/// What of a MeshSource depends on the mesh alone, and not on its values: it is kept from one time step to the next.
/// It needs no dataset.
struct SourceMesh
{
  std::shared_ptr<const CellTree::Mesh> cells;
  std::shared_ptr<const GasBoundary> boundary;
  std::shared_ptr<LatticesOfMesh> lattices; // null: as yet there has been one step only
};

std::vector<vtkDataSet*> pointersTo(const std::vector<vtkSmartPointer<vtkDataSet>>& leaves);

/// Of visible cells; and, where not all are, of all points: hidden cells are bodies also where the mesh ends.
schlieren::Box boundsOf(
  const CellTree& cells, const std::vector<vtkSmartPointer<vtkDataSet>>& leaves);

/// The refractivity of meshes, box by box, for the tracer.
class MeshSource : public schlieren::MediumSource
{
public:
  /// `leaves`: with N at their points, see preparedLeaves(). `bodies`: may be null. `flatAxis`: -1, or that across which
  /// both were flat (see extruded()).
  MeshSource(const std::vector<vtkSmartPointer<vtkDataSet>>& leaves, vtkDataObject* bodies,
    Outside outside, CellTree::Reconstruction reconstruction, const WorkProgress& progress,
    int flatAxis = -1);

  /// Of other values on the same mesh: see keyOf().
  MeshSource(const std::vector<vtkSmartPointer<vtkDataSet>>& leaves, const SourceMesh& mesh,
    const WorkProgress& progress, int flatAxis = -1);
  SourceMesh mesh() const { return { this->Cells.mesh(), this->Boundary, this->Lattices }; }

  /// Whether walls without thickness, which are known by values, are the same with the values of these leaves.
  static bool hasSameSheets(
    const SourceMesh& mesh, const std::vector<vtkSmartPointer<vtkDataSet>>& leaves);

  /// A hash of all that the mesh of a source depends on, but those sheets.
  static std::uint64_t keyOf(const std::vector<vtkSmartPointer<vtkDataSet>>& leaves,
    vtkDataObject* bodies, Outside outside, CellTree::Reconstruction reconstruction);

  /// One more field: `leaves` as those of the constructor, with the field at their points; NaN where it has no value.
  void addField(const std::vector<vtkSmartPointer<vtkDataSet>>& leaves,
    const WorkProgress& progress = WorkProgress());

  bool hasGas() const { return this->Cells.size() > 0; }
  /// Whether the bodies reach into the box of the gas.
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

  bool dependsOnLattice() const override { return true; } // by rounding
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
  double Ambient; // NaN: there is no boundary
  schlieren::Box Bounds;

  FieldsOfMesh Fields;
};

} // namespace filters
