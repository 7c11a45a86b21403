// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Where gas ends: how far from walls the points of lattices are.
#include "BoundaryMeshes.h"

#include "Cells/LinearCells.h"

#include "vtkPolyData.h"
#include "vtkReverseSense.h"
#include "vtkSphereSource.h"
#include "vtkTransform.h"
#include "vtkTransformPolyDataFilter.h"
#include "vtkXMLUnstructuredGridReader.h"

#include <random>

namespace
{

/// What a ray sees of a lattice: distances with 15 bits, interpolated trilinearly.
class Samples
{
public:
  Samples(const GasBoundary& boundary, const Lattice& lattice,
    const std::function<bool(const Vec&)>& isInCell)
    : places(static_cast<std::size_t>(lattice.size()))
    , distances(places.size())
    , lattice_(lattice)
  {
    std::vector<unsigned char> inCell(places.size());
    for (std::size_t i = 0; i < places.size(); ++i)
    {
      inCell[i] = isInCell(this->point(i)) ? 1 : 0;
    }
    boundary.sample(lattice, inCell.data(), places.data(), distances.data());
  }

  Vec point(std::size_t i) const
  {
    const auto n = static_cast<int>(i);
    const int nx = lattice_.points[0], ny = lattice_.points[1];
    const int at[3] = { n % nx, n / nx % ny, n / nx / ny };
    Vec x;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      x[axis] = lattice_.first[axis] + at[axis] * lattice_.spacing[axis];
    }
    return x;
  }
  double at(const Vec& x) const
  {
    std::size_t first[3];
    double part[3];
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const double at = (x[axis] - lattice_.first[axis]) / lattice_.spacing[axis];
      first[axis] =
        static_cast<std::size_t>(std::clamp(std::floor(at), 0., lattice_.points[axis] - 2.));
      part[axis] = at - static_cast<double>(first[axis]);
    }
    double sum = 0;
    for (unsigned corner = 0; corner < 8; ++corner)
    {
      double weight = 1;
      std::size_t at[3];
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        const unsigned upper = corner >> axis & 1;
        weight *= upper ? part[axis] : 1 - part[axis];
        at[axis] = first[axis] + upper;
      }
      const auto nx = static_cast<std::size_t>(lattice_.points[0]);
      const auto ny = static_cast<std::size_t>(lattice_.points[1]);
      sum += weight * std::round(8192 * distances[(at[2] * ny + at[1]) * nx + at[0]]) / 8192;
    }
    return sum;
  }
  /// Whether light goes from one place to another.
  bool lets(const Vec& from, const Vec& to, double step) const
  {
    Vec line{ to[0] - from[0], to[1] - from[1], to[2] - from[2] };
    const double length = std::sqrt(dot(line, line));
    const int steps = static_cast<int>(std::ceil(length / step));
    for (int i = 0; i <= steps; ++i)
    {
      const double s = static_cast<double>(i) / steps;
      if (this->at({ from[0] + s * line[0], from[1] + s * line[1], from[2] + s * line[2] }) < 0)
      {
        return false;
      }
    }
    return true;
  }

  std::vector<Place> places;
  std::vector<float> distances;

private:
  Lattice lattice_;
};

Lattice latticeAround(const Vec& middle, const Vec& half, double h)
{
  Lattice lattice;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    lattice.points[axis] = static_cast<int>(2 * half[axis] / h) + 1;
    lattice.spacing[axis] = h;
    lattice.first[axis] = middle[axis] - half[axis] + 0.123 * h;
  }
  return lattice;
}

} // namespace

// Where distances change sign along rays through the sphere's middle.
TEST(GasBoundary, SphereIsWhereItIs)
{
  const auto mesh = sphereMesh(120, 4);
  const GasBoundary boundary = boundaryOfLeaves({ mesh }, nullptr, Outside::Auto, {});
  for (const double h : { 0.04, 0.02 })
  {
    double worst = 0, sum = 0;
    int rays = 0;
    for (const Vec& to : { Vec{ 1, 0, 0 }, Vec{ 0.6, 0.64, 0.48 }, Vec{ 0, -0.6, 0.8 } })
    {
      const Lattice lattice = latticeAround(to, { 10 * h, 10 * h, 10 * h }, h);
      const Samples samples(boundary, lattice, [](const Vec& x) { return dot(x, x) > 1; });
      for (double y = -3 * h; y <= 3 * h; y += 0.47 * h)
      {
        for (double z = -3 * h; z <= 3 * h; z += 0.47 * h)
        {
          const Vec along = unit({ to[0] + y, to[1] + z, to[2] + y - z });
          double low = 1 - 3 * h, high = 1 + 3 * h;
          EXPECT_LT(samples.at({ low * along[0], low * along[1], low * along[2] }), 0);
          for (int i = 0; i < 40; ++i)
          {
            const double r = 0.5 * (low + high);
            (samples.at({ r * along[0], r * along[1], r * along[2] }) < 0 ? low : high) = r;
          }
          worst = std::max(worst, std::abs(low - 1) / h);
          sum += (low - 1) / h;
          ++rays;
        }
      }
    }
    EXPECT_LT(worst, 0.02);
    EXPECT_LT(std::abs(2 * h * sum / rays), 0.003);
  }
}

