// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// The datasets that a rank has of an input, and how they are sent to another one.
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

/// The position of a dataset in the tree of blocks. Parts of one dataset have the same one on all ranks.
using Slot = std::vector<int>;

struct Part
{
  Slot slot;
  vtkSmartPointer<vtkDataSet> data;
};

/// The datasets of an input that have points, with those arrays of points and cells that are named and without copies of
/// other ranks' cells (but in images and grids, where they may touch).
std::vector<Part> partsOf(vtkDataObject* data, const std::vector<std::string>& arrays);

/// Some cells of a mesh, with all arrays.
vtkSmartPointer<vtkUnstructuredGrid> extractedCells(vtkUnstructuredGrid* mesh, vtkIdList* cells);

/// A part as it is sent, and as it arrives. Throw std::runtime_error where VTK cannot send a type of data.
void pack(const Part& part, std::vector<char>& bytes);
Part unpack(Reader& reader);

/// Throws std::runtime_error where parts have not the same arrays of points or cells (vtkDataObject::POINT, CELL), of which
/// some would be lost.
void requireSameArrays(const std::vector<vtkDataSet*>& parts, int kind);

/// Whether the points have three indices: an image, a rectilinear or a curvilinear grid.
bool isGrid(vtkDataSet* data);
/// Its indices of points or cells; low > high: it is no grid.
std::array<int, 6> extentOf(vtkDataSet* data, bool ofCells);

/// Parts of one image or grid as one; null where they are none.
vtkSmartPointer<vtkDataSet> joinedGrid(const std::vector<vtkDataSet*>& parts);

/// Parts of one mesh as one, cells in their order. Points that are the same to the last bit become one, if they also have
/// the same values of an array, where its name is given.
vtkSmartPointer<vtkDataSet> joinedMesh(
  const std::vector<vtkDataSet*>& parts, const char* alsoTheSame = nullptr);

} // namespace filters
