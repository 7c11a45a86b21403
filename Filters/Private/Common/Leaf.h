// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkDataSetAttributes.h"
#include "vtkSmartPointer.h"

#include <vector>

class vtkDataArray;
class vtkDataSet;
class vtkUnsignedCharArray;

/// A dataset with the arrays that are read, and masks of its points and cells.
namespace filters
{

// Point arrays of the output, which inputs may have, too.
constexpr const char* arrayName = "Refractivity";
constexpr const char* maskName = "vtkValidPointMask"; // the name that vtkResampleToImage uses
constexpr const char* transparentName = "TransparentPointMask";

// Field data: the value that Numbers::Differences are relative to.
constexpr const char* offsetName = "RefractivityOffset";

/// The representation of the array Refractivity.
enum class Numbers
{
  Singles,
  Doubles,
  Differences // from about the ambient N, in single precision: weak flows keep their digits
};

/// The arrays that a model reads, in its order: of one component, all of points or all of cells.
using Arrays = std::vector<vtkDataArray*>;

/// A dataset of the input that has all chosen arrays.
struct Leaf
{
  vtkDataSet* data;
  Arrays arrays;
  bool ofCells;
  vtkDataSet* input; // `data` before masking
};

constexpr unsigned char hiddenCellBits =
  vtkDataSetAttributes::HIDDENCELL | vtkDataSetAttributes::REFINEDCELL;

/// Makes a mask that is 1 everywhere.
vtkSmartPointer<vtkUnsignedCharArray> newMask(vtkIdType count);

/// Clears `valid` at points that are hidden or that a mask among the data's arrays excludes.
void hidePoints(vtkDataSet* data, vtkUnsignedCharArray* valid);

/// Returns a mask of the visible points or cells that have the values.
vtkSmartPointer<vtkUnsignedCharArray> visibleOf(const Leaf& leaf);

} // namespace filters