namespace
{

Data gasAround()
{
  auto image = cube(5, 10);
  addPointArray(image, "N", [](const Vec&) { return 1; });
  image->GetPointData()->SetActiveScalars("N");
  return Data(image);
}

bool always(const Vec&) { return true; }

} // namespace

// Plates within the mesh, thinner than a voxel, in any direction; rays through them that keep clear of the rims.
TEST(GasBoundary, NothingLeaksThroughThinPlates)
{
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-1, 1);
  int rays = 0;
  for (const double thickness : { 0., 0.01, 0.3, 0.7, 1., 1.5 }) // voxels
  {
    for (int turned = 0; turned < 5; ++turned)
    {
      // A box of gas with a plate left out, or a sheet in the gas.
      const double h = 0.1;
      auto body = thickness > 0 ? box({ 1.6, 1.6, thickness * h })
                                : plate({ -0.8, -0.8, 0 }, { 0.8, -0.8, 0 }, { -0.8, 0.8, 0 });
      const Vec axis = unit({ any(random), any(random), any(random) });
      const Vec shift{ 0.1 * any(random), 0.1 * any(random), 0.1 * any(random) };
      vtkNew<vtkTransform> transform;
      if (turned > 0) // else along the lattice
      {
        transform->Translate(shift.data());
        transform->RotateWXYZ(180 * any(random), axis.data());
      }
      vtkNew<vtkTransformPolyDataFilter> turn;
      turn->SetTransform(transform);
      turn->SetInputData(body);
      turn->Update();
      const Data gas = gasAround();
      const GasBoundary boundary = boundaryOfLeaves({ gas }, turn->GetOutput(), Outside::Auto, {});
      Lattice lattice = latticeAround({ 0, 0, 0 }, { 1.2, 1.2, 1.2 }, h);
      if (turned == 0)
      {
        lattice.first = { -1.2, -1.2, -1.2 }; // with points on the plate
      }
      const Samples samples(boundary, lattice, always);
      for (int ray = 0; ray < 200; ++ray)
      {
        Vec from{ 0.6 * any(random), 0.6 * any(random), 0.3 },
          to{ 0.6 * any(random), 0.6 * any(random), -0.3 };
        transform->TransformPoint(from.data(), from.data());
        transform->TransformPoint(to.data(), to.data());
        EXPECT_FALSE(samples.lets(from, to, 0.1 * h)) << thickness << " " << turned;
        EXPECT_FALSE(samples.lets(from, to, 0.45 * h)) << thickness << " " << turned;
        // Beside it there is gas.
        Vec back{ from[0], from[1], from[2] };
        EXPECT_GT(samples.at(back), 0) << thickness << " " << turned;
        ++rays;
      }
    }
  }
  EXPECT_EQ(rays, 6 * 5 * 200);
}

TEST(GasBoundary, PlatesAreAboutAVoxelThick)
{
  const double h = 0.1;
  const Data gas = gasAround();
  for (double z = 0; z < 0.1; z += 0.013)
  {
    const auto sheet = plate({ -0.8, -0.8, z }, { 0.8, -0.8, z }, { -0.8, 0.8, z });
    const GasBoundary boundary = boundaryOfLeaves({ gas }, sheet, Outside::Auto, {});
    const Samples samples(boundary, latticeAround({ 0, 0, 0 }, { 1.2, 1.2, 1.2 }, h), always);
    double thickness = 0, deepest = 0;
    for (double at = -0.5; at < 0.5; at += 0.001)
    {
      const double distance = samples.at({ 0.03, 0.04, at });
      thickness += distance < 0 ? 0.001 / h : 0;
      deepest = std::min(deepest, distance);
    }
    EXPECT_NEAR(thickness, 1, 0.4) << z;
    EXPECT_LT(deepest, -0.4) << z;
  }
}

