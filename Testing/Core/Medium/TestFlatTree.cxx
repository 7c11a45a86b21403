// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Trees of leaves of one layer, for data of which nothing depends on z.
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
#include <string>
#include <vector>

namespace schlieren
{

namespace
{

struct Column2d
{
  double x, y, width, height; ///< N = height exp(-(r / width)^2)
};

Box flat(Box box)
{
  box.low[2] = box.high[2] = 0;
  return box;
}

/// Columns with Gaussian profiles in a far field, around a wall of radius 1 or none.
class ColumnsSource : public AnalyticSource
{
public:
  ColumnsSource(std::vector<Column2d> columns, double half, double depth, double wall = 0)
    : AnalyticSource(half)
    , columns_(std::move(columns))
    , sections_(ballsOf(columns_))
    , depth_(depth)
    , wall_(wall)
  {
  }

  bool isFlat() const override { return true; }
  Box bounds() const override
  {
    return { { -half_, -half_, -0.5 * depth_ }, { half_, half_, 0.5 * depth_ } };
  }
  double refractivity(double x, double y, double z) const override
  {
    EXPECT_EQ(z, 0);
    return sections_.refractivity(x, y, 0);
  }
  Range rangeOver(const Box& box) const override { return sections_.rangeOver(flat(box)); }
  double cellSizeOver(const Box& box) const override
  {
    double size = 0.05 * half_;
    for (const Column2d& column : columns_)
    {
      const double away = distancesTo({ column.x, column.y, 0 }, flat(box)).first;
      size = std::min(size, 0.02 * std::max(column.width, away));
    }
    return wall_ > 0 ? std::min(size, 0.02 * std::max(wall_, distancesTo({}, flat(box)).first))
                     : size;
  }
  Place placeAt(double x, double y, double) const override
  {
    return std::hypot(x, y) < wall_ ? Place::Wall : Place::Gas;
  }
  double distanceAt(double x, double y, double) const override { return std::hypot(x, y) - wall_; }
  void findPlaces(const Box& box, Content& content) const override
  {
    const Range r = distancesTo({ 0, 0, 0 }, flat(box));
    content.hasWall = r.first < wall_;
    content.hasGas = r.second > wall_;
  }

  /// Of a straight ray through a place: along u and v.
  std::array<double, 2> deflectionAt(
    const Vec3<double>& place, const Vec3<double>& u, const Vec3<double>& v) const
  {
    const Vec3<double> w = cross(u, v);
    const Vec3<double> start = place - dot(place, w) * w;
    double from = -4 * half_, to = 4 * half_;
    const double at[3] = { start.x, start.y, start.z }, along[3] = { w.x, w.y, w.z };
    const double high[3] = { half_, half_, 0.5 * depth_ };
    for (int axis = 0; axis < 3; ++axis)
    {
      if (std::abs(along[axis]) < 1e-12)
      {
        to = std::abs(at[axis]) > high[axis] ? from : to;
        continue;
      }
      const double a = (-high[axis] - at[axis]) / along[axis];
      const double b = (high[axis] - at[axis]) / along[axis];
      from = std::max(from, std::min(a, b));
      to = std::min(to, std::max(a, b));
    }
    Vec3<double> sum{ 0, 0, 0 };
    constexpr int steps = 500;
    for (int n = 0; n < steps && from < to; ++n)
    {
      const Vec3<double> x = start + (from + (n + 0.5) / steps * (to - from)) * w;
      for (const Column2d& column : columns_)
      {
        const double slope = -2 * column.height / (column.width * column.width) *
          std::exp(-squareOf(column, x.x, x.y)) * (to - from) / steps;
        sum += slope * Vec3<double>{ x.x - column.x, x.y - column.y, 0 };
      }
    }
    return { dot(sum, u), dot(sum, v) };
  }

private:
  /// Cut by the plane z = 0 they are the columns.
  static std::vector<Ball> ballsOf(const std::vector<Column2d>& columns)
  {
    std::vector<Ball> balls;
    for (const Column2d& column : columns)
    {
      balls.push_back({ { column.x, column.y, 0 }, column.width, column.height });
    }
    return balls;
  }
  static double squareOf(const Column2d& column, double x, double y)
  {
    const double dx = x - column.x, dy = y - column.y;
    return (dx * dx + dy * dy) / (column.width * column.width);
  }

