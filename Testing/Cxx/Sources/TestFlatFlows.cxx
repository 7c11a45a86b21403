// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Two-dimensional flows as they are computed: bodies in far fields, triangles, adaptive meshes.
#include "Fixtures.h"

#include "vtkDiskSource.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPolyData.h"
#include "vtkSphereSource.h"
#include "vtkStructuredGrid.h"
#include "vtkUnsignedCharArray.h"

namespace
{

/// From coordinates along and across a plane to the data's: the plane's right and up, seen against its axis.
struct Plane
{
  int axis;
  Vec at(double a, double b, double across = 0) const
  {
    switch (this->axis)
    {
      case 0:
        return { across, a, b };
      case 1:
        return { a, across, b };
      default:
        return { a, b, across };
    }
  }
  Vec up() const { return this->at(0, 1); }
  /// So that the image's right is the plane's.
  Vec direction() const
  {
    const Vec towardsViewer = cross(this->at(1, 0), this->at(0, 1));
    return { -towardsViewer[0], -towardsViewer[1], -towardsViewer[2] };
  }
  void look(vtkSchlierenFilter* filter) const
  {
    const Vec to = this->direction(), upward = this->up();
    filter->SetViewDirection(to[0], to[1], to[2]);
    filter->SetViewUp(upward[0], upward[1], upward[2]);
    filter->SetFocalPoint(0, 0, 0);
  }
};

/// The density around a cylinder of radius 1 in a slow potential flow to the right: 1 + M^2 / 2 (1 - v^2).
struct CylinderFlow
{
  static constexpr double squaredMach = 0.1;
  static constexpr double far = 50;

  static double density(double a, double b)
  {
    const double rr = a * a + b * b;
    const double squaredSpeed = 1 + (1 - 2 * (a * a - b * b)) / (rr * rr);
    return 1 + 0.5 * squaredMach * (1 - squaredSpeed);
  }
};

/// A body-fitted mesh of it: 181 points around, 121 outward, 1.04 times as far apart each.
vtkSmartPointer<vtkStructuredGrid> cylinderMesh(const Plane& plane)
{
  constexpr int around = 181, outward = 121;
  auto mesh = vtkSmartPointer<vtkStructuredGrid>::New();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkDoubleArray> density;
  density->SetName("N");
  const double growth = 1.04;
  for (int j = 0; j < outward; ++j)
  {
    const double part = (std::pow(growth, j) - 1) / (std::pow(growth, outward - 1) - 1);
    const double r = 1 + (CylinderFlow::far - 1) * part;
    for (int i = 0; i < around; ++i)
    {
      const double angle = 2 * pi * i / (around - 1);
      const double a = r * std::cos(angle), b = r * std::sin(angle);
      points->InsertNextPoint(plane.at(a, b).data());
      density->InsertNextValue(1e-6 * CylinderFlow::density(a, b));
    }
  }
  mesh->SetDimensions(around, outward, 1);
  mesh->SetPoints(points);
  mesh->GetPointData()->AddArray(density);
  return mesh;
}

/// Of a formula's gradient, by central differences.
template <class F>
std::array<double, 2> slopes(const F& f, double a, double b)
{
  constexpr double small = 1e-5;
  return { (f(a + small, b) - f(a - small, b)) / (2 * small),
    (f(a, b + small) - f(a, b - small)) / (2 * small) };
}

struct Errors
{
  double rms = 0, largest = 0; // of the deflection, by the largest
};

/// Where `counts`: against the slopes of a field, one unit deep.
template <class F, class Counts>
Errors errorsOf(vtkSchlierenFilter* filter, const F& f, const Counts& counts)
{
  auto* image = vtkImageData::SafeDownCast(filter->GetOutputDataObject(0));
  const std::vector<double> deflection = valuesOf(filter, "Deflection");
  Errors errors;
  double most = 0, count = 0;
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    const double a = image->GetPoint(i)[0], b = image->GetPoint(i)[1];
    const std::array<double, 2> expected = slopes(f, a, b);
    for (std::size_t side = 0; side < 2 && counts(a, b); ++side)
    {
      const double error =
        std::abs(deflection[2 * static_cast<std::size_t>(i) + side] - expected[side]);
      most = std::max(most, std::abs(expected[side]));
      errors.rms += error * error;
      errors.largest = std::max(errors.largest, error);
      ++count;
    }
  }
  return { std::sqrt(errors.rms / count) / most, errors.largest / most };
}

