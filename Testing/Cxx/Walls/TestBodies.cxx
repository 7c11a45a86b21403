// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Bodies that are given as surfaces.
#include "Sources/MediumMaker.h"
#include "Surfaces.h"

#include "vtkAppendFilter.h"
#include "vtkAppendPolyData.h"
#include "vtkCellArray.h"
#include "vtkLineSource.h"
#include "vtkMatrix3x3.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPolyData.h"
#include "vtkReverseSense.h"
#include "vtkSphereSource.h"
#include "vtkThreshold.h"
#include "vtkTransform.h"
#include "vtkTransformPolyDataFilter.h"
#include "vtkUnstructuredGrid.h"

#include <array>
#include <limits>
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

/// The points of an image where the medium has no gas.
std::vector<bool> solidsOf(vtkImageData* flow, vtkDataObject* bodies)
{
  filters::MediumMaker maker;
  maker.settings.IndexModel = MediumSettings::REFRACTIVITY;
  maker.settings.Arrays[MediumSettings::IndexArray].name = "N";
  const auto source = maker.make(maker.choose(flow), bodies)->Source;
  schlieren::Lattice lattice;
  const std::array<double, 9> direction = source->direction();
  const double* first = flow->GetPoint(0);
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    lattice.points[axis] = flow->GetDimensions()[axis];
    lattice.spacing[axis] = flow->GetSpacing()[axis];
    lattice.first[axis] =
      direction[axis] * first[0] + direction[3 + axis] * first[1] + direction[6 + axis] * first[2];
  }
  const auto size = static_cast<std::size_t>(lattice.size());
  std::vector<double> n(size);
  std::vector<schlieren::Place> places(size);
  source->sample(lattice, n.data(), places.data(), nullptr);
  std::vector<bool> solids;
  for (const schlieren::Place place : places)
  {
    solids.push_back(place == schlieren::Place::Wall);
  }
  return solids;
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

// Point by point, on a grid with another origin, extent, direction and voxels that are no cubes.
TEST(Bodies, PointsInsideAreSolidOnAnyGrid)
{
  vtkNew<vtkImageData> image;
  image->SetExtent(3, 33, -7, 40, 100, 125);
  image->SetSpacing(0.04, 0.03, 0.05);
  vtkNew<vtkMatrix3x3> direction;
  const double c = std::cos(0.7), s = std::sin(0.7);
  const double rotation[9] = { c, -s, 0, s, c, 0, 0, 0, 1 };
  std::copy_n(rotation, 9, direction->GetData());
  image->SetDirectionMatrix(direction);
  Vec middle;
  image->TransformContinuousIndexToPhysicalPoint(18, 16.5, 112.5, middle.data());
  image->SetOrigin(-middle[0], -middle[1], -middle[2]);
  addPointArray(image, "N", gas);
  const Vec centre{ 0.02, 0.05, -0.03 };
  const double radius = 0.31;
  const std::vector<bool> solids = solidsOf(image, sphere(radius, centre));
  int count = 0;
  for (std::size_t i = 0; i < solids.size(); ++i)
  {
    Vec x;
    image->GetPoint(static_cast<vtkIdType>(i), x.data());
    const double r = std::hypot(x[0] - centre[0], x[1] - centre[1], x[2] - centre[2]);
    if (std::abs(r - radius) > 0.15 * 0.05) // a way to a neighbour may cut through the sphere
    {
      ASSERT_EQ(solids[i], r < radius) << r;
      count += solids[i];
    }
  }
  EXPECT_GT(count, 1000);
}

TEST(Bodies, AnyOrientationIsTaken)
{
  vtkNew<vtkReverseSense> reverse;
  reverse->SetInputData(sphere(0.5));
  reverse->Update();
  EXPECT_EQ(solidsOf(uniform(), reverse->GetOutput()), solidsOf(uniform(), sphere(0.5)));
}

TEST(Bodies, BodiesMayOverlapNestAndReachOut)
{
  const std::vector<vtkSmartPointer<vtkPolyData>> parts = { sphere(0.5), sphere(0.2),
    sphere(0.4, { 0.5, 0, 0 }), box({ 1, 0.55, 0.77 }, { 1, -0.8, 0.1 }),
    sphere(0.3, { 5, 0, 0 }) };
  vtkNew<vtkMultiBlockDataSet> blocks;
  std::vector<bool> any(41 * 41 * 41, false);
  for (const auto& part : parts)
  {
    if (part != parts.back())
    {
      const std::vector<bool> one = solidsOf(uniform(), part);
      std::transform(any.begin(), any.end(), one.begin(), any.begin(), std::logical_or<bool>());
    }
    blocks->SetBlock(blocks->GetNumberOfBlocks(), part);
  }
  EXPECT_EQ(solidsOf(uniform(), together(parts)), any);
  EXPECT_EQ(solidsOf(uniform(), blocks), any);
}

