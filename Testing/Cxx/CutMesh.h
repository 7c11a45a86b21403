// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Surfaces.h"

#include "vtkPoints.h"
#include "vtkUnstructuredGrid.h"

#include <functional>

/// Two layers of hexahedra, below and above z = 0, where each has points of its own.
inline vtkSmartPointer<vtkUnstructuredGrid> cutMesh(int n)
{
  auto mesh = vtkSmartPointer<vtkUnstructuredGrid>::New();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  mesh->SetPoints(points);
  const auto side = static_cast<vtkIdType>(n) + 1;
  for (const double low : { -1., 0. })
  {
    const vtkIdType first = points->GetNumberOfPoints();
    for (int k = 0; k < 3; ++k)
    {
      for (int j = 0; j <= n; ++j)
      {
        for (int i = 0; i <= n; ++i)
        {
          points->InsertNextPoint(2. * i / n - 1, 2. * j / n - 1, low + 0.5 * k);
        }
      }
    }
    for (vtkIdType cell = 0; cell < 2 * vtkIdType{ n } * n; ++cell)
    {
      const vtkIdType at = first + (cell / (n * n) * side + cell / n % n) * side + cell % n,
                      up = side * side;
      const vtkIdType ids[8] = { at, at + 1, at + 1 + side, at + side, at + up, at + 1 + up,
        at + 1 + side + up, at + side + up };
      mesh->InsertNextCell(VTK_HEXAHEDRON, 8, ids);
    }
  }
  return mesh;
}

/// N above z = 0 is larger by `jump`, which depends on the place; the range of N there is 1.
inline void setJump(vtkUnstructuredGrid* mesh, const std::function<double(const Vec&)>& jump)
{
  mesh->GetPointData()->RemoveArray("N");
  const vtkIdType below = mesh->GetNumberOfPoints() / 2;
  vtkIdType point = 0;
  addPointArray(
    mesh, "N", [&](const Vec& x) { return 0.5 * x[0] + (point++ >= below ? jump(x) : 0); });
  mesh->GetPointData()->SetActiveScalars("N");
}
