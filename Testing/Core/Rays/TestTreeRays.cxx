// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Rays through the leaves of a tree, against closed forms.
#include "AnalyticSources.h"
#include "Fields.h"
#include "Medium/Medium.h"
#include "Rays/Cpu/CpuTracer.h"
#include "Rays/March/MakeTask.h"
#include "TreeRays.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>
#include <string>
#include <vector>

namespace schlieren
{

namespace
{

const std::vector<Vector> someDirections{ { 0, 0, -1 }, { 1, 0, 0 }, { 0.3, -0.5, -0.8 } };

/// A ball with a wall around gas that is the same everywhere.
class BodySource : public AnalyticSource
{
public:
  explicit BodySource(double radius, double half)
    : AnalyticSource(half)
    , radius_(radius)
  {
  }
  double refractivity(double, double, double) const override { return 1e-4; }
  Range rangeOver(const Box&) const override { return { 1e-4, 1e-4 }; }
  double cellSizeOver(const Box&) const override { return 0.01 * radius_; }
  static double length(double a, double b, double c) { return std::sqrt(a * a + b * b + c * c); }
  Place placeAt(double a, double b, double c) const override
  {
    return length(a, b, c) < radius_ ? Place::Wall : Place::Gas;
  }
  double distanceAt(double a, double b, double c) const override
  {
    return length(a, b, c) - radius_;
  }
  void findPlaces(const Box& box, Content& content) const override
  {
    const Range r = distancesTo({ 0, 0, 0 }, box);
    content.hasWall = r.first < radius_;
    content.hasGas = r.second > radius_;
  }

private:
  double radius_;
};

/// A cube with sharp edges around the origin, in such gas.
class CubeSource : public BodySource
{
public:
  explicit CubeSource(double halfEdge, double half)
    : BodySource(halfEdge, half)
    , halfEdge_(halfEdge)
  {
  }
  Place placeAt(double a, double b, double c) const override
  {
    return distanceAt(a, b, c) < 0 ? Place::Wall : Place::Gas;
  }
  double distanceAt(double a, double b, double c) const override
  {
    const double x = std::abs(a) - halfEdge_, y = std::abs(b) - halfEdge_,
                 z = std::abs(c) - halfEdge_;
    return length(std::max(x, 0.), std::max(y, 0.), std::max(z, 0.)) +
      std::min(std::max({ x, y, z }), 0.);
  }
  void findPlaces(const Box& box, Content& content) const override
  {
    content.hasWall = true;
    content.hasGas = false;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      content.hasWall = content.hasWall && box.low[axis] < halfEdge_ && box.high[axis] > -halfEdge_;
      content.hasGas = content.hasGas || box.low[axis] < -halfEdge_ || box.high[axis] > halfEdge_;
    }
  }
  /// Whether a straight line meets a cube that is larger by so much.
  bool isMet(const Vec3<double>& from, const Vec3<double>& along, double larger) const
  {
    const double edge = halfEdge_ + larger;
    const double x[3] = { from.x, from.y, from.z }, d[3] = { along.x, along.y, along.z };
    double first = -1e9, last = 1e9;
    for (int axis = 0; axis < 3; ++axis)
    {
      const double step = std::abs(d[axis]) > 1e-9 ? d[axis] : 1e-9;
      const double one = (-edge - x[axis]) / step, other = (edge - x[axis]) / step;
      first = std::max(first, std::min(one, other));
      last = std::min(last, std::max(one, other));
    }
    return first < last;
  }

private:
  double halfEdge_;
};

} // namespace

class RaysInATree : public OnDevice
{
};

TEST_P(RaysInATree, AreBentAsTheFormulaSays)
{
  // Ten pixels wide and more.
  const auto source = std::make_shared<BallsSource>(std::vector<Ball>{
    { { -0.1, 0.05, 0.02 }, 0.25, 1e-7 }, { { 0.32, -0.31, 0.2 }, 0.12, 0.5e-7 } });
  for (const Vector& direction : someDirections)
  {
    for (const double tolerance : { 2e-3, 7e-4 })
    {
      for (const Precision precision : { Precision::Single, Precision::Double })
      {
        Scene scene = shadowgraphOf(direction, GetParam());
        scene.mediumTolerance = tolerance;
        scene.precision = precision;
        scene.pathModel = PathModel::Refracted;
        const Image image = Bench().render(fieldOf(source), scene);
        double worst = 0;
        for (int row = 0; row < image.height; ++row)
        {
          for (int column = 0; column < image.width; ++column)
          {
            const PixelCentre at = centreOf(image, column, row);
            const Vec3<double> u = vec(image.frame.u), v = vec(image.frame.v);
            const auto expected = source->deflectionAt(at.u * u + at.v * v, u, v);
            const std::size_t pixel = 2 * pixelOf(image, column, row);
            for (std::size_t i = 0; i < 2; ++i)
            {
              worst = std::max(
                worst, std::abs(static_cast<double>(image.deflection[pixel + i]) - expected[i]));
            }
          }
        }
        EXPECT_LT(worst, 2 * tolerance * source->largestDeflection())
          << direction[0] << " tolerance " << tolerance;
        EXPECT_GT(image.medium.finestLevel, image.medium.coarsestLevel);
      }
    }
  }
}