/// What is one unit deep.
vtkSmartPointer<vtkSchlierenFilter> flatBench(vtkDataObject* input, int pixels = 64)
{
  auto filter = bench(input, pixels);
  filter->SetDepth(1);
  return filter;
}

std::string gridOf(vtkSchlierenFilter* filter)
{
  return filter->GetOutputDataObject(0)
    ->GetFieldData()
    ->GetAbstractArray("Grid")
    ->GetVariantValue(0)
    .ToString();
}

/// The shadow's area, by pi.
double shadowOf(vtkSchlierenFilter* filter)
{
  double sum = 0;
  for (const double blocked : valuesOf(filter, "BlockedFraction"))
  {
    sum += blocked;
  }
  auto* image = vtkImageData::SafeDownCast(filter->GetOutputDataObject(0));
  return sum * image->GetSpacing()[0] * image->GetSpacing()[1] / pi;
}

} // namespace

// With default settings: a body that a grid over all of the data would have in one of its voxels.
TEST(FlatFlows, ACylinderInAFarFieldIsSharp)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    SCOPED_TRACE(axis);
    const Plane plane{ axis };
    vtkNew<vtkSchlierenFilter> filter;
    filter->SetInputData(cylinderMesh(plane));
    filter->SetDepth(1);
    filter->SetIndexModel(vtkRefractiveIndex::REFRACTIVITY);
    filter->SetInputArrayToProcess(
      vtkRefractiveIndex::INDEX_ARRAY, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "N");
    filter->SetImageSize(256, 256);
    plane.look(filter);
    filter->SetParallelScale(3);
    filter->Update();
    EXPECT_NE(gridOf(filter).find("bricks on levels"), std::string::npos) << gridOf(filter);
    const auto density = [](double a, double b) { return 1e-6 * CylinderFlow::density(a, b); };
    const auto isOutside = [](double a, double b) { return std::hypot(a, b) > 1.05; };
    EXPECT_LT(errorsOf(filter, density, isOutside).rms, 5e-3);
    const auto isFarther = [](double a, double b) { return std::hypot(a, b) > 1.2; };
    EXPECT_LT(errorsOf(filter, density, isFarther).largest, 0.02);
    // The wall is a polygon of 180 sides.
    auto* image = vtkImageData::SafeDownCast(filter->GetOutputDataObject(0));
    const std::vector<double> blocked = valuesOf(filter, "BlockedFraction");
    double worst = 0;
    for (std::size_t i = 0; i < blocked.size(); ++i)
    {
      const double* x = image->GetPoint(static_cast<vtkIdType>(i));
      const double outside = (std::hypot(x[0], x[1]) - 1) / image->GetSpacing()[0];
      worst = (blocked[i] > 0.5) != (outside < 0) ? std::max(worst, std::abs(outside)) : worst;
    }
    EXPECT_LT(worst, 0.1);
    EXPECT_LT(fieldValue(filter, "MediumBytes"), 10e6);
    EXPECT_NEAR(fieldValue(filter, "AmbientRefractivity"), 1e-6, 1e-9);
  }
}

