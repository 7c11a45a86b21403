// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Surfaces of bodies.
#pragma once

#include "Fixtures.h"

#include "vtkCubeSource.h"
#include "vtkNew.h"
#include "vtkPlaneSource.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

inline vtkSmartPointer<vtkPolyData> box(const Vec& lengths, const Vec& centre = { 0, 0, 0 })
{
  vtkNew<vtkCubeSource> source;
  source->SetXLength(lengths[0]);
  source->SetYLength(lengths[1]);
  source->SetZLength(lengths[2]);
  source->SetCenter(centre[0], centre[1], centre[2]);
  source->Update();
  return source->GetOutput();
}

/// A parallelogram with corners at o, p and q.
inline vtkSmartPointer<vtkPolyData> plate(const Vec& o, const Vec& p, const Vec& q)
{
  vtkNew<vtkPlaneSource> source;
  source->SetOrigin(o[0], o[1], o[2]);
  source->SetPoint1(p[0], p[1], p[2]);
  source->SetPoint2(q[0], q[1], q[2]);
  source->Update();
  return source->GetOutput();
}
