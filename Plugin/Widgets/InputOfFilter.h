// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkPVDataInformation.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMSourceProxy.h"

#include <algorithm>
#include <array>

/// Returns the server's description of a filter's input; null without one.
inline vtkPVDataInformation* inputOf(vtkSMProxy* filter)
{
  const vtkSMPropertyHelper input(filter, "Input");
  auto* source = vtkSMSourceProxy::SafeDownCast(input.GetAsProxy());
  return source ? source->GetDataInformation(input.GetOutputPort()) : nullptr;
}

/// Returns how long data are along the axes, in their own unit; 0 where there are none.
inline std::array<double, 3> sidesOf(vtkPVDataInformation* data)
{
  const double* bounds = data->GetBounds();
  return { std::max(0., bounds[1] - bounds[0]), std::max(0., bounds[3] - bounds[2]),
    std::max(0., bounds[5] - bounds[4]) };
}