// Distances from a box's faces are exact; at its edges the silhouette misses by a part of a voxel.
TEST(GasBoundary, ABoxKeepsItsFacesAndEdges)
{
  const double h = 0.1;
  const auto isGas = [](const Vec& x) {
    return std::max({ std::abs(x[0]), std::abs(x[1]), std::abs(x[2]) }) > 0.5;
  };
  const Data gas = gasAround();
  const GasBoundary boundary = boundaryOfLeaves({ gas }, box({ 1, 1, 1 }), Outside::Auto, {});
  const Lattice lattice = latticeAround({ 0, 0, 0 }, { 1, 1, 1 }, h);
  const Samples samples(boundary, lattice, always);
  for (std::size_t i = 0; i < samples.places.size(); ++i)
  {
    const Vec x = samples.point(i);
    EXPECT_EQ(samples.places[i], isGas(x) ? Place::Gas : Place::Wall);
    const double depth = 0.5 - std::max({ std::abs(x[0]), std::abs(x[1]), std::abs(x[2]) });
    double outside = 0;
    for (const double coordinate : x)
    {
      outside += std::pow(std::max(0., std::abs(coordinate) - 0.5), 2);
    }
    const double truth = std::clamp((depth > 0 ? -depth : std::sqrt(outside)) / h, -3., 3.);
    EXPECT_NEAR(samples.distances[i], truth, 1e-3);
  }
  double worst = 0; // of a line of sight along z
  for (double x = 0.3; x < 0.7; x += 0.003)
  {
    for (double y = 0.3; y < 0.7; y += 0.003)
    {
      const bool isStopped = samples.at({ x, y, 0.01 }) < 0;
      const double d = std::max(x, y) - 0.5;
      worst = std::max(worst, isStopped == (d < 0) ? 0. : std::abs(d) / h);
    }
  }
  EXPECT_LT(worst, 0.5);
}

TEST(GasBoundary, ClosedBodiesAreSolidHoweverTheyAreTurned)
{
  const Data gas = gasAround();
  vtkNew<vtkSphereSource> source;
  source->SetRadius(1);
  source->SetThetaResolution(60);
  source->SetPhiResolution(60);
  source->Update();
  vtkNew<vtkReverseSense> reverse;
  reverse->SetInputConnection(source->GetOutputPort());
  reverse->Update();
  vtkNew<vtkMultiBlockDataSet> nested;
  nested->SetBlock(0, source->GetOutput());
  nested->SetBlock(1, box({ 0.5, 0.5, 0.5 }));
  nested->SetBlock(2, box({ 1, 0.2, 0.2 }, { 1, 0, 0 }));
  const Lattice lattice = latticeAround({ 0, 0, 0 }, { 1.3, 1.3, 1.3 }, 0.1);
  const GasBoundary one = boundaryOfLeaves({ gas }, source->GetOutput(), Outside::Auto, {});
  const GasBoundary turned = boundaryOfLeaves({ gas }, reverse->GetOutput(), Outside::Auto, {});
  const GasBoundary several = boundaryOfLeaves({ gas }, nested, Outside::Auto, {});
  const Samples a(one, lattice, always), b(turned, lattice, always), c(several, lattice, always);
  EXPECT_EQ(a.distances, b.distances);
  for (std::size_t i = 0; i < a.places.size(); ++i)
  {
    const Vec x = a.point(i);
    const double r = std::sqrt(dot(x, x));
    if (std::abs(r - 1) > 0.01)
    {
      EXPECT_EQ(a.places[i], r < 1 ? Place::Wall : Place::Gas);
    }
    EXPECT_NEAR(a.distances[i], std::clamp((r - 1) / 0.1, -3., 3.), 0.03);
    const bool isInBar = std::abs(x[0] - 1) < 0.5 && std::max(std::abs(x[1]), std::abs(x[2])) < 0.1;
    EXPECT_EQ(c.places[i], isInBar ? Place::Wall : a.places[i]);
  }
  EXPECT_EQ(one.kindAt({ 0.1, 0.2, 0 }, true), Place::Wall);
  EXPECT_EQ(one.kindAt({ 3, 0.2, 0 }, true), Place::Gas);
  EXPECT_TRUE(one.facesIn({ { 0.9, -0.1, -0.1 }, { 1.1, 0.1, 0.1 } }).wall);
  EXPECT_FALSE(one.facesIn({ { -0.5, -0.5, -0.5 }, { 0.5, 0.5, 0.5 } }).wall);
  EXPECT_TRUE(one.facesIn({ { 9, 9, 9 }, { 11, 11, 11 } }).window);
}

