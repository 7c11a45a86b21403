// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef CellTypes_h
#define CellTypes_h

/// VTK 9.6 deprecates the names that earlier versions have for these.

#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

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

} // namespace filters

#endif
