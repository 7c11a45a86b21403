// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Bodies that are given as surfaces.
#include "Surfaces.h"

#include "vtkAppendPolyData.h"
#include "vtkCellArray.h"
#include "vtkLineSource.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPolyData.h"
#include "vtkReverseSense.h"
#include "vtkSphereSource.h"
#include "vtkThreshold.h"
#include "vtkUnstructuredGrid.h"

#include <array>
#include <random>

namespace
{

constexpr double gasN = 2.7e-4;
double gas(const Vec&) { return gasN; }

vtkSmartPointer<vtkPolyData> sphere(double radius, const Vec& centre = { 0, 0, 0 })
{
  vtkNew<vtkSphereSource> source;
  source->SetRadius(radius);
  source->SetCenter(centre.data());
  source->SetThetaResolution(120);
  source->SetPhiResolution(80);
  source->Update();
  return source->GetOutput();
}

vtkSmartPointer<vtkPolyData> together(const std::vector<vtkSmartPointer<vtkPolyData>>& parts)
{
  vtkNew<vtkAppendPolyData> append;
  for (const auto& part : parts)
  {
    append->AddInputData(part);
  }
  append->Update();
  return append->GetOutput();
}

vtkSmartPointer<vtkImageData> uniform(int points = 41)
{
  auto image = cube(points);
  addPointArray(image, "N", gas);
  return image;
}

vtkSmartPointer<vtkSchlierenFilter> benchWith(
  vtkDataObject* flow, vtkDataObject* bodies, int pixels = 128)
{
  auto filter = bench(flow, pixels);
  filter->SetInputDataObject(1, bodies);
  filter->SetAmbientRefractivity(-1);
  return filter;
}

struct Shadow
{
  double area = 0;
  double u = 0, v = 0; ///< its centre
};

Shadow shadowOf(vtkSchlierenFilter* filter)
{
  filter->Update();
  Shadow shadow;
  auto* image = vtkImageData::SafeDownCast(filter->GetOutputDataObject(0));
  const std::vector<double> blocked = valuesOf(filter, "BlockedFraction");
  const double pixel = image->GetSpacing()[0] * image->GetSpacing()[0];
  for (std::size_t i = 0; i < blocked.size(); ++i)
  {
    const double* x = image->GetPoint(static_cast<vtkIdType>(i));
    shadow.area += blocked[i] * pixel;
    shadow.u += blocked[i] * pixel * x[0];
    shadow.v += blocked[i] * pixel * x[1];
  }
  shadow.u /= shadow.area;
  shadow.v /= shadow.area;
  return shadow;
}

} // namespace

// The wall stays where the surface is, from every side and on every grid.
TEST(Bodies, ASphereCastsItsShadow)
{
  const double radius = 0.55, voxel = 0.05;
  const Vec centre{ 0.113, -0.071, 0.037 };
  for (const Vec& direction :
    { Vec{ 0, 0, -1 }, Vec{ 1, 0, 0 }, Vec{ 0, -1, 0.01 }, Vec{ 0.3, -0.7, -0.5 }, Vec{ 1, 1, 1 } })
  {
    auto filter = benchWith(uniform(), sphere(radius, centre), 256);
    const Vec up = std::abs(direction[1]) < 0.9 ? Vec{ 0, 1, 0 } : Vec{ 1, 0, 0 };
    filter->SetViewDirection(direction.data());
    filter->SetViewUp(up.data());
    filter->SetParallelScale(0.8);
    const Shadow shadow = shadowOf(filter);
    const Axes axes(direction, up);
    EXPECT_NEAR(std::sqrt(shadow.area / pi), radius, 0.5 * voxel);
    EXPECT_NEAR(shadow.u, dot(centre, axes.u), 0.1 * voxel);
    EXPECT_NEAR(shadow.v, dot(centre, axes.v), 0.1 * voxel);
    EXPECT_EQ(largest(valuesOf(filter, "Deflection")), 0);
    EXPECT_EQ(largest(valuesOf(filter, "OpticalPathDifference")), 0);
  }
}

// What light meets is the same, whichever side of its faces is said to be inside, and whatever lies in it, behind it or far away.
TEST(Bodies, MayBeInsideOutNestAndOverlap)
{
  vtkNew<vtkReverseSense> reverse;
  reverse->SetInputData(sphere(0.5));
  reverse->Update();
  const auto several =
    together({ sphere(0.5), sphere(0.2), sphere(0.4, { 0, 0, 0.3 }), sphere(0.3, { 5, 0, 0 }) });
  for (vtkPolyData* body : { reverse->GetOutput(), several.GetPointer() })
  {
    const Shadow shadow = shadowOf(benchWith(uniform(), body));
    EXPECT_NEAR(shadow.area / (pi * 0.25), 1, 0.01);
    EXPECT_LT(std::hypot(shadow.u, shadow.v), 0.005);
  }
}

