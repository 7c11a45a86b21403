// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Images with bodies: a medium whose walls are where surfaces are, and whose gas is that of the image.
#include "Surfaces.h"

#include "vtkMath.h"
#include "vtkMatrix3x3.h"
#include "vtkSphereSource.h"
#include "vtkTransform.h"
#include "vtkTransformPolyDataFilter.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace
{

constexpr double strength = 1e-6, width = 0.35;

double ball(const Vec& x) { return strength * std::exp(-dot(x, x) / (width * width)); }

/// Of straight rays, all the way through.
Vec deflection(double u, double v)
{
  const double sum =
    strength * width * std::sqrt(vtkMath::Pi()) * std::exp(-(u * u + v * v) / (width * width));
  return { -2 * u / (width * width) * sum, -2 * v / (width * width) * sum, 0 };
}

vtkSmartPointer<vtkPolyData> sphere(double radius, const Vec& centre)
{
  vtkNew<vtkSphereSource> source;
  source->SetRadius(radius);
  source->SetCenter(centre.data());
  source->SetThetaResolution(60);
  source->SetPhiResolution(40);
  source->Update();
  return source->GetOutput();
}

vtkSmartPointer<vtkPolyData> moved(vtkPolyData* surface, vtkTransform* transform)
{
  vtkNew<vtkTransformPolyDataFilter> filter;
  filter->SetInputData(surface);
  filter->SetTransform(transform);
  filter->Update();
  return filter->GetOutput();
}

vtkSmartPointer<vtkImageData> ballImage(int points = 41)
{
  auto image = cube(points);
  addPointArray(image, "N", ball);
  return image;
}

vtkSmartPointer<vtkSchlierenFilter> benchWith(vtkDataObject* flow, vtkDataObject* bodies)
{
  auto filter = bench(flow, 128);
  filter->SetInputDataObject(1, bodies);
  return filter;
}

/// Errors of the deflection where light is not blocked, rms and largest, by the largest; and where none is blocked for
/// three pixels (a voxel) around: nearer, N is known on one side alone.
struct Errors
{
  double rms = 0, worst = 0, worstApart = 0;
};

Errors errorsOf(vtkSchlierenFilter* filter)
{
  filter->Update();
  auto* image = vtkImageData::SafeDownCast(filter->GetOutputDataObject(0));
  const std::vector<double> made = valuesOf(filter, "Deflection");
  const std::vector<double> blocked = valuesOf(filter, "BlockedFraction");
  const double largestOne =
    std::sqrt(2 / std::exp(1.)) / width * strength * width * std::sqrt(vtkMath::Pi());
  Errors errors;
  double count = 0;
  for (std::size_t pixel = 0; pixel < blocked.size(); ++pixel)
  {
    if (blocked[pixel] > 0)
    {
      continue;
    }
    const double* at = image->GetPoint(static_cast<vtkIdType>(pixel));
    const Vec right = deflection(at[0], at[1]);
    const double error =
      std::hypot(made[2 * pixel] - right[0], made[2 * pixel + 1] - right[1]) / largestOne;
    errors.worst = std::max(errors.worst, error);
    bool isApart = true;
    for (int near = 0; near < 49; ++near)
    {
      const auto other = static_cast<std::ptrdiff_t>(pixel) + near % 7 - 3 + 128 * (near / 7 - 3);
      isApart = isApart && other >= 0 && other < static_cast<std::ptrdiff_t>(blocked.size()) &&
        blocked[static_cast<std::size_t>(other)] == 0;
    }
    errors.worstApart = isApart ? std::max(errors.worstApart, error) : errors.worstApart;
    errors.rms += error * error;
    ++count;
  }
  errors.rms = std::sqrt(errors.rms / count);
  return errors;
}

double blockedArea(vtkSchlierenFilter* filter)
{
  filter->Update();
  auto* image = vtkImageData::SafeDownCast(filter->GetOutputDataObject(0));
  double area = 0;
  for (const double blocked : valuesOf(filter, "BlockedFraction"))
  {
    area += blocked * image->GetSpacing()[0] * image->GetSpacing()[1];
  }
  return area;
}

} // namespace

// The edge of a box that lies aslant in the grid, from far and from so near that a voxel is fifty images wide.
TEST(ImageWithBodies, SilhouettesAreThoseOfTheSurfaceAtAnyZoom)
{
  const double angle = 23.;
  vtkNew<vtkTransform> turn;
  turn->RotateZ(angle);
  auto filter = benchWith(ballImage(), moved(box({ 0.8, 0.8, 0.8 }), turn));
  // The middle of the box's right side, and along the edge.
  const double c = std::cos(vtkMath::RadiansFromDegrees(angle));
  const double s = std::sin(vtkMath::RadiansFromDegrees(angle));
  const double middle[3] = { 0.4 * c, 0.4 * s, 0 }, along[3] = { -s, c, 0 };
  filter->SetViewUp(along);
  filter->SetFocalPoint(middle);
  for (const double scale : { 0.2, 0.02, 2e-3, 5e-4 })
  {
    filter->SetParallelScale(scale);
    const double pixel = 2 * scale / 128;
    // Half of the image, so the edge is at its middle.
    EXPECT_NEAR(blockedArea(filter) / (2 * scale), scale, 0.1 * pixel) << scale;
  }
}

