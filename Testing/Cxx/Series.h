// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Changing.h"

/// A column that is 1, 2 and 3 times as strong at the times 0, 1 and 2.
inline vtkSmartPointer<Changing> series()
{
  auto all = vtkSmartPointer<Changing>::New();
  all->steps = { 0, 1, 2 };
  all->make = [](double time) -> vtkSmartPointer<vtkDataObject>
  {
    auto image = cube(24);
    addPointArray(image, "N",
      [time, column = GaussianColumn()](const Vec& x) { return (1 + time) * column(x); });
    return image;
  };
  return all;
}