// The sphere from inside its mesh, a box within the sphere, and places outside of the far field.
TEST(GasBoundary, PlacesOutsideAreOfTheNearestFace)
{
  const Data mesh = sphereMesh(30, 4);
  const GasBoundary boundary = boundaryOfLeaves({ mesh }, nullptr, Outside::Auto, {});
  const auto isIn = [](const Vec& x) { return dot(x, x) > 1 && dot(x, x) < 16; };
  EXPECT_EQ(boundary.kindAt({ 0, 0, 0.1 }, false), Place::Wall);
  EXPECT_EQ(boundary.kindAt({ 0, 4.1, 0.1 }, false), Place::Window);
  const Samples inside(boundary, latticeAround({ 0, 0, 0 }, { 0.4, 0.4, 0.4 }, 0.1), isIn);
  const Samples outside(boundary, latticeAround({ 4, 4, 4 }, { 1, 1, 1 }, 0.1), isIn);
  const Samples far(boundary, latticeAround({ 4.2, 0, 0 }, { 1, 1, 1 }, 0.1), isIn);
  const Samples near(boundary, latticeAround({ 0, 0, 0 }, { 1.5, 1.5, 1.5 }, 0.1), isIn);
  const Samples gas(boundary, latticeAround({ 2.5, 0, 0 }, { 0.4, 0.4, 0.4 }, 0.1), isIn);
  for (const auto& [samples, kind] :
    { std::pair(&inside, Place::Wall), std::pair(&outside, Place::Window),
      std::pair(&far, Place::Window), std::pair(&near, Place::Wall), std::pair(&gas, Place::Gas) })
  {
    for (std::size_t i = 0; i < samples->places.size(); ++i)
    {
      EXPECT_EQ(samples->places[i], isIn(samples->point(i)) ? Place::Gas : kind);
    }
  }
  EXPECT_EQ(inside.distances[100], -3);
  EXPECT_EQ(gas.distances[100], 3);
}

TEST(GasBoundary, AmbientIsThatOfTheFarField)
{
  auto mesh = sphereMesh(20, 4);
  addPointArray(mesh, "N", [](const Vec& x) { return dot(x, x) < 15 ? 7 : (x[0] > 2 ? 3 : 2); });
  mesh->GetPointData()->SetActiveScalars("N");
  const std::vector<Data> joined = withSharedPoints({ mesh });
  for (const Outside outside : { Outside::Auto, Outside::Blocks, Outside::Passes })
  {
    EXPECT_EQ(
      boundaryOfLeaves(pointers(joined), nullptr, outside, {}).ambient(pointers(joined)), 2);
  }
}

// Where blocks meet there is gas, also if their points differ, and if curved sides leave gaps.
TEST(GasBoundary, GasContinuesFromBlockToBlock)
{
  const auto ring = [](double from, double to, int around)
  {
    return Data(curvilinear(5, around + 1, 5,
      [&](double i, double j, double k)
      {
        const double r = from + i * (to - from), phi = pi / 2 * j;
        return Vec{ r * std::cos(phi), r * std::sin(phi), k };
      }));
  };
  const std::vector<Data> hanging = { ring(1, 2, 8), ring(2, 3, 16) };
  const std::vector<Data> overlapping = { ring(1, 2.2, 8), ring(1.9, 3, 13) };
  for (const std::vector<Data>& blocks : { hanging, overlapping })
  {
    const Cells cells(blocks);
    const GasBoundary boundary =
      boundaryOfLeaves(pointers(blocks), nullptr, Outside::Auto, cells.test());
    for (const double h : { 0.1, 0.02 })
    {
      const double size = std::min(0.4, 15 * h);
      const Samples samples(boundary, latticeAround({ 1.43, 1.41, 0.5 }, { size, size, size }, h),
        [&](const Vec& x) { return cells.hold(x); });
      for (std::size_t i = 0; i < samples.places.size(); ++i)
      {
        const Vec x = samples.point(i);
        EXPECT_EQ(samples.places[i], cells.hold(x) ? Place::Gas : Place::Window);
        EXPECT_GE(samples.distances[i], -1.f / 4096);
        const double toSide =
          std::min({ x[2], 1 - x[2], std::hypot(x[0], x[1]) - 1, 3 - std::hypot(x[0], x[1]) }) / h;
        EXPECT_TRUE(toSide < 4 || samples.distances[i] == 3 || !cells.hold(x)) << toSide;
      }
    }
  }
}