// What is outside of the mesh: the corners of the image, and the body.
TEST(FlatFlows, OutsideIsAWindowAndTheBodyAWall)
{
  const Plane plane{ 2 };
  const auto mesh = cylinderMesh(plane);
  const struct
  {
    int outside;
    double corner, middle;
  } cases[] = { { vtkRefractiveIndex::OUTSIDE_AUTO, 0, 1 },
    { vtkRefractiveIndex::OUTSIDE_BLOCKS, 1, 1 }, { vtkRefractiveIndex::OUTSIDE_PASSES, 0, 0 } };
  for (const auto& one : cases)
  {
    auto filter = flatBench(mesh, 65);
    filter->SetOutside(one.outside);
    plane.look(filter);
    filter->Update();
    const std::vector<double> blocked = valuesOf(filter, "BlockedFraction");
    EXPECT_EQ(blocked[0], one.corner) << one.outside;
    EXPECT_EQ(blocked[65 * 32 + 32], one.middle) << one.outside;
  }
}

// Obliquely, the sides of the layer are no walls, and nothing shows where its front and back are but the light that
// crosses it longer.
TEST(FlatFlows, ALayerIsSeenObliquely)
{
  auto filter = flatBench(cylinderMesh({ 2 }), 400);
  filter->SetViewDirection(0.4, 0, -1);
  filter->SetFocalPoint(0, 0, 0);
  filter->SetParallelScale(3);
  filter->Update();
  // The shadow of a cylinder one unit deep: a disc that is drawn out by the tangent, seen at that angle.
  const double cosine = 1 / std::sqrt(1.16);
  EXPECT_NEAR(shadowOf(filter), cosine * (1 + 2 * 0.4 / pi), 0.01);
}

// Ten cells a pixel and waves of twelve cells: as fine as its voxels are, an image of a target error shows the mean of a pixel.
TEST(FlatFlows, WavesOfAPixelAreTheirMean)
{
  constexpr int pixels = 32, cells = 10 * pixels;
  constexpr double cell = 2. / cells, wave = 12 * cell, refractivity = 1e-7;
  int dimensions[3] = { cells + 1, cells + 1, 1 };
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (int j = 0; j <= cells; ++j)
  {
    for (int i = 0; i <= cells; ++i)
    {
      points->InsertNextPoint(i * cell - 1, j * cell - 1, 0);
    }
  }
  vtkNew<vtkStructuredGrid> mesh;
  mesh->SetDimensions(dimensions);
  mesh->SetPoints(points);
  addPointArray(
    mesh, "N", [](const Vec& x) { return refractivity * std::cos(2 * pi * x[0] / wave); });
  auto filter = flatBench(mesh, pixels);
  filter->SetParallelScale(0.9);
  filter->SetQuality(vtkSchlierenFilter::AUTOMATIC);
  filter->SetKMode(vtkSchlierenFilter::K_VALUE);
  constexpr double steepest = 2 * pi * refractivity / wave, half = 0.4;
  filter->SetKScale(half / steepest);
  filter->Update();
  const std::vector<double> light = valuesOf(filter, "Intensity");
  auto* image = vtkImageData::SafeDownCast(filter->GetOutputDataObject(0));
  const double ofPixel = pi * image->GetSpacing()[0] / wave;
  std::vector<double> errors;
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    const double mean =
      std::sin(2 * pi * image->GetPoint(i)[0] / wave) * std::sin(ofPixel) / ofPixel;
    errors.push_back(std::abs(light[static_cast<std::size_t>(i)] - (0.5 - half * mean)));
  }
  std::sort(errors.begin(), errors.end());
  const double error = errors[errors.size() * 99 / 100];
  EXPECT_LT(error, 0.006); // 0.016 with voxels of a quarter of a pixel
  EXPECT_LT(error, 2 * fieldValue(filter, "ErrorReached"));
}

