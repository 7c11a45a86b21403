// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Schlieren.h"

#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkXMLImageDataReader.h"

#include <cstddef>
#include <vector>

/// The jet after Ladenburg's experiment as the tracer takes it, and the memory for it. Without its data,
/// field.singles is null.
struct Jet
{
  Jet()
  {
    vtkNew<vtkXMLImageDataReader> reader;
    reader->SetFileName(SCHLIEREN_TEST_DATA "/ladenburg_jet_3d.vti");
    reader->Update();
    vtkImageData* jet = reader->GetOutput();
    vtkDataArray* density = jet->GetPointData()->GetArray("rho");
    if (density == nullptr)
    {
      return;
    }
    for (vtkIdType i = 0; i < jet->GetNumberOfPoints(); ++i)
    {
      refractivity.push_back(static_cast<float>(2.26e-4 * density->GetComponent(i, 0)));
    }
    for (int axis = 0; axis < 3; ++axis)
    {
      const auto a = static_cast<std::size_t>(axis);
      field.grid.dimensions[a] = jet->GetDimensions()[axis];
      field.grid.origin[a] = jet->GetOrigin()[axis];
      field.grid.spacing[a] = jet->GetSpacing()[axis];
    }
    field.singles = refractivity.data();
  }
  Jet(const Jet&) = delete;
  Jet& operator=(const Jet&) = delete;

  std::vector<float> refractivity;
  schlieren::Field field;
};
