// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Cells/BasisProduct.h"
#include "Common/Vectors.h"

#include "vtkGenericCell.h"
#include "vtkIdList.h"
#include "vtkNew.h"

#include <array>
#include <vector>

class vtkDataSet;

namespace filters
{

/// Locates points in one cell at a time, and interpolates there. For one thread.
class MeshCell
{
public:
  /// `flatAxis`: the axis across 2-D cells; -1 for 3-D ones.
  explicit MeshCell(int flatAxis);

  void set(vtkDataSet* data, vtkIdType cell);

  /// Returns whether the cell contains `x`, with tolerance; then sets its parametric coordinates,
  /// and how far the worst one is outside of its range.
  bool find(const double x[3], double coordinates[3], double& outside);

  /// Returns whether the derivatives of coordinates span volumes of both signs at the points of a
  /// curved 3-D cell. Those below `smallest`, relative to the largest one, have none.
  bool isFolded(double smallest);

  /// Interpolates at a point that find() has found.
  double valueAt(const double x[3], const double coordinates[3], const double* values);

private:
  enum class Shape
  {
    Box,
    Simplex,
    Wedge,
    Other // by VTK
  };

  static Shape shapeOf(int type);
  void setPoints();
  bool isAffine() const;
  void setInverse();
  void startInTheMiddle();
  bool iterate(const Vector& x);
  void evaluate(Vector& x, Vector columns[3]);
  bool isAt(const Vector& x, Vector& step);
  double missOf(const double coordinates[3]) const;

  vtkNew<vtkGenericCell> Cell; // if VTK's functions are needed
  vtkNew<vtkIdList> Ids;
  vtkDataSet* Data = nullptr;
  vtkIdType Number = -1;
  const vtkIdType* PointIds = nullptr;
  vtkIdType Count = 0;
  int Type = 0;
  int FlatAxis;
  bool IsProduct = false;
  BasisProduct Product;
  Shape Form = Shape::Other;

  // State of find().
  bool HasPoints = false, HasInverse = false, IsWarm = false;
  std::vector<Vector> Points; // relative to the first one
  Vector Origin{};
  double Length = 0;
  double Inverse[3][3];
  double Place[3];
  std::vector<double> Weights, Derivatives;
};

} // namespace filters
