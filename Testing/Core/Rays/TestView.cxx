// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// Where things appear in the image, and to which side light bends there.
#include "Fields.h"

#include <algorithm>

namespace schlieren
{

namespace
{

double dotProduct(const Vector& a, const Vector& b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

struct NamedView
{
  const char* label;
  Vector direction, up;
  Vector u, v; ///< expected; written down by hand for the axis-aligned views
};

std::vector<NamedView> allViews()
{
  const double h = std::sqrt(0.5);
  const double t = std::sqrt(1. / 3);
  const double s = std::sqrt(1. / 6);
  return {
    { "front", { 0, 0, -1 }, { 0, 1, 0 }, { 1, 0, 0 }, { 0, 1, 0 } },
    { "back", { 0, 0, 1 }, { 0, 1, 0 }, { -1, 0, 0 }, { 0, 1, 0 } },
    { "right", { -1, 0, 0 }, { 0, 0, 1 }, { 0, 1, 0 }, { 0, 0, 1 } },
    { "left", { 1, 0, 0 }, { 0, 0, 1 }, { 0, -1, 0 }, { 0, 0, 1 } },
    { "top", { 0, -1, 0 }, { 1, 0, 0 }, { 0, 0, 1 }, { 1, 0, 0 } },
    { "bottom", { 0, 2, 0 }, { 0, 0, 5 }, { 1, 0, 0 }, { 0, 0, 1 } },
    { "edge", { -1, 0, -1 }, { 0, 1, 0 }, { h, 0, -h }, { 0, 1, 0 } },
    { "corner", { -1, -1, -1 }, { 0, 0, 1 }, { -h, h, 0 }, { -s, -s, 2 * s } },
    { "corner with slanted up", { -t, -t, -t }, { 1, 2, 3 }, { -s, 2 * s, -s }, { -h, 0, h } },
  };
}

/// Length of the line through (u, v) along w inside the cube of half edge 1.
double chordThrough(const Frame& frame, const PixelCentre& at)
{
  double from = -10, to = 10;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double start = at.u * frame.u[axis] + at.v * frame.v[axis];
    const double along = frame.w[axis];
    if (std::abs(along) < 1e-12)
    {
      if (std::abs(start) > 1)
      {
        return 0;
      }
      continue;
    }
    const double a = (-1 - start) / along;
    const double b = (1 - start) / along;
    from = std::max(from, std::min(a, b));
    to = std::min(to, std::max(a, b));
  }
  return std::max(0., to - from);
}

class Views : public OnDevice
{
};

/// A field that grows along one image axis bends light to that side: eps = L grad n / n.
TEST_P(Views, LightBendsTowardsHigherIndex)
{
  for (const NamedView& view : allViews())
  {
    SCOPED_TRACE(view.label);
    for (const bool alongU : { true, false })
    {
      SCOPED_TRACE(alongU ? "growing along u" : "growing along v");
      const double slope = 1e-6;
      const Vector axis = alongU ? view.u : view.v;
      SampledField<float> medium(cube(16, 1),
        [&](double x, double y, double z) {
          return slope * dotProduct(axis, { x, y, z });
        });
      medium.field.ambient = 0;
      Scene scene;
      scene.device = GetParam();
      scene.samplesPerPixel = 1;
      scene.view.viewDirection = view.direction;
      scene.view.viewUp = view.up;
      scene.view.width = 24;
      scene.view.height = 20;
      const Image image = Bench().render(medium.field, scene);
      for (std::size_t i = 0; i < 3; ++i)
      {
        EXPECT_NEAR(image.frame.u[i], view.u[i], 1e-12);
        EXPECT_NEAR(image.frame.v[i], view.v[i], 1e-12);
        EXPECT_NEAR(dotProduct(image.frame.w, view.direction),
          -std::sqrt(dotProduct(view.direction, view.direction)), 1e-12);
      }
      for (int row = 0; row < image.height; ++row)
      {
        for (int column = 0; column < image.width; ++column)
        {
          const double expected = slope * chordThrough(image.frame, centreOf(image, column, row));
          const std::size_t pixel = pixelOf(image, column, row);
          const std::size_t main = alongU ? 0 : 1;
          EXPECT_NEAR(image.deflection[2 * pixel + main], expected, 2e-5 * slope);
          EXPECT_NEAR(image.deflection[2 * pixel + 1 - main], 0, 2e-5 * slope);
        }
      }
    }
  }
}

/// A bright spot's centre of gravity in the image is its place in space, to a hundredth of a pixel.
void expectSpotInPlace(
  const Grid& grid, const Vector& place, double radius, const View& view, Device device)
{
  SampledField<double> medium(grid,
    [&](double x, double y, double z)
    {
      const Vector d = { x - place[0], y - place[1], z - place[2] };
      return 1e-6 * std::exp(-dotProduct(d, d) / (radius * radius));
    });
  medium.field.ambient = 0;
  Scene scene;
  scene.device = device;
  scene.samplesPerPixel = 1;
  scene.view = view;
  const Image image = Bench().render(medium.field, scene);
  double sum = 0, sumU = 0, sumV = 0;
  for (int row = 0; row < image.height; ++row)
  {
    for (int column = 0; column < image.width; ++column)
    {
      const double light = image.opticalPathDifference[pixelOf(image, column, row)];
      sum += light;
      sumU += light * column;
      sumV += light * row;
    }
  }
  const Frame& frame = image.frame;
  EXPECT_NEAR(sumU / sum, (dotProduct(place, frame.u) - frame.origin[0]) / frame.pixelSize, 0.01);
  EXPECT_NEAR(sumV / sum, (dotProduct(place, frame.v) - frame.origin[1]) / frame.pixelSize, 0.01);
}

TEST_P(Views, ThingsAppearWhereTheyAre)
{
  for (const NamedView& named : allViews())
  {
    SCOPED_TRACE(named.label);
    View view;
    view.viewDirection = named.direction;
    view.viewUp = named.up;
    view.width = 90;
    view.height = 70;
    expectSpotInPlace(cube(48, 1), { 0.21, -0.13, 0.34 }, 0.15, view, GetParam());
  }
}

TEST_P(Views, RotatedGridsAndUnequalSpacings)
{
  Grid grid;
  grid.dimensions = { 40, 50, 60 };
  grid.spacing = { 0.06, 0.05, 0.03 };
  grid.origin = { 5, -3, 2 };
  const double c = std::cos(0.7), s = std::sin(0.7);
  grid.direction = { c, -s, 0, s, c, 0, 0, 0, 1 };
  const double i = 1.1, j = 1.3, k = 0.8;
  const Vector place = { 5 + c * i - s * j, -3 + s * i + c * j, 2 + k };
  for (const NamedView& named : allViews())
  {
    SCOPED_TRACE(named.label);
    View view;
    view.viewDirection = named.direction;
    view.viewUp = named.up;
    view.width = 90;
    view.height = 70;
    expectSpotInPlace(grid, place, 0.2, view, GetParam());
  }
}

TEST_P(Views, OriginsFarFromZero)
{
  Grid grid = cube(48, 0.001 * 23.5, { 1e7, -1e7, 3e6 });
  View view;
  view.width = 90;
  view.height = 70;
  expectSpotInPlace(grid, { 1e7 + 0.004, -1e7 - 0.003, 3e6 }, 0.004, view, GetParam());
}

INSTANTIATE_TEST_SUITE_P(, Views, bothDevices(), deviceName);

TEST(Frame, FitsTheDataAndCentresPixels)
{
  Grid grid;
  grid.dimensions = { 11, 6, 3 };
  View view;
  view.width = 40;
  view.height = 10;
  const Frame frame = frameOf(grid, view); // 10 x 5 data units: the height decides
  EXPECT_DOUBLE_EQ(frame.pixelSize, 0.5);
  EXPECT_DOUBLE_EQ(frame.origin[0], 5 - 19.5 * 0.5);
  EXPECT_DOUBLE_EQ(frame.origin[1], 0.25);
  EXPECT_DOUBLE_EQ(frame.entry, 0);
  EXPECT_DOUBLE_EQ(frame.exit, 2);
  view.width = 10; // now the width decides
  EXPECT_DOUBLE_EQ(frameOf(grid, view).pixelSize, 1);
  view.parallelScale = 20;
  EXPECT_DOUBLE_EQ(frameOf(grid, view).pixelSize, 4);
  view.focalPoint = Vector{ 100, 200, 0 };
  EXPECT_DOUBLE_EQ(frameOf(grid, view).origin[0], 100 - 4.5 * 4);
  EXPECT_DOUBLE_EQ(frameOf(grid, view).origin[1], 200 - 4.5 * 4);
}

} // namespace

} // namespace schlieren
