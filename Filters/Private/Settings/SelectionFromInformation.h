// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "MediumSettings.h"

#include "vtkDataObject.h"
#include "vtkInformation.h"

namespace filters
{

/// Returns the selection that SetInputArrayToProcess() has stored.
inline ArraySelection selectionFrom(vtkInformation* info)
{
  ArraySelection selection;
  if (const char* name = info->Get(vtkDataObject::FIELD_NAME()))
  {
    selection.name = name;
  }
  else if (info->Has(vtkDataObject::FIELD_ATTRIBUTE_TYPE()))
  {
    selection.attribute = info->Get(vtkDataObject::FIELD_ATTRIBUTE_TYPE());
  }
  selection.cellsFirst =
    info->Get(vtkDataObject::FIELD_ASSOCIATION()) == vtkDataObject::FIELD_ASSOCIATION_CELLS;
  return selection;
}

} // namespace filters