TEST_P(RaysInATree, ConserveTheirMomentumInAStrongMedium)
{
  const auto source =
    std::make_shared<BallsSource>(std::vector<Ball>{ { { 0.1, 0, -0.05 }, 0.4, 0.05 } });
  for (const Integrator integrator : { Integrator::Leapfrog, Integrator::Adaptive })
  {
    std::vector<Image> images;
    for (const double step : { 1., 0.25 })
    {
      Scene scene = shadowgraphOf({ 0.3, -0.5, -0.8 }, GetParam());
      scene.view.width = 40;
      scene.view.height = 30;
      scene.precision = Precision::Double;
      scene.mediumTolerance = 1e-3;
      scene.integrator = integrator;
      scene.adaptiveTolerance = 1e-7;
      scene.stepSize = step;
      images.push_back(Bench().render(fieldOf(source), scene));
      EXPECT_EQ(images.back().raysLost, 0);
      EXPECT_LT(images.back().momentumDrift, 2e-4) << static_cast<int>(integrator) << ' ' << step;
    }
    double largest = 0, difference = 0;
    for (std::size_t i = 0; i < images[0].deflection.size(); ++i)
    {
      largest = std::max(largest, std::abs(static_cast<double>(images[1].deflection[i])));
      difference = std::max(difference,
        std::abs(static_cast<double>(images[0].deflection[i] - images[1].deflection[i])));
    }
    EXPECT_GT(largest, 0.05);
    EXPECT_LT(difference, 2e-3 * largest) << static_cast<int>(integrator);
  }
}

TEST_P(RaysInATree, EndAtWalls)
{
  const auto source = std::make_shared<BodySource>(0.4, 1);
  Scene scene = shadowgraphOf({ 0.3, -0.5, -0.8 }, GetParam());
  scene.view.width = scene.view.height = 400;
  scene.view.parallelScale = 0.5;
  const Image image = Bench().render(fieldOf(source), scene);
  const auto [area, worst] = shadowOfDisc(image, 0.4);
  EXPECT_NEAR(area, std::acos(-1.) * 0.16, 3e-3 * area);
  EXPECT_LT(worst, 0.1); // pixels
}

TEST_P(RaysInATree, DoNotMissSharpEdges)
{
  const auto source = std::make_shared<CubeSource>(0.3, 1);
  for (const Vector& direction : { Vector{ 1, 1, 0 }, Vector{ 1, 0.2, 0.1 }, Vector{ 1, 1, 1 } })
  {
    for (const int size : { 100, 400 })
    {
      Scene scene = shadowgraphOf(direction, GetParam());
      scene.view.viewUp = { 0, 0, 1 };
      scene.view.width = scene.view.height = size;
      scene.view.parallelScale = 0.6;
      const Image image = Bench().render(fieldOf(source), scene);
      const Vec3<double> u = vec(image.frame.u), v = vec(image.frame.v), d = vec(direction);
      // By how much the cube seems to be smaller or larger, in pixels.
      double smaller = 0, larger = 0;
      for (int row = 0; row < image.height; ++row)
      {
        for (int column = 0; column < image.width; ++column)
        {
          const PixelCentre at = centreOf(image, column, row);
          const Vec3<double> from = at.u * u + at.v * v;
          const bool isBlocked = image.blockedFraction[pixelOf(image, column, row)] > 0.5f;
          const auto isMet = [&](double pixels)
          { return source->isMet(from, d, pixels * image.frame.pixelSize); };
          while (!isBlocked && isMet(-smaller - 0.01))
          {
            smaller += 0.01;
          }
          while (isBlocked && !isMet(larger + 0.01))
          {
            larger += 0.01;
          }
        }
      }
      EXPECT_LT(smaller, 0.05) << direction[1] << " " << size;
      EXPECT_LT(larger, 0.08) << direction[1] << " " << size;
    }
  }
}

/// Voxels of some pixels, between which distances are linear, make spheres neither smaller nor larger.
TEST_P(RaysInATree, SeeWholeSpheres)
{
  for (const double height : { 3., 6. })
  {
    Scene scene = shadowgraphOf({ 1, 0.3, 0.2 }, GetParam());
    scene.view.parallelScale = height;
    scene.view.width = scene.view.height = 60;
    scene.samplesPerPixel = 16;
    const Image image = Bench().render(fieldOf(std::make_shared<SphereSource>()), scene);
    const double pixels =
      std::accumulate(image.blockedFraction.begin(), image.blockedFraction.end(), 0.);
    const double radius = 1 / image.frame.pixelSize;
    EXPECT_NEAR(std::sqrt(pixels / pi), radius, 0.01) << height;
  }
}

