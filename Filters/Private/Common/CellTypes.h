// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef CellTypes_h
#define CellTypes_h

/// Types and structure of cells. Maps names that VTK 9.6 has deprecated to those of earlier versions.

#include "vtkImageData.h"
#include "vtkRectilinearGrid.h"
#include "vtkStructuredGrid.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <array>

#if __has_include("vtkCellTypeUtilities.h")
#include "vtkCellTypeUtilities.h"
#else
#include "vtkCellTypes.h"
using vtkCellTypeUtilities = vtkCellTypes;
#endif

namespace filters
{

inline vtkDataArray* cellTypesOf(vtkUnstructuredGrid* mesh)
{
#if __has_include("vtkCellTypeUtilities.h")
  return mesh->GetCellTypes();
#else
  return mesh->GetCellTypesArray();
#endif
}

/// Returns the number of points along each axis of structured data; 0 for others.
inline std::array<int, 3> structureOf(vtkDataSet* data)
{
  std::array<int, 3> points{};
  if (auto* image = vtkImageData::SafeDownCast(data))
  {
    image->GetDimensions(points.data());
  }
  else if (auto* rectilinear = vtkRectilinearGrid::SafeDownCast(data))
  {
    rectilinear->GetDimensions(points.data());
  }
  else if (auto* grid = vtkStructuredGrid::SafeDownCast(data))
  {
    grid->GetDimensions(points.data());
  }
  return points;
}

} // namespace filters

#endif
