// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Common/Leaf.h"

#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkSmartPointer.h"

class vtkDataArray;
class vtkDataSet;

namespace filters
{

/// A modified dataset, and the points and cells of the original that it was made of.
struct Remade
{
  vtkSmartPointer<vtkDataSet> data;
  vtkNew<vtkIdList> points, cells;

  /// Returns a leaf with the original's values and masks.
  Leaf leafOf(const Leaf& from) const;
};

/// Copies the values of the points or cells that others were made of.
vtkSmartPointer<vtkDataArray> chosenValues(vtkDataArray* from, vtkIdList* ids);

} // namespace filters
