// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkInformationStringKey.h"
#include "vtkNew.h"

#include <initializer_list>

namespace filters
{

/// Sets the unit of an array, which ParaView shows.
inline void setUnit(vtkDataArray* array, const char* unit)
{
  array->GetInformation()->Set(vtkDataArray::UNITS_LABEL(), unit);
}

template <class Array, class Values>
void addFieldValues(
  vtkDataObject* output, const char* name, const Values& values, int components = 1)
{
  vtkNew<Array> array;
  array->SetName(name);
  array->SetNumberOfComponents(components);
  for (const auto& value : values)
  {
    array->InsertNextValue(value);
  }
  output->GetFieldData()->AddArray(array);
}

template <class Array, class Value>
void addFieldValue(vtkDataObject* output, const char* name, const Value& value)
{
  addFieldValues<Array>(output, name, std::initializer_list<Value>{ value });
}

} // namespace filters