namespace
{

/// Looks from a random direction and expects light to be blocked at all pixels whose line of sight goes
/// through the parallelogram, but for 1.5 voxels at its sides. Returns the number of these pixels.
int expectNoLeaks(const vtkSmartPointer<vtkPolyData>& body, const Vec& o, const Vec& p,
  const Vec& q, std::mt19937& random)
{
  std::uniform_real_distribution<double> any(-1, 1);
  Vec direction = unit({ any(random), any(random), any(random) });
  const Vec up = unit({ any(random), any(random), any(random) });
  auto filter = benchWith(uniform(33), body, 200);
  filter->SetViewDirection(direction.data());
  filter->SetViewUp(up.data());
  filter->SetSamplesPerPixel(1);
  filter->Update();
  const std::vector<double> blocked = valuesOf(filter, "BlockedFraction");
  auto* image = vtkImageData::SafeDownCast(filter->GetOutputDataObject(0));
  const Axes axes(direction, up);
  // o + s (p - o) + t (q - o) as seen: two equations for s and t.
  const Vec a{ p[0] - o[0], p[1] - o[1], p[2] - o[2] }, b{ q[0] - o[0], q[1] - o[1], q[2] - o[2] };
  const double au = dot(a, axes.u), av = dot(a, axes.v), bu = dot(b, axes.u), bv = dot(b, axes.v);
  const double det = au * bv - av * bu;
  const double area = std::sqrt(dot(cross(a, b), cross(a, b)));
  if (std::abs(det) < 0.1 * area)
  {
    return 0; // edge on
  }
  const double edge = 1.5 * 2. / 32;
  const double fromA = edge * std::sqrt(dot(a, a)) / area,
               fromB = edge * std::sqrt(dot(b, b)) / area;
  int crossed = 0;
  for (std::size_t i = 0; i < blocked.size(); ++i)
  {
    const double* x = image->GetPoint(static_cast<vtkIdType>(i));
    const double u = x[0] - dot(o, axes.u), v = x[1] - dot(o, axes.v);
    const double s = (u * bv - v * bu) / det, t = (v * au - u * av) / det;
    if (std::min(s, 1 - s) > fromB && std::min(t, 1 - t) > fromA)
    {
      ++crossed;
      EXPECT_EQ(blocked[i], 1) << "direction " << direction[0] << " " << direction[1] << " "
                               << direction[2];
    }
  }
  return crossed;
}

} // namespace

TEST(Bodies, NoRaySlipsThroughASheet)
{
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-0.2, 0.2);
  int crossed = 0;
  for (int i = 0; i < 6; ++i)
  {
    const Vec o{ any(random), any(random), any(random) };
    const Vec p{ o[0] + any(random), o[1] + any(random), o[2] + 0.5 };
    const Vec q{ o[0] + 0.5, o[1] - 0.5, o[2] + any(random) };
    crossed += expectNoLeaks(plate(o, p, q), o, p, q, random);
  }
  EXPECT_GT(crossed, 1000);
}

/// Of a body, somewhere and turned somehow, with three corners of a rectangle within it.
int expectNoLeaksTurned(vtkPolyData* body, const std::array<Vec, 3>& corners, std::mt19937& random)
{
  std::uniform_real_distribution<double> any(-1, 1);
  vtkNew<vtkTransform> transform;
  transform->RotateWXYZ(180 * any(random), any(random), any(random), any(random));
  transform->Translate(0.1 * any(random), 0.1 * any(random), 0.1 * any(random));
  vtkNew<vtkTransformPolyDataFilter> turn;
  turn->SetTransform(transform);
  turn->SetInputData(body);
  turn->Update();
  std::array<Vec, 3> turned;
  for (std::size_t i = 0; i < 3; ++i)
  {
    transform->TransformPoint(corners[i].data(), turned[i].data());
  }
  return expectNoLeaks(turn->GetOutput(), turned[0], turned[1], turned[2], random);
}

// Closed, but thinner than a voxel (0.0625), at any angle.
TEST(Bodies, NoRaySlipsThroughAThinBody)
{
  std::mt19937 random(11);
  int crossed = 0;
  for (const double voxels : { 0.01, 0.3, 0.9, 1.2, 1.6, 2. })
  {
    crossed += expectNoLeaksTurned(box({ 1, 0.8, voxels * 0.0625 }),
      { { { -0.5, -0.4, 0 }, { 0.5, -0.4, 0 }, { -0.5, 0.4, 0 } } }, random);
  }
  EXPECT_GT(crossed, 3000);
}

namespace
{

/// A prism along z, of the polygon with these corners (x, y) in order, convex or not.
vtkSmartPointer<vtkPolyData> prism(const std::vector<std::array<double, 2>>& corners, double half)
{
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> polygons;
  const auto n = static_cast<vtkIdType>(corners.size());
  for (const double z : { -half, half })
  {
    for (const auto& corner : corners)
    {
      points->InsertNextPoint(corner[0], corner[1], z);
    }
  }
  for (const vtkIdType first : { vtkIdType{ 0 }, n })
  {
    polygons->InsertNextCell(static_cast<int>(n));
    for (vtkIdType i = 0; i < n; ++i)
    {
      polygons->InsertCellPoint(first + i);
    }
  }
  for (vtkIdType i = 0; i < n; ++i)
  {
    const vtkIdType next = (i + 1) % n;
    polygons->InsertNextCell({ i, next, n + next, n + i });
  }
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  data->SetPolys(polygons);
  return data;
}

} // namespace

// From thick to thin: a wedge that ends in an edge, and a thin fin on a wall.
TEST(Bodies, NoRaySlipsThroughWhereThickBecomesThin)
{
  std::mt19937 random(5);
  int crossed = 0;
  for (const double thin : { 0., 0.01, 0.05 })
  {
    const auto wedge =
      prism({ { -0.5, -0.15 }, { 0.5, -thin }, { 0.5, thin }, { -0.5, 0.15 } }, 0.4);
    const auto fin =
      prism({ { -0.5, -0.4 }, { -0.3, -0.4 }, { -0.3, -thin - 0.001 }, { 0.5, -thin - 0.001 },
              { 0.5, thin }, { -0.3, thin }, { -0.3, 0.4 }, { -0.5, 0.4 } },
        0.4);
    for (const auto& body : { wedge, fin })
    {
      for (int i = 0; i < 2; ++i)
      {
        crossed += expectNoLeaksTurned(
          body, { { { -0.5, 0, -0.4 }, { 0.5, 0, -0.4 }, { -0.5, 0, 0.4 } } }, random);
      }
    }
  }
  EXPECT_GT(crossed, 3000);
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
