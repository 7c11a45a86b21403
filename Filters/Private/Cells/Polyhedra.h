// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkSmartPointer.h"

class vtkDataSet;

namespace filters
{

/// The mesh with its polyhedra (vtkPolyhedron) cut into tetrahedra and its prisms with five or six sides into wedges, or
/// the mesh itself where it has none.
/// Point scalars (double) and the ghost array of the cells are kept, nothing else.
///
/// A tetrahedron joins a triangle of a face with the mean of the cell's corners, which gets the mean of
/// their values: what is linear stays so. A face is cut from its point with the lowest number, so both its
/// cells cut it alike. VTK finds out with random numbers that all threads share whether a point is inside
/// a polyhedron, which with several threads ends the program; and it takes places beside those prisms for places in
/// them, up to a third of their volume, with values that are not linear where the data are.
vtkSmartPointer<vtkDataSet> withoutPolyhedra(vtkDataSet* mesh);

} // namespace filters
