// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkSmartPointer.h"

class vtkDataSet;

namespace filters
{

/// Divides curved cells into linear ones with corners at the cells' own nodes, `order` along each
/// edge, and vtkConvexPointSet into tetrahedra, or returns the mesh itself if it has none of them. Keeps point scalars (double) and the arrays of cells.
///
/// Nodes that a serendipity cell lacks, and those of Bezier cells, whose points are control points,
/// are interpolated by the cell's own functions, and common to neighbours. The interpolation is
/// then piecewise linear, or with gradients at the points quadratic (see PointTrends.h), where the
/// cell's own is of its order. If values belong to cells, only the corners are used: parts with one
/// value would be steps.
vtkSmartPointer<vtkDataSet> asLinearCells(vtkDataSet* mesh);

} // namespace filters
