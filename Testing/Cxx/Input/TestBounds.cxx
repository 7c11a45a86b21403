// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Bounds of the error are shown where they say something: not on meshes with a far field, which are large and
// steep.
#include "Fixtures.h"

#include "vtkPoints.h"
#include "vtkStructuredGrid.h"

namespace
{

/// Shells around a body of radius 1, up to radius 50, each thicker than the one before by a constant factor;
/// N is `most` higher at the body than far away.
vtkSmartPointer<vtkStructuredGrid> shells(double most)
{
  constexpr int radii = 40, polar = 13, around = 25;
  vtkNew<vtkPoints> points;
  for (int k = 0; k < around; ++k)
  {
    for (int j = 0; j < polar; ++j)
    {
      for (int i = 0; i < radii; ++i)
      {
        const double r = std::pow(50, i / (radii - 1.));
        const double theta = pi * (0.02 + 0.96 * j / (polar - 1)), phi = 2 * pi * k / (around - 1);
        points->InsertNextPoint(r * std::sin(theta) * std::cos(phi),
          r * std::sin(theta) * std::sin(phi), r * std::cos(theta));
      }
    }
  }
  auto mesh = vtkSmartPointer<vtkStructuredGrid>::New();
  mesh->SetDimensions(radii, polar, around);
  mesh->SetPoints(points);
  addPointArray(
    mesh, "N", [most](const Vec& x) { return most * std::exp(1 - std::sqrt(dot(x, x))); });
  return mesh;
}

vtkSmartPointer<vtkSchlierenFilter> farField(double most, double tolerance)
{
  auto filter = bench(shells(most), 32);
  filter->SetOutsideBlocksLight(false);
  filter->SetSamplingDimensions(65, 65, 65); // a grid, whose cubes may be skipped
  filter->SetHomogeneityTolerance(tolerance);
  filter->SetPathModel(vtkSchlierenFilter::STRAIGHT);
  filter->Update();
  return filter;
}

bool isShown(vtkSchlierenFilter* filter, const char* name)
{
  return filter->GetOutput()->GetFieldData()->HasArray(name);
}

} // namespace

TEST(Bounds, OfSkippingIsShownWhereItIsLessThanTheDeflection)
{
  auto fine = farField(1e-6, 1e-3);
  const double largestDeflection = largest(valuesOf(fine, "Deflection"));
  EXPECT_GT(fieldValue(fine, "SkippingBound"), 0);
  EXPECT_LT(fieldValue(fine, "SkippingBound"), largestDeflection);
  EXPECT_FALSE(isShown(farField(1e-6, 0.1), "SkippingBound"));
  EXPECT_EQ(fieldValue(farField(1e-6, 0), "SkippingBound"), 0); // nothing is skipped
  EXPECT_EQ(fieldValue(farField(0, 1e-3), "SkippingBound"), 0); // nothing is bent
}