// Cells of higher order with hanging nodes.
TEST(GasBoundary, CurvedCellsHaveNoWallsWithin)
{
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName(shared("blob_lagrange_hex.vtu").c_str());
  reader->Update();
  const Data mesh = filters::asLinearCells(withScalars(reader->GetOutput()));
  double b[6];
  mesh->GetBounds(b);
  const double lengths[3] = { b[1] - b[0], b[3] - b[2], b[5] - b[4] };
  const auto isWithin = [&](const Vec& x) // it fills its box
  {
    return x[0] > b[0] && x[0] < b[1] && x[1] > b[2] && x[1] < b[3] && x[2] > b[4] && x[2] < b[5];
  };
  const double box =
    2 * (lengths[0] * lengths[1] + lengths[1] * lengths[2] + lengths[2] * lengths[0]);
  expectAreas(areasOf(boundaryOfLeaves({ mesh }, nullptr, Outside::Auto, isWithin)), 0, box, 1e-4);
}

// The fin, half of which is modelled, opens in the plane of symmetry and in the plate that it stands on. Far from its
// sides, all that is above the plate is within it, however fine the lattice is.
TEST(GasBoundary, BodiesThatOpenInTwoSidesOfTheBoxAreWallUpToTheirEdge)
{
  const Data mesh = bluntFin(); // half as thick as 0.5, from y = 0 on; the plate is at z = 0
  const GasBoundary boundary = boundaryOfLeaves({ mesh }, nullptr, Outside::Auto, {});
  for (const double h : { 0.002, 0.0075, 0.015, 0.02 })
  {
    const Samples samples(boundary, { { 2, h / 2, h / 2 }, { h, h, h }, { 18, 18, 18 } },
      [](const Vec&) { return false; });
    for (std::size_t i = 0; i < samples.places.size(); ++i)
    {
      ASSERT_EQ(samples.places[i], Place::Wall) << h << " " << i;
    }
    const double below = -h / 2;
    const Samples around(boundary, { { 2, below, below }, { h, h, h }, { 18, 18, 18 } },
      [](const Vec&) { return false; });
    for (std::size_t i = 0; i < around.places.size(); ++i)
    {
      const Vec x = around.point(i);
      ASSERT_TRUE(x[1] < 0 || x[2] < 0 || around.places[i] == Place::Wall) << h << " " << i;
    }
  }
}

// A cylinder from side to side of its mesh: what is beside its ends is known from the nearest face.
TEST(GasBoundary, BesideTheEndsOfAProfileIsWindow)
{
  const Data mesh = curvilinear(31, 65, 3,
    [](double i, double j, double k)
    {
      const double r = std::pow(5, i);
      return Vec{ r * std::cos(2 * pi * j), r * std::sin(2 * pi * j), k };
    });
  const GasBoundary boundary = boundaryOfLeaves({ mesh }, nullptr, Outside::Auto, {});
  const auto isIn = [](const Vec& x) { return std::hypot(x[0], x[1]) > 1 && x[2] > 0 && x[2] < 1; };
  const Samples samples(boundary, latticeAround({ 1, 0, 0 }, { 0.8, 0.8, 0.8 }, 0.1), isIn);
  for (std::size_t i = 0; i < samples.places.size(); ++i)
  {
    const Vec x = samples.point(i);
    const double r = std::hypot(x[0], x[1]);
    const bool isBehind = r < 1 && -x[2] < 1 - r;
    const bool isWithinReach = std::hypot(1 - r, std::min(x[2], 0.)) < 0.29;
    if (isWithinReach && std::abs(-x[2] - (1 - r)) > 0.02)
    {
      EXPECT_EQ(samples.places[i], isIn(x) ? Place::Gas : (isBehind ? Place::Wall : Place::Window))
        << x[0] << " " << x[1] << " " << x[2];
    }
  }
}

