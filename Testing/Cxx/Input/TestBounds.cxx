// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Bounds of the error are shown where they say something: not in large domains that are steep.
#include "Fixtures.h"

namespace
{

/// N is `most` higher at a ball of radius 1 than far away.
vtkSmartPointer<vtkSchlierenFilter> farField(double most, double tolerance)
{
  auto image = cube(65, 50);
  addPointArray(image, "N",
    [most](const Vec& x) { return most * std::exp(1 - std::max(1., std::sqrt(dot(x, x)))); });
  auto filter = bench(image, 32);
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