// Two levels, refined in the middle.
TEST(FlatFlows, AdaptiveLevelsMatchTheClosedForm)
{
  constexpr double width = 0.4;
  const auto field = [](double a, double b)
  { return 1e-6 * std::exp(-(a * a + b * b) / (width * width)); };
  for (int axis = 0; axis < 3; ++axis)
  {
    SCOPED_TRACE(axis);
    const Plane plane{ axis };
    vtkNew<vtkMultiBlockDataSet> blocks;
    for (const int level : { 0, 1 })
    {
      const double half = level == 0 ? 1 : 0.5;
      constexpr int cells = 32;
      vtkNew<vtkImageData> image;
      int points[3] = { cells + 1, cells + 1, cells + 1 };
      points[axis] = 1;
      const Vec origin = plane.at(-half, -half, 0.2);
      image->SetDimensions(points);
      image->SetOrigin(origin.data());
      image->SetSpacing(2 * half / cells, 2 * half / cells, 2 * half / cells);
      vtkNew<vtkDoubleArray> means;
      means->SetName("N");
      vtkNew<vtkUnsignedCharArray> hidden;
      hidden->SetName(vtkDataSetAttributes::GhostArrayName());
      const auto mean = [&](int i) // of exp(-(x / width)^2)
      {
        const double h = 2 * half / cells, low = -half + i * h;
        return width * std::sqrt(pi) / 2 * (std::erf((low + h) / width) - std::erf(low / width)) /
          h;
      };
      for (int j = 0; j < cells; ++j)
      {
        for (int i = 0; i < cells; ++i)
        {
          means->InsertNextValue(1e-6 * mean(i) * mean(j));
          const bool isCovered =
            level == 0 && std::min(i, j) >= cells / 4 && std::max(i, j) < 3 * cells / 4;
          hidden->InsertNextValue(isCovered ? vtkDataSetAttributes::REFINEDCELL : 0);
        }
      }
      image->GetCellData()->AddArray(means);
      image->GetCellData()->AddArray(hidden);
      blocks->SetBlock(static_cast<unsigned>(level), image);
    }
    auto filter = flatBench(blocks, 128);
    filter->SetInputArrayToProcess(
      vtkRefractiveIndex::INDEX_ARRAY, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "N");
    plane.look(filter);
    const Vec middle = plane.at(0, 0, 0.2);
    filter->SetFocalPoint(middle[0], middle[1], middle[2]);
    filter->SetParallelScale(0.95);
    filter->SetMediumTolerance(1e-3);
    filter->Update();
    EXPECT_NE(gridOf(filter).find("bricks on levels"), std::string::npos) << gridOf(filter);
    EXPECT_EQ(largest(valuesOf(filter, "BlockedFraction")), 0);
    const Errors errors = errorsOf(filter, field, [](double, double) { return true; });
    EXPECT_LT(errors.largest, 5e-3);
  }
}

// A closed surface blocks where the plane cuts it; polygons in the plane block where they are.
TEST(FlatFlows, BodiesAreCutByThePlane)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    SCOPED_TRACE(axis);
    const Plane plane{ axis };
    const auto mesh = cylinderMesh(plane);
    vtkNew<vtkSphereSource> ball;
    ball->SetRadius(1);
    const Vec middle = plane.at(2, 1, 0.6);
    ball->SetCenter(middle[0], middle[1], middle[2]);
    ball->SetThetaResolution(120);
    ball->SetPhiResolution(120);
    ball->Update();
    vtkNew<vtkDiskSource> disc; // across z
    disc->SetInnerRadius(0);
    disc->SetOuterRadius(0.8);
    disc->SetCircumferentialResolution(120);
    disc->Update();
    vtkNew<vtkPoints> turned;
    for (vtkIdType i = 0; i < disc->GetOutput()->GetNumberOfPoints(); ++i)
    {
      const double* x = disc->GetOutput()->GetPoint(i);
      turned->InsertNextPoint(plane.at(x[0] + 2, x[1] + 1).data());
    }
    disc->GetOutput()->SetPoints(turned);
    for (vtkPolyData* bodies : { ball->GetOutput(), disc->GetOutput() })
    {
      auto filter = flatBench(mesh, 200);
      filter->SetInputData(1, bodies);
      plane.look(filter);
      filter->SetParallelScale(3);
      filter->SetMediumTolerance(0.01);
      filter->Update();
      EXPECT_NEAR(shadowOf(filter), 1 + 0.64, 0.02);
    }
  }
}
