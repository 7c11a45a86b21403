// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Cells/CellShape.h"
#include "Cells/CurvedKind.h"
#include "Common/Vectors.h"

#include "vtkGenericCell.h"
#include "vtkNew.h"

#include <array>
#include <memory>
#include <vector>

class vtkDataSet;

namespace filters
{

/// Locates points in one 3-D cell at a time, and interpolates there: in any cell, so that few need
/// it (see CellSampler). For one thread.
class MeshCell
{
public:
  void set(vtkDataSet* data, vtkIdType cell);

  /// Returns whether the cell contains `x`, with tolerance; then sets its parametric coordinates,
  /// and how far the worst one is outside of its range.
  bool find(const double x[3], double coordinates[3], double& outside);

  /// Returns whether the derivatives of coordinates span volumes of both signs at the points of a
  /// curved cell. Those below `smallest`, relative to the largest one, have none.
  bool isFolded(double smallest);

  /// Interpolates at a point that find() has found.
  double valueAt(const double x[3], const double coordinates[3], const double* values);

private:
  void setPoints();
  void startInTheMiddle();
  bool iterate(const Vector& x);
  void evaluate(Vector& x, Vector columns[3]);
  bool isAt(const Vector& x, Vector& step);
  double missOf(const double coordinates[3]) const;
  bool isPolynomial() const { return this->Kind && this->Kind->isUsable; }

  vtkNew<vtkGenericCell> Cell;
  vtkDataSet* Data = nullptr;
  vtkIdType Number = -1;
  CellShape Shape = CellShape::Other;     // of its corners; Other: located by VTK
  std::shared_ptr<const CurvedKind> Kind; // of curved cells
  std::vector<double> Rational;           // weights of the points

  // State of find().
  bool HasPoints = false, IsWarm = false;
  std::vector<Vector> Points;                      // relative to the first one
  std::vector<std::array<double, 4>> Coefficients; // of polynomials: x, y, z, and the weight
  Vector Origin{};
  double Length = 0;
  double Place[3];
  std::vector<double> Weights, Derivatives;
};

} // namespace filters
