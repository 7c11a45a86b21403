// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkDataSetAttributes.h"
#include "vtkSmartPointer.h"

#include <vector>

class vtkDataArray;
class vtkDataSet;
class vtkUnsignedCharArray;

/// A dataset with the arrays that are read of it, and which of its points and cells count.
namespace filters
{

// The point arrays of the output, which are also understood where an input has them.
constexpr const char* arrayName = "Refractivity";
constexpr const char* maskName = "vtkValidPointMask"; // as vtkResampleToImage calls it
constexpr const char* transparentName = "TransparentPointMask";

// A value of the field data, where the first of these arrays holds N less that: see Numbers::Differences.
constexpr const char* offsetName = "RefractivityOffset";

/// What the array Refractivity holds.
enum class Numbers
{
  Singles,
  Doubles,
  Differences // in single precision, from a value near that of the surroundings: weak flows keep their digits
};

/// The arrays that a model takes its values from, in its order. Each has one component and one value for
/// each point, or each has one for each cell.
using Arrays = std::vector<vtkDataArray*>;

/// A dataset within the input that has all chosen arrays.
struct Leaf
{
  vtkDataSet* data;
  Arrays arrays;
  bool ofCells;
  vtkDataSet* input; // `data`, but for what a mask hides
};

constexpr unsigned char hiddenCellBits =
  vtkDataSetAttributes::HIDDENCELL | vtkDataSetAttributes::REFINEDCELL;

/// A mask that is 1 everywhere.
vtkSmartPointer<vtkUnsignedCharArray> newMask(vtkIdType count);

/// Clears `valid` at points that are hidden or that an earlier mask among the data excludes.
void hidePoints(vtkDataSet* data, vtkUnsignedCharArray* valid);

} // namespace filters
