// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// Homogeneous cubes are crossed in one step: on real data, what that changes is within its bound.
#include "Schlieren.h"

#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkXMLImageDataReader.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace
{

TEST(Skipping, JetChangesByNoMoreThanTheBound)
{
  vtkNew<vtkXMLImageDataReader> reader;
  reader->SetFileName(SCHLIEREN_TEST_DATA "/ladenburg_jet_3d.vti");
  reader->Update();
  vtkImageData* jet = reader->GetOutput();
  vtkDataArray* density = jet->GetPointData()->GetArray("rho");
  ASSERT_NE(density, nullptr);
  std::vector<float> refractivity(static_cast<std::size_t>(jet->GetNumberOfPoints()));
  for (vtkIdType i = 0; i < jet->GetNumberOfPoints(); ++i)
  {
    refractivity[static_cast<std::size_t>(i)] =
      static_cast<float>(2.26e-4 * density->GetComponent(i, 0));
  }
  schlieren::Field field;
  for (int axis = 0; axis < 3; ++axis)
  {
    const auto a = static_cast<std::size_t>(axis);
    field.grid.dimensions[a] = jet->GetDimensions()[axis];
    field.grid.origin[a] = jet->GetOrigin()[axis];
    field.grid.spacing[a] = jet->GetSpacing()[axis];
  }
  field.singles = refractivity.data();

  schlieren::Bench bench;
  schlieren::Scene scene;
  scene.device = schlieren::Device::Cpu;
  scene.samplesPerPixel = 1;
  scene.view.width = 128;
  scene.view.height = 72;
  for (const auto& viewDirection :
    { schlieren::Vector{ 0, 0, -1 }, schlieren::Vector{ -0.5, -0.3, -1 } })
  {
    scene.view.viewDirection = viewDirection;
    scene.homogeneityTolerance = 0;
    const schlieren::Image full = bench.render(field, scene);
    double lastBound = 0;
    std::int64_t lastSteps = full.stepsTaken;
    for (const double tolerance : { 1e-5, 1e-4, 1e-3, 1e-2 })
    {
      SCOPED_TRACE(tolerance);
      scene.homogeneityTolerance = tolerance;
      const schlieren::Image skipped = bench.render(field, scene);
      double changed = 0;
      for (std::size_t i = 0; i < full.deflection.size(); ++i)
      {
        changed = std::max<double>(changed, std::abs(full.deflection[i] - skipped.deflection[i]));
      }
      EXPECT_LE(changed, skipped.skippingBound);
      EXPECT_GT(skipped.skippingBound, lastBound);
      EXPECT_LE(skipped.stepsTaken, lastSteps);
      lastBound = skipped.skippingBound;
      lastSteps = skipped.stepsTaken;
    }
    EXPECT_LT(lastSteps, full.stepsTaken * 9 / 10);
  }
}

} // namespace
