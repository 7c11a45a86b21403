// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Fixtures.h"

#include "vtkMatrix3x3.h"

namespace
{

void look(vtkSchlierenFilter* filter, const Vec& direction, const Vec& up)
{
  filter->SetViewDirection(direction.data());
  filter->SetViewUp(up.data());
}

/// Where the optical path's centre of gravity lies in the image.
std::array<double, 2> centreOfGravity(vtkSchlierenFilter* filter)
{
  auto* image = vtkImageData::SafeDownCast(filter->GetOutputDataObject(0));
  vtkDataArray* opticalPath = arrayOf(filter, "OpticalPathDifference");
  double sum = 0, x = 0, y = 0;
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    const double weight = opticalPath->GetComponent(i, 0);
    sum += weight;
    x += weight * image->GetPoint(i)[0];
    y += weight * image->GetPoint(i)[1];
  }
  return { x / sum, y / sum };
}

} // namespace

// Image coordinates are (x.u, x.v), also for a tilted grid far from the origin.
TEST(ImageCoordinates, BlobAppearsWhereItIs)
{
  const Vec far = { 1000, -2000, 500 };
  for (const double angle : { 0., 0.5 })
  {
    auto image = cube(64);
    image->SetOrigin(far[0] - 1, far[1] - 1, far[2] - 1);
    const double rotation[9] = { std::cos(angle), -std::sin(angle), 0, std::sin(angle),
      std::cos(angle), 0, 0, 0, 1 };
    vtkNew<vtkMatrix3x3> matrix;
    std::copy_n(rotation, 9, matrix->GetData());
    image->SetDirectionMatrix(matrix);

    double middle[3];
    image->TransformContinuousIndexToPhysicalPoint(36.5, 27, 40, middle);
    const Vec blob = { middle[0], middle[1], middle[2] };
    addPointArray(image, "N",
      [&](const Vec& x)
      {
        const Vec d = { x[0] - blob[0], x[1] - blob[1], x[2] - blob[2] };
        return 1e-5 * std::exp(-dot(d, d) / 0.04);
      });
    const std::pair<Vec, Vec> views[] = { { { 0, 0, -1 }, { 0, 1, 0 } },
      { { 1, 0, 0 }, { 0, 0, 1 } }, { { -0.4, 0.3, -1 }, { 0.1, 1, 0 } } };
    for (const auto& [direction, up] : views)
    {
      auto filter = bench(image, 96);
      look(filter, direction, up);
      filter->Update();
      const Axes axes(direction, up);
      const auto centre = centreOfGravity(filter);
      const double pixel =
        vtkImageData::SafeDownCast(filter->GetOutputDataObject(0))->GetSpacing()[0];
      EXPECT_NEAR(centre[0], dot(blob, axes.u), 0.05 * pixel) << "angle " << angle;
      EXPECT_NEAR(centre[1], dot(blob, axes.v), 0.05 * pixel) << "angle " << angle;
    }
  }
}

TEST(ImageCoordinates, FocalPointIsTheCentreOfTheImage)
{
  auto filter = bench(columnImage(16), 10);
  const auto centre = [&filter]()
  {
    filter->Update();
    double bounds[6];
    vtkImageData::SafeDownCast(filter->GetOutputDataObject(0))->GetBounds(bounds);
    return std::array<double, 2>{ (bounds[0] + bounds[1]) / 2, (bounds[2] + bounds[3]) / 2 };
  };
  EXPECT_NEAR(centre()[0], 0, 1e-12);
  filter->SetFocalPoint(0.25, -0.5, 7);
  EXPECT_NEAR(centre()[0], 0.25, 1e-12);
  EXPECT_NEAR(centre()[1], -0.5, 1e-12);
  filter->ClearFocalPoint();
  EXPECT_NEAR(centre()[0], 0, 1e-12);
  EXPECT_NEAR(centre()[1], 0, 1e-12);
}
