// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkSmartPointer.h"

class vtkDataSet;

namespace filters
{

/// Cuts polyhedra (vtkPolyhedron) into pyramids and tetrahedra and prisms with five or six sides into wedges, or
/// returns the mesh itself if it has none. Keeps point scalars (double) and the cells' ghost array.
///
/// A pyramid joins a face with the mean of the cell's corners. That has the mean of their values, and CellsAround say
/// so: quadratic fields stay quadratic (see PointTrends.h). Faces with four corners remain whole, as those of
/// hexahedra beside them. Others are cut into triangles from their point with the lowest number, so both of their cells
/// cut them alike. VTK decides by random numbers, common to all threads,
/// whether a point is inside a polyhedron, which crashes with several threads; and it locates
/// points beside those prisms inside them, up to a third of their volume, with values that are not
/// linear for linear data. vtkDataSetTriangleFilter takes three times as long as the whole first image of
/// 27 000 polyhedra.
vtkSmartPointer<vtkDataSet> withoutPolyhedra(vtkDataSet* mesh);

bool hasPolyhedra(vtkDataSet* data);

} // namespace filters
