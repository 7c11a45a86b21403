// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef CellTypes_h
#define CellTypes_h

/// Maps names that VTK 9.6 has deprecated to those of earlier versions.

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