// Holes in meshes that are thinner than a voxel.
TEST(GasBoundary, NothingLeaksThroughThinHoles)
{
  const double h = 0.1;
  std::mt19937 random(5);
  std::uniform_real_distribution<double> any(-1, 1);
  for (const double thickness : { 0.02, 0.05, 0.12 })
  {
    // Cells of any thickness; those in the middle are left out but at the rim.
    const auto z = [&](double k)
    { return std::abs(k - 0.5) < 0.06 ? std::copysign(thickness / 2, k - 0.5) : 4 * (k - 0.5); };
    auto mesh = curvilinear(21, 21, 22,
      [&](double i, double j, double k) {
        return Vec{ 4 * i - 2, 4 * j - 2, z(k) };
      });
    addCellArray(mesh, "gas",
      [&](const Vec& x)
      { return std::abs(x[2]) > 1e-9 || std::max(std::abs(x[0]), std::abs(x[1])) > 1 ? 1 : 0; });
    const Data holed = gasOf(mesh);
    turn(asPoints(holed));
    const Cells cells({ holed });
    const GasBoundary boundary = boundaryOfLeaves({ holed }, nullptr, Outside::Auto, {});
    EXPECT_NEAR(areasOf(boundary).wall, 8 + 8 * thickness, 1e-6);
    const Samples samples(boundary, latticeAround({ 0, 0, 0 }, { 1.5, 1.5, 1.5 }, h),
      [&](const Vec& x) { return cells.hold(x); });
    for (int ray = 0; ray < 300; ++ray)
    {
      const Vec from = turned({ 0.8 * any(random), 0.8 * any(random), 0.3 });
      const Vec to = turned({ 0.8 * any(random), 0.8 * any(random), -0.3 });
      EXPECT_FALSE(samples.lets(from, to, 0.45 * h)) << thickness;
    }
  }
}

// Around a prism of many sides: lines between two points of the gas may cut off its edges.
TEST(GasBoundary, NearlyPlaneWallsAreNoThickerThanTheyAre)
{
  constexpr int sides = 24;
  const auto mesh = curvilinear(5, sides + 1, 5,
    [](double i, double j, double k)
    {
      const double r = 0.7 + i;
      return Vec{ r * std::cos(2 * pi * j), r * std::sin(2 * pi * j), 2 * k - 1 };
    });
  turn(mesh);
  const Cells cells({ mesh });
  const GasBoundary boundary = boundaryOfLeaves({ mesh }, nullptr, Outside::Auto, {});
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-0.05, 0.05);
  for (int i = 0; i < 2; ++i)
  {
    const Samples samples(boundary,
      latticeAround({ any(random), any(random), any(random) }, { 0.9, 0.9, 0.5 }, 0.05),
      [&](const Vec& x) { return cells.hold(x); });
    int thicker = 0, within = 0;
    for (std::size_t n = 0; n < samples.places.size(); ++n)
    {
      const bool isGas = cells.hold(samples.point(n));
      within += isGas ? 1 : 0;
      thicker += isGas && samples.places[n] != Place::Gas ? 1 : 0;
    }
    EXPECT_GT(within, 10000);
    EXPECT_EQ(thicker, 0);
  }
}

// Two plates that meet in an edge, at any angle; rays from outside to between them.
TEST(GasBoundary, NothingLeaksIntoFolds)
{
  const double h = 0.1;
  for (unsigned int seed = 1; seed <= 2; ++seed)
  {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> any(-1, 1);
    for (const double angle : { 10., 15., 20., 25., 30., 40., 60., 90., 150. })
    {
      const double s = std::sin(angle * pi / 360), c = std::cos(angle * pi / 360);
      for (int i = 0; i < 3; ++i)
      {
        vtkNew<vtkMultiBlockDataSet> fold; // along y, its edge at o
        const Vec o{ 0.1 * any(random), 0, 0.1 * any(random) };
        fold->SetBlock(0, plate({ o[0], -1, o[2] }, { o[0], 1, o[2] }, { o[0] + s, -1, o[2] - c }));
        fold->SetBlock(1, plate({ o[0], -1, o[2] }, { o[0], 1, o[2] }, { o[0] - s, -1, o[2] - c }));
        const GasBoundary boundary = boundaryOfLeaves({ gasAround() }, fold, Outside::Auto, {});
        const Samples samples(boundary, latticeAround({ 0, 0, 0 }, { 1.2, 0.5, 1.2 }, h), always);
        int leaks = 0;
        for (int ray = 0; ray < 100; ++ray)
        {
          const Vec from{ o[0] + 0.3 * any(random), 0.3 * any(random), o[2] + 0.3 };
          const Vec to{ o[0] + 0.5 * s * any(random), 0.3 * any(random), o[2] - 0.6 };
          leaks += samples.lets(from, to, 0.2 * h) ? 1 : 0;
        }
        EXPECT_EQ(leaks, 0) << seed << " " << angle << " " << i;
      }
    }
  }
}