  std::vector<Column2d> columns_;
  BallsSource sections_;
  double depth_, wall_;
};

/// Potential flow around a cylinder of radius 1 at Mach 0.38, in a far field.
class CylinderSource : public AnalyticSource
{
public:
  CylinderSource()
    : AnalyticSource(50)
  {
  }

  static constexpr double far = 2.7e-4, mach = 0.38;

  bool isFlat() const override { return true; }
  Box bounds() const override { return { { -half_, -half_, -0.5 }, { half_, half_, 0.5 } }; }
  double ambient() const override { return far; }
  double refractivity(double x, double y, double) const override
  {
    return far * std::pow(baseAt(x, y), 2.5);
  }
  /// From places in the box: nearly exact, as that of cells is.
  Range rangeOver(const Box& box) const override
  {
    constexpr int steps = 12;
    Range range{ HUGE_VAL, -HUGE_VAL };
    for (int n = 0; n < (steps + 1) * (steps + 1); ++n)
    {
      const double x = box.low[0] + (box.high[0] - box.low[0]) * (n % (steps + 1)) / steps;
      const double y = box.low[1] + (box.high[1] - box.low[1]) * (n / (steps + 1)) / steps;
      const double here = refractivity(x, y, 0);
      range = { std::min(range.first, here), std::max(range.second, here) };
    }
    return range;
  }
  double cellSizeOver(const Box& box) const override
  {
    return 0.02 * std::max(1., distancesTo({}, flat(box)).first);
  }
  Place placeAt(double x, double y, double) const override
  {
    return std::hypot(x, y) < 1 ? Place::Wall : Place::Gas;
  }
  double distanceAt(double x, double y, double) const override { return std::hypot(x, y) - 1; }
  void findPlaces(const Box& box, Content& content) const override
  {
    const Range r = distancesTo({}, flat(box));
    content.hasWall = r.first < 1;
    content.hasGas = r.second > 1;
  }