// Unknown values at the end of rows, of planes and of all.
TEST(ImageWithBodies, BodiesMayReachThroughTheFacesOfTheImage)
{
  for (const Vec& centre :
    { Vec{ -1, 0, 0 }, Vec{ 1, 0, 0 }, Vec{ 0, 1, 0 }, Vec{ 0, 0, 1 }, Vec{ 1, 1, 1 } })
  {
    const Errors errors = errorsOf(benchWith(ballImage(), sphere(0.45, centre)));
    EXPECT_LT(errors.rms, 1e-2);
    EXPECT_LT(errors.worst, 0.1);
  }
}

TEST(ImageWithBodies, ABodyInTheGasChangesNoLightBesideIt)
{
  const Errors alone = errorsOf(bench(ballImage(), 128));
  const auto body = sphere(0.2, { 0.3, 0.1, 0.2 });
  auto filter = benchWith(ballImage(), body);
  const Errors beside = errorsOf(filter);
  EXPECT_NEAR(blockedArea(filter), vtkMath::Pi() * 0.04, 0.01 * vtkMath::Pi() * 0.04);
  EXPECT_LT(alone.worst, 0.01);
  EXPECT_LT(beside.rms, 0.005);
  EXPECT_LT(beside.worstApart, 0.03);
  EXPECT_LT(beside.worst, 0.15);
}

// What was there inside of the body before is no gas, whatever it is.
TEST(ImageWithBodies, ValuesInsideBodiesDoNotMatter)
{
  auto image = cube(41);
  addPointArray(
    image, "N", [](const Vec& x) { return std::sqrt(dot(x, x)) < 0.5 ? 1e-3 : 2.7e-4; });
  auto filter = benchWith(image, sphere(0.51, { 0, 0, 0 }));
  filter->SetAmbientRefractivity(-1);
  filter->Update();
  EXPECT_LT(largest(valuesOf(filter, "Deflection")), 1e-12);
  EXPECT_LT(largest(valuesOf(filter, "OpticalPathDifference")), 1e-12);
}

// Two gases on the sides of a sheet: some light is bent near it, but none passes through it.
TEST(ImageWithBodies, SheetsLeakNoLight)
{
  auto filter = benchWith(
    ballImage(), plate({ -0.7, -0.7, 0.013 }, { 0.7, -0.7, 0.013 }, { -0.7, 0.7, 0.013 }));
  const double pixel = 2. / 128, outline = 5.6;
  EXPECT_NEAR(blockedArea(filter), 1.96, 0.5 * pixel * outline);
  const double aslant[3] = { 0.3, 0.5, -1 };
  filter->SetViewDirection(aslant);
  const double cosine = 1 / std::sqrt(0.09 + 0.25 + 1);
  EXPECT_NEAR(blockedArea(filter), 1.96 * cosine, 0.5 * pixel * outline);
}

// An image in axes of its own, and values that belong to cells.
TEST(ImageWithBodies, ImagesMayBeTurnedAndHaveCells)
{
  const double c = std::cos(0.7), s = std::sin(0.7);
  const double rotation[9] = { c, -s, 0, s, c, 0, 0, 0, 1 };
  const auto body = sphere(0.2, { 0.3, 0.1, 0.2 });
  for (const bool ofCells : { false, true })
  {
    auto image = cube(ofCells ? 61 : 41);
    vtkNew<vtkMatrix3x3> direction;
    std::copy_n(rotation, 9, direction->GetData());
    image->SetDirectionMatrix(direction);
    double middle[3];
    const double half = ofCells ? 30 : 20;
    image->TransformContinuousIndexToPhysicalPoint(half, half, half, middle);
    const double* origin = image->GetOrigin();
    image->SetOrigin(origin[0] - middle[0], origin[1] - middle[1], origin[2] - middle[2]);
    ofCells ? addCellArray(image, "N", ball) : static_cast<void>(addPointArray(image, "N", ball));
    auto filter = benchWith(image, body);
    filter->SetParallelScale(0.7);
    if (ofCells)
    {
      filter->SetInputArrayToProcess(
        vtkRefractiveIndex::INDEX_ARRAY, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "N");
    }
    const Errors errors = errorsOf(filter);
    EXPECT_LT(errors.rms, 0.01) << ofCells;
    EXPECT_LT(errors.worstApart, 0.05) << ofCells;
    EXPECT_NEAR(blockedArea(filter), vtkMath::Pi() * 0.04, 0.01 * vtkMath::Pi() * 0.04);
  }
}

// Points without values are walls as they stand: the cube around each.
TEST(ImageWithBodies, PointsWithoutValuesAreWalls)
{
  auto image = cube(41);
  addPointArray(image, "N",
    [](const Vec& x)
    {
      const bool isHole = std::abs(x[0]) < 0.26 && std::abs(x[1]) < 0.26 && std::abs(x[2]) < 0.26;
      return isHole ? std::nan("") : 2.7e-4;
    });
  auto filter = benchWith(image, sphere(0.2, { 0.7, 0.7, 0 }));
  filter->SetAmbientRefractivity(-1);
  const double edge = 0.05 * 11;
  // One ray for each pixel.
  const double pixel = 2. / 128;
  EXPECT_NEAR(blockedArea(filter), edge * edge + vtkMath::Pi() * 0.04, 2 * edge * pixel);
  EXPECT_EQ(largest(valuesOf(filter, "Deflection")), 0);
}
