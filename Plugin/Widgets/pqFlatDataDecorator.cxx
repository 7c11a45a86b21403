// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "pqFlatDataDecorator.h"

#include "InputOfFilter.h"
#include "pqPropertyWidget.h"

#include <algorithm>

pqFlatDataDecorator::pqFlatDataDecorator(vtkPVXMLElement* element, pqPropertyWidget* parentObject)
  : pqPropertyWidgetDecorator(element, parentObject)
{
}

pqFlatDataDecorator::~pqFlatDataDecorator() = default;

bool pqFlatDataDecorator::canShowWidget(bool showAdvanced) const
{
  // Cells of other meshes are on the server: those one cell thick, such as wedges of 5 degrees, are thin.
  constexpr double thin = 0.2;
  vtkPVDataInformation* data = inputOf(this->parentWidget()->proxy());
  if (showAdvanced || !data)
  {
    return true;
  }
  if (data->IsDataStructured())
  {
    const int* extent = data->GetExtent();
    return std::min({ extent[1] - extent[0], extent[3] - extent[2], extent[5] - extent[4] }) <= 1;
  }
  std::array<double, 3> sides = sidesOf(data);
  std::sort(sides.begin(), sides.end());
  return sides[0] <= thin * sides[1];
}