  /// Of a straight ray along z.
  static std::array<double, 2> deflectionAt(double x, double y)
  {
    const double r4 = std::pow(x * x + y * y, 2), r6 = std::pow(x * x + y * y, 3);
    const double byBase = -0.2 * mach * mach * 2.5 * far * std::pow(baseAt(x, y), 1.5) / (1 + far);
    const double squares = x * x - y * y;
    return { byBase * (-4 * x / r6 - 4 * x / r4 + 8 * x * squares / r6),
      byBase * (-4 * y / r6 + 4 * y / r4 + 8 * y * squares / r6) };
  }

private:
  /// The density, of that far away, to the power of 0.4: isentropic.
  static double baseAt(double x, double y)
  {
    const double r2 = std::max(x * x + y * y, 1.);
    const double speed2 = 1 + 1 / (r2 * r2) - 2 * (x * x - y * y) / (r2 * r2);
    return 1 + 0.2 * mach * mach * (1 - speed2);
  }
};

Scene sceneOf(const Vector& direction, Device device = Device::Cpu)
{
  Scene scene = shadowgraphOf(direction, device);
  scene.view.parallelScale = 0.8;
  scene.view.focalPoint = Vector{ 0, 0, 0 };
  return scene;
}

const std::vector<Vector> someDirections{ { 0, 0, -1 }, { 0, 0, 1 }, { 1, 0, 0 },
  { 0.02, 0.01, -1 }, { 0.3, -0.5, -0.8 } };

const std::vector<Column2d> twoColumns{ { -0.1, 0.05, 0.4, 1e-7 }, { 0.32, -0.31, 0.3, 0.5e-7 } };

} // namespace

class RaysInAFlatTree : public OnDevice
{
};

TEST_P(RaysInAFlatTree, AreBentAsTheFormulaSays)
{
  for (const double depth : { 0.01, 30. })
  {
    const auto source = std::make_shared<ColumnsSource>(twoColumns, 40, depth);
    const Field field = fieldOf(source);
    for (const Vector& direction : someDirections)
    {
      Scene scene = sceneOf(direction, GetParam());
      scene.view.width = 81;
      scene.view.height = 61;
      scene.mediumTolerance = 3e-3;
      const Frame frame = frameOf(field.grid, scene.view);
      const Vec3<double> u = vec(frame.u), v = vec(frame.v);
      std::vector<double> expected;
      double largest = 0;
      for (int row = 0; row < scene.view.height; ++row)
      {
        for (int column = 0; column < scene.view.width; column += 3)
        {
          const double a = frame.origin[0] + column * frame.pixelSize;
          const double b = frame.origin[1] + row * frame.pixelSize;
          for (const double of : source->deflectionAt(a * u + b * v, u, v))
          {
            expected.push_back(of);
            largest = std::max(largest, std::abs(of));
          }
        }
      }
      for (const Precision precision : { Precision::Single, Precision::Double })
      {
        for (const PathModel path : { PathModel::Straight, PathModel::Refracted })
        {
          SCOPED_TRACE(std::to_string(depth) + " deep, along " + std::to_string(direction[0]) +
            (path == PathModel::Straight ? ", straight" : ", bent"));
          scene.precision = precision;
          scene.pathModel = path;
          const Image image = Bench().render(field, scene);
          double worst = 0;
          auto next = expected.begin();
          for (int row = 0; row < image.height; ++row)
          {
            for (int column = 0; column < image.width; column += 3)
            {
              const std::size_t pixel = 2 * pixelOf(image, column, row);
              for (std::size_t i = 0; i < 2; ++i)
              {
                const auto found = static_cast<double>(image.deflection[pixel + i]);
                worst = std::max(worst, std::abs(found - *next++));
              }
            }
          }
          EXPECT_LT(worst, 6e-3 * largest);
          EXPECT_LT(image.medium.bytes, 10 << 20);
          EXPECT_EQ(image.raysLost, 0);
        }
      }
    }
  }
}

// A straight ray across the layer needs no more than one step, wherever it is and however deep the layer.
TEST_P(RaysInAFlatTree, TakeNoMoreStepsThanTheyNeed)
{
  for (const double depth : { 0.01, 1., 30. })
  {
    const auto source = std::make_shared<ColumnsSource>(twoColumns, 40, depth, 0.2);
    Scene scene = sceneOf({ 0, 0, -1 }, GetParam());
    scene.pathModel = PathModel::Straight;
    const Image straight = Bench().render(fieldOf(source), scene);
    EXPECT_LE(straight.stepsTaken, straight.raysTraced) << depth;
    scene.pathModel = PathModel::Refracted;
    const Image bent = Bench().render(fieldOf(source), scene);
    EXPECT_LE(bent.stepsTaken, 5 * bent.raysTraced) << depth;
  }
}

// Where light is bent much in a layer that is deep, against short steps.
TEST_P(RaysInAFlatTree, TakeTheStepsThatBendingNeeds)
{
  const auto source =
    std::make_shared<ColumnsSource>(std::vector<Column2d>{ { 0, 0, 0.1, -3e-4 } }, 2, 5);
  Scene scene = sceneOf({ 0, 0, -1 }, GetParam());
  scene.view.parallelScale = 0.3;
  scene.pathModel = PathModel::Refracted;
  std::vector<Image> images;
  for (const double step : { 2., 0.05 })
  {
    scene.stepSize = step;
    images.push_back(Bench().render(fieldOf(source), scene));
  }
  EXPECT_GT(images[0].stepsTaken, 3 * images[0].raysTraced);
  double largest = 0, difference = 0;
  for (std::size_t i = 0; i < images[0].deflection.size(); ++i)
  {
    largest = std::max(largest, std::abs(static_cast<double>(images[1].deflection[i])));
    difference = std::max(
      difference, std::abs(static_cast<double>(images[0].deflection[i] - images[1].deflection[i])));
  }
  EXPECT_LT(difference, 4e-3 * largest);
}

TEST_P(RaysInAFlatTree, EndAtWalls)
{
  const auto source = std::make_shared<ColumnsSource>(twoColumns, 50, 1, 1);
  for (const PathModel path : { PathModel::Straight, PathModel::Refracted })
  {
    Scene scene = sceneOf({ 0, 0, -1 }, GetParam());
    scene.view.width = scene.view.height = 300;
    scene.view.parallelScale = 3;
    scene.pathModel = path;
    const Image image = Bench().render(fieldOf(source), scene);
    const auto [area, worst] = shadowOfDisc(image, 1);
    EXPECT_NEAR(area, std::acos(-1.), 5e-3 * area);
    EXPECT_LT(worst, 0.1); // pixels
  }
}

// Where an image shows nearly nothing but undisturbed gas, leaves that lack less than the tolerance must not be seen.
TEST(AutomaticK, DoesNotShowTheErrorOfTheMedium)
{
  const Field field = fieldOf(std::make_shared<CylinderSource>());
  for (const double scale : { 50., 15., 3. })
  {
    Scene scene = sceneOf({ 0, 0, -1 });
    scene.view.width = scene.view.height = 400;
    scene.view.parallelScale = scale;
    scene.cutoff = Cutoff::KnifeEdge;
    scene.mediumTolerance = 0.02;
    const Image image = Bench().render(field, scene);
    constexpr double fullScale = 0.5;
    std::vector<double> bent;
    double worst = 0;
    for (int row = 0; row < image.height; ++row)
    {
      for (int column = 0; column < image.width; ++column)
      {
        const PixelCentre at = centreOf(image, column, row);
        const std::size_t pixel = pixelOf(image, column, row);
        const Vec3<double> x = at.u * vec(image.frame.u) + at.v * vec(image.frame.v);
        if (std::hypot(x.x, x.y) < 1 + 2 * image.frame.pixelSize)
        {
          continue;
        }
        const auto [ofX, ofY] = CylinderSource::deflectionAt(x.x, x.y);
        const Vec3<double> truth{ ofX, ofY, 0 };
        const double u = dot(truth, vec(image.frame.u)), v = dot(truth, vec(image.frame.v));
        bent.push_back(std::hypot(u, v));
        if (std::hypot(x.x, x.y) > 4 && image.kScale * bent.back() < fullScale)
        {
          worst = std::max(worst,
            std::hypot(static_cast<double>(image.deflection[2 * pixel]) - u,
              static_cast<double>(image.deflection[2 * pixel + 1]) - v));
        }
      }
    }
    if (scale < 50)
    {
      // The image is full of flow: k is that of the 99th percentile, but for the pixels that are left out here.
      std::sort(bent.begin(), bent.end());
      const double percentile = bent[bent.size() * 99 / 100];
      EXPECT_NEAR(image.kScale * percentile / fullScale, 1, 0.15);
    }
    EXPECT_LT(image.kScale * worst, 0.06 * fullScale) << scale;
  }
}

INSTANTIATE_TEST_SUITE_P(Devices, RaysInAFlatTree, bothDevices(), deviceName);

TEST(RaysSideBySideInAFlatTree, DoWhatOneDoes)
{
  expectPacksToDoWhatOneDoes(fieldOf(std::make_shared<ColumnsSource>(
    std::vector<Column2d>{ { -0.1, 0.05, 0.3, 1e-3 }, { 0.32, -0.31, 0.15, 1e-3 } }, 1, 0.5)));
}

} // namespace schlieren