TEST_P(RaysInATree, GoStraightOnWhereThereIsNoGas)
{
  constexpr double border = 0.213, slope = 1e-4, n0 = 5e-4;
  const auto source = std::make_shared<HalfSource>(n0, slope, border, 0.02);
  Field field = fieldOf(source);
  field.ambient = 0;
  Scene scene = shadowgraphOf({ 0, 0, -1 }, GetParam());
  scene.view.viewUp = { 0, 1, 0 };
  for (const PathModel path : { PathModel::Straight, PathModel::Refracted })
  {
    scene.pathModel = path;
    const Image image = Bench().render(field, scene);
    for (int row = 0; row < image.height; row += 7)
    {
      for (int column = 0; column < image.width; column += 3)
      {
        const PixelCentre at = centreOf(image, column, row);
        const std::size_t pixel = pixelOf(image, column, row);
        if (std::abs(at.u - border) < 2 * image.frame.pixelSize)
        {
          continue;
        }
        const bool isGas = at.u < border;
        const double n = n0 + slope * at.v;
        EXPECT_NEAR(image.opticalPathDifference[pixel], isGas ? 2 * n : 0, 2e-7) << at.u;
        EXPECT_NEAR(image.deflection[2 * pixel + 1], isGas ? 2 * slope : 0, isGas ? 1e-6 : 0)
          << at.u;
      }
    }
  }
  // Across the border: half of the voxel in which it lies is the error.
  scene.view.viewDirection = { -1, 0, 0 };
  scene.mediumTolerance = 1e-3;
  const Image image = Bench().render(field, scene);
  const std::size_t middle = pixelOf(image, image.width / 2, image.height / 2);
  const double path = 1 + border;
  EXPECT_NEAR(image.deflection[2 * middle + 1], path * slope, slope * image.medium.smallestVoxel);
  EXPECT_EQ(image.blockedFraction[middle], 0);
}

// Where rounding may keep a ray on a side of the domain, or of a leaf.
TEST_P(RaysInATree, ArriveAlongTheSidesOfLeaves)
{
  const auto source = std::make_shared<BallsSource>(
    std::vector<Ball>{ { { 0, 0.5, -0.9 }, 0.05, -1e-8 }, { { 0, 0.5, 0.1 }, 0.05, -1e-8 } });
  for (const double side : { -1., 0., 0.125 })
  {
    Scene scene = shadowgraphOf({ 0, 1, 0 }, GetParam());
    scene.view.viewUp = { 0, 0, 1 };
    scene.view.width = 65;
    scene.view.height = 5;
    scene.view.focalPoint = Vector{ 0, 0, side };
    scene.view.parallelScale = 0.04;
    scene.pathModel = PathModel::Refracted;
    const Image image = Bench().render(fieldOf(source), scene);
    EXPECT_EQ(image.raysLost, 0) << side;
    EXPECT_LT(image.stepsTaken, 400 * image.raysTraced) << side;
  }
}

/// A sphere in cells that are as large as it is.
class SphereInLargeCells : public SphereSource
{
public:
  double cellSizeOver(const Box&) const override { return 1; }
};

TEST_P(RaysInATree, EndAtSilhouettesHoweverLargeCellsAre)
{
  const auto source = std::make_shared<SphereInLargeCells>();
  for (const double scale : { 1.5, 0.3, 0.05 })
  {
    Scene scene = shadowgraphOf({ 0, 0, -1 }, GetParam());
    scene.view.viewUp = { 0, 1, 0 };
    scene.view.parallelScale = scale;
    scene.view.focalPoint = Vector{ 0.8, 0.6, 0 };
    const Image image = Bench().render(fieldOf(source), scene);
    int beside = 0;
    for (int row = 0; row < image.height; ++row)
    {
      for (int column = 0; column < image.width; ++column)
      {
        const PixelCentre at = centreOf(image, column, row);
        const double outside = (std::hypot(at.u, at.v) - 1) / image.frame.pixelSize;
        beside += std::abs(outside) < 3 ? 1 : 0;
        if (std::abs(outside) > 0.2)
        {
          const float blocked = image.blockedFraction[pixelOf(image, column, row)];
          EXPECT_EQ(blocked, outside < 0 ? 1.f : 0.f) << outside << " pixels, scale " << scale;
        }
      }
    }
    EXPECT_GT(beside, 300);
  }
}

INSTANTIATE_TEST_SUITE_P(Devices, RaysInATree, bothDevices(), deviceName);

TEST(RaysSideBySideInATree, DoWhatOneDoes)
{
  expectPacksToDoWhatOneDoes(fieldOf(std::make_shared<BallsSource>(threeBalls(1e-3))));
}

} // namespace schlieren