// A sheet on the very side where light enters or leaves.
TEST(Bodies, ASheetOnTheGridsFaceBlocksLight)
{
  for (const double z : { -1., 1. })
  {
    for (const double sight : { -1., 1. })
    {
      auto filter =
        benchWith(uniform(21), plate({ -0.5, -0.5, z }, { 0.5, -0.5, z }, { -0.5, 0.5, z }), 40);
      filter->SetViewDirection(0, 0, sight);
      EXPECT_NEAR(shadowOf(filter).area, 1, 0.3) << z << " " << sight;
    }
  }
}

// Its two sides are one surface, which rays may pass on either side of.
TEST(Bodies, ASheetSeenEdgeOnIsNoThickerThanAPixel)
{
  auto filter =
    benchWith(uniform(), plate({ 0.01, -0.5, -0.5 }, { 0.01, 0.5, -0.5 }, { 0.01, -0.5, 0.5 }));
  const double pixel = 2. / 128;
  EXPECT_LT(shadowOf(filter).area, 1.5 * pixel);
  const double aslant[3] = { 0.1, 0, -1 };
  filter->SetViewDirection(aslant);
  EXPECT_NEAR(shadowOf(filter).area, 0.1 / std::sqrt(1.01), 1.5 * pixel);
}

// A mesh that leaves the body out, and the body's surface.
TEST(Bodies, UniformGasOfAMeshAroundABodyBendsNothing)
{
  auto image = uniform(31);
  addCellArray(image, "r", [](const Vec& x) { return std::sqrt(dot(x, x)); });
  vtkNew<vtkThreshold> threshold;
  threshold->SetInputData(image);
  threshold->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "r");
  threshold->SetThresholdFunction(vtkThreshold::THRESHOLD_UPPER);
  threshold->SetUpperThreshold(0.5);
  threshold->Update();
  for (const bool outsideBlocks : { true, false })
  {
    auto filter = benchWith(threshold->GetOutput(), sphere(0.5), 64);
    filter->SetOutside(
      outsideBlocks ? vtkRefractiveIndex::OUTSIDE_BLOCKS : vtkRefractiveIndex::OUTSIDE_PASSES);
    filter->SetViewDirection(0.2, -0.3, -1);
    const Shadow shadow = shadowOf(filter);
    // The hole that the cells leave is jagged: it reaches out by up to a cell, to its corner.
    const double radius = std::sqrt(shadow.area / pi);
    EXPECT_GT(radius, 0.5 - 0.02);
    EXPECT_LT(radius, outsideBlocks ? 0.5 + std::sqrt(3.) / 15 : 0.5 + 0.02);
    EXPECT_EQ(largest(valuesOf(filter, "Deflection")), 0);
    EXPECT_LT(largest(valuesOf(filter, "OpticalPathDifference")), 1e-15);
  }
}

TEST(Bodies, ARefractivityMadeBeforeIsMasked)
{
  auto image = uniform();
  image->GetPointData()->GetArray("N")->SetName("Refractivity");
  vtkNew<vtkSchlierenFilter> filter;
  filter->SetInputDataObject(image);
  filter->SetInputDataObject(1, sphere(0.5));
  filter->SetImageSize(100, 100);
  EXPECT_NEAR(std::sqrt(shadowOf(filter).area / pi), 0.5, 0.02);
  EXPECT_EQ(largest(valuesOf(filter, "Deflection")), 0);
  // The input is not touched.
  EXPECT_EQ(image->GetPointData()->GetArray("Refractivity")->GetRange()[0], gasN);
}

