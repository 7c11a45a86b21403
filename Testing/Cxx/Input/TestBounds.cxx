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

bool statusSays(vtkSchlierenFilter* filter, const std::string& words)
{
  return std::string(filter->GetStatus()).find(words) != std::string::npos;
}

} // namespace

TEST(Bounds, OfTheDisplacementIsShownWhereLightStaysInTheImage)
{
  auto weak = farField(1e-6, 0);
  EXPECT_GT(fieldValue(weak, "DisplacementBound"), 0);
  EXPECT_LT(fieldValue(weak, "DisplacementBound"), 1);
  EXPECT_TRUE(statusSays(weak, "straight rays, displaced by "));

  // Finite, but more than is seen.
  auto strong = farField(2e-3, 0);
  EXPECT_GT(fieldValue(strong, "DisplacementBound"), 2);
  strong->SetParallelScale(2);
  strong->Update();
  EXPECT_FALSE(isShown(strong, "DisplacementBound"));
  EXPECT_TRUE(statusSays(strong, "straight rays, bending left out"));

  EXPECT_FALSE(isShown(farField(0.1, 0), "DisplacementBound")); // infinite
}

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
