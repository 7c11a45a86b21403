// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Sends the datasets of a rank's piece to other ranks and joins them.
#pragma once

#include "Common/Message.h"

#include "vtkSmartPointer.h"

#include <array>
#include <string>
#include <vector>

class vtkDataObject;
class vtkDataSet;
class vtkIdList;
class vtkUnstructuredGrid;

namespace filters
{

/// The position of a dataset in the tree of blocks, equal on all ranks that have cells of it.
using Slot = std::vector<int>;

struct DatasetPiece
{
  Slot slot;
  vtkSmartPointer<vtkDataSet> data;
};

/// Lists the datasets that have points, with the named arrays and without copies of other ranks'
/// cells (except in images and grids, where they may touch).
std::vector<DatasetPiece> piecesOf(vtkDataObject* data, const std::vector<std::string>& arrays);

/// Copies cells of a mesh, with all arrays.
vtkSmartPointer<vtkUnstructuredGrid> extractedCells(vtkUnstructuredGrid* mesh, vtkIdList* cells);

/// Writes and reads a dataset. Throw std::runtime_error for types of data that VTK cannot send.
void pack(const DatasetPiece& piece, std::vector<char>& bytes);
DatasetPiece unpack(Reader& reader);

/// Throws std::runtime_error if arrays of points or cells (vtkDataObject::POINT, CELL) differ,
/// because joining would lose some.
void requireSameArrays(const std::vector<vtkDataSet*>& pieces, int kind);

/// Returns whether points have three indices: image, rectilinear or curvilinear grid.
bool isGrid(vtkDataSet* data);
/// Returns the extent of points or cells; low > high where the dataset is no grid.
std::array<int, 6> extentOf(vtkDataSet* data, bool ofCells);

/// Joins the extents of one image or grid; null for other datasets.
vtkSmartPointer<vtkDataSet> joinedGrid(const std::vector<vtkDataSet*>& pieces);

/// Joins meshes, cells in their order. Merges points that are equal to the last bit and, if an
/// array is named, have the same values of it.
vtkSmartPointer<vtkDataSet> joinedMesh(
  const std::vector<vtkDataSet*>& pieces, const char* alsoTheSame = nullptr);

} // namespace filters