TEST(Bodies, OnlyAChangeBuildsTheMediumAgain)
{
  const auto body = sphere(0.5);
  auto filter = benchWith(uniform(), body, 32);
  filter->Update();
  EXPECT_EQ(filter->GetMediumBuilds(), 1);
  filter->SetKnifeEdgeAngle(90);
  filter->SetViewDirection(1, 0, 0);
  filter->Update();
  EXPECT_EQ(filter->GetMediumBuilds(), 1);
  const double before = shadowOf(filter).area;
  for (vtkIdType i = 0; i < body->GetNumberOfPoints(); ++i)
  {
    const double* x = body->GetPoint(i);
    body->GetPoints()->SetPoint(i, 1.2 * x[0], 1.2 * x[1], 1.2 * x[2]);
  }
  body->GetPoints()->Modified();
  EXPECT_GT(shadowOf(filter).area, before);
  EXPECT_EQ(filter->GetMediumBuilds(), 2);
  filter->SetInputDataObject(1, sphere(0.3));
  EXPECT_NEAR(std::sqrt(shadowOf(filter).area / pi), 0.3, 0.03);
  filter->SetInputConnection(1, nullptr);
  filter->Update();
  EXPECT_EQ(largest(valuesOf(filter, "BlockedFraction")), 0);
  EXPECT_EQ(filter->GetMediumBuilds(), 4);
}

namespace
{

vtkSmartPointer<vtkPolyData> withNan()
{
  auto data = sphere(0.5);
  data->GetPoints()->SetPoint(7, 0, std::nan(""), 0);
  return data;
}

vtkSmartPointer<vtkPolyData> line()
{
  vtkNew<vtkLineSource> source;
  source->Update();
  return source->GetOutput();
}

vtkSmartPointer<vtkMultiBlockDataSet> volumes()
{
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, uniform(3));
  return blocks;
}

} // namespace

TEST(Bodies, AMistakeIsSaidOnce)
{
  const std::tuple<vtkSmartPointer<vtkDataObject>, const char*> mistakes[] = { { withNan(), "NaN" },
    { line(), "no polygons" }, { vtkSmartPointer<vtkPolyData>::New(), "empty" },
    { vtkSmartPointer<vtkMultiBlockDataSet>::New(), "empty" }, { volumes(), "Extract Surface" },
    { uniform(3), "Extract Surface" }, { box({ 9, 9, 9 }), "cover all" } };
  for (const auto& [bodies, word] : mistakes)
  {
    auto filter = benchWith(uniform(11), sphere(0.5), 16);
    const auto wrong = bodies;
    expectOneMessage(
      filter.Get(), [&](vtkSchlierenFilter* f) { f->SetInputDataObject(1, wrong); },
      { word, "odies" }, [](vtkSchlierenFilter* f) { f->SetInputDataObject(1, sphere(0.4)); });
  }
}

TEST(Bodies, OutsideOfTheDataIsWarnedOf)
{
  for (const double far : { 5., 1e30 })
  {
    auto filter = benchWith(uniform(11), sphere(0.5, { far, 0, 0 }), 16);
    auto complaints = vtkSmartPointer<Complaints>::Take(new Complaints(filter));
    filter->Update();
    EXPECT_FALSE(isEmpty(filter));
    ASSERT_EQ(complaints->Warnings.size(), 1u);
    EXPECT_NE(complaints->Warnings[0].find("outside the data"), std::string::npos);
  }
}

TEST(Bodies, ThoseMuchLargerThanTheDataAreAMistake)
{
  auto filter = benchWith(uniform(11), nullptr, 16);
  expectOneMessage(
    filter.Get(), [](vtkSchlierenFilter* f) { f->SetInputDataObject(1, sphere(1e30)); },
    { "Bodies", "unit of length" },
    [](vtkSchlierenFilter* f) { f->SetInputDataObject(1, sphere(0.4)); });
}

// Faces twice, faces of no area, three faces at an edge, random triangles: no crash, and light is blocked.
TEST(Bodies, JunkIsNotMindedMuch)
{
  auto twice = together({ sphere(0.5), sphere(0.5) });
  auto holed = sphere(0.5);
  holed->GetPolys()->InsertNextCell({ 0, 1, 1 });
  holed->GetPolys()->InsertNextCell({ 2, 50, 700 });
  vtkNew<vtkPolyData> soup;
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> polygons;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-0.4, 0.4);
  std::uniform_int_distribution<vtkIdType> corner(0, 99);
  for (int i = 0; i < 300; ++i)
  {
    points->InsertNextPoint(any(random), any(random), any(random));
    polygons->InsertNextCell({ corner(random), corner(random), corner(random) });
  }
  soup->SetPoints(points);
  soup->SetPolys(polygons);
  for (const vtkSmartPointer<vtkPolyData>& junk :
    { twice, holed, vtkSmartPointer<vtkPolyData>(soup) })
  {
    auto filter = benchWith(uniform(21), junk, 32);
    auto complaints = vtkSmartPointer<Complaints>::Take(new Complaints(filter));
    EXPECT_GT(shadowOf(filter).area, 0.1);
    EXPECT_TRUE(complaints->Errors.empty());
  }
}
