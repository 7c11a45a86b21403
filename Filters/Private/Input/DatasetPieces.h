// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// The datasets of a rank's piece, as they are sent to other ranks.
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

/// Returns whether points have three indices: image, rectilinear or curvilinear grid.
bool isGrid(vtkDataSet* data);
/// Returns the extent of points or cells; low > high where the dataset is no grid.
std::array<int, 6> extentOf(vtkDataSet* data, bool ofCells);

} // namespace filters
