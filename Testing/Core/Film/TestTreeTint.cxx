// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Rays gather the gradients of fields in the leaves of a tree.
#include "AnalyticSources.h"
#include "Fields.h"
#include "Medium/Medium.h"
#include "Rays/Cpu/CpuTracer.h"
#include "Rays/March/MakeTask.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace schlieren
{

namespace
{

using Source = std::shared_ptr<const MediumSource>;

Field tintedFieldOf(const Source& source)
{
  Field field = fieldOf(source);
  field.gradients = { source->fields(), nullptr, field.version };
  return field;
}

/// Cells that are finest in the middle.
class CalmSource : public AnalyticSource
{
public:
  double refractivity(double, double, double) const override { return 0; }
  Range rangeOver(const Box&) const override { return { 0, 0 }; }
  double cellSizeOver(const Box&) const override { return 1e-3; }
};

Source withFields(const Source& medium, const std::vector<FieldFormula>& fields)
{
  return std::make_shared<SourceWithFields>(medium, fields);
}

/// Faint enough for rays to be straight.
Source balls() { return std::make_shared<BallsSource>(threeBalls(1e-6)); }

TreeSettings settingsOf(double tolerance, Interpolation interpolation)
{
  TreeSettings settings;
  settings.tolerance = tolerance;
  settings.interpolation = interpolation;
  return settings;
}

/// What rays through the pixels' centres of an orthographic view gather: first as RaySettings say by default.
template <class Real = float>
struct Gathering
{
  Gathering(const Source& source, const Vector& direction, double tolerance,
    Interpolation interpolation = Interpolation::Quadratic)
    : field(tintedFieldOf(source))
    , medium(buildTree<Real>(field, settingsOf(tolerance, interpolation)))
  {
    View view;
    view.viewDirection = direction;
    view.viewUp = { 0.1, 1, 0.2 };
    view.width = pass.columns;
    view.height = pass.rows;
    view.parallelScale = 0.95;
    frame = frameOf(field.grid, view);
    light = collimatedLight(field.grid, frame);
    refine(medium, { light.u, light.v, { 0, 0 }, { 2, 2 }, 0.002 }, {});
    statistics = medium.tree->statistics();
    RaySettings rays;
    rays.kernel.interpolation = interpolation;
    trace(rays);
  }

  void trace(const RaySettings& rays, Simd simd = bestSimd())
  {
    traced.resize(pass, field.gradients.count);
    traceOnCpu(
      makeTask<Real>(medium, medium.gradientsOf(field), light, rays), pass, traced, 2, {}, simd);
  }

  /// The largest difference of what a field lets rays gather from truth(a place of the ray, its direction).
  template <class Truth>
  double worst(int number, const Truth& truth) const
  {
    double largest = 0;
    for (std::size_t ray = 0; ray < traced.exits.size(); ++ray)
    {
      const auto column = static_cast<double>(static_cast<int>(ray) % pass.columns);
      const auto row = static_cast<double>(static_cast<int>(ray) / pass.columns);
      const auto at = [&](std::size_t axis)
      {
        return (frame.origin[0] + column * frame.pixelSize) * frame.u[axis] +
          (frame.origin[1] + row * frame.pixelSize) * frame.v[axis];
      };
      const double gathered =
        static_cast<double>(traced.gathered[ray * static_cast<std::size_t>(field.gradients.count) +
          static_cast<std::size_t>(number)]);
      const double expected = truth(
        Vec3<double>{ at(0), at(1), at(2) }, Vec3<double>{ frame.w[0], frame.w[1], frame.w[2] });
      const double difference = std::abs(gathered - expected);
      if (!std::isnan(expected)) // else it does not matter
      {
        largest = std::isfinite(difference) ? std::max(largest, difference) : HUGE_VAL;
      }
    }
    return largest;
  }

  static constexpr Pass pass{ 0, 0, 48, 40, { 0, 0 } };
  Field field;
  Medium<Real> medium;
  Frame frame;
  Light light;
  MediumStatistics statistics;
  TracedPass traced;
};

/// How long a line is within the cube from -1 to 1.
double lengthInCube(const Vec3<double>& place, const Vec3<double>& direction)
{
  const double x[3] = { place.x, place.y, place.z };
  const double d[3] = { direction.x, direction.y, direction.z };
  double from = -HUGE_VAL, to = HUGE_VAL;
  for (int axis = 0; axis < 3; ++axis)
  {
    if (std::abs(d[axis]) < 1e-12)
    {
      to = std::abs(x[axis]) > 1 ? -HUGE_VAL : to;
      continue;
    }
    const double a = (-1 - x[axis]) / d[axis], b = (1 - x[axis]) / d[axis];
    from = std::max(from, std::min(a, b));
    to = std::min(to, std::max(a, b));
  }
  return std::max(0., to - from);
}

/// Of |grad exp(-(r / width)^2)| along a line, by a midpoint rule.
double gatheredOfBall(const std::array<double, 3>& centre, double width, const Vec3<double>& place,
  const Vec3<double>& direction)
{
  const Vec3<double> from = place - Vec3<double>{ centre[0], centre[1], centre[2] };
  const double along = dot(from, direction);
  const double square = dot(from, from) - along * along;
  constexpr int steps = 400;
  const double step = 12 * width / steps;
  double sum = 0;
  for (int n = 0; n < steps; ++n)
  {
    const double s = (n + 0.5) * step - 6 * width;
    const double r2 = (square + s * s) / (width * width);
    sum += step * 2 * std::sqrt(r2) / width * std::exp(-r2);
  }
  return sum;
}

const std::vector<Vector> directions{ { 0, 0, -1 }, { 1, 0, 0 }, { 0.3, -0.5, -0.8 } };

std::vector<KernelChoice> someKernelsOf(Interpolation interpolation)
{
  std::vector<KernelChoice> kernels{ { PathModel::Straight, Integrator::Leapfrog, interpolation } };
  if (interpolation == Interpolation::Quadratic)
  {
    for (const Integrator integrator : { Integrator::Leapfrog, Integrator::Adaptive })
    {
      kernels.push_back({ PathModel::Refracted, integrator, interpolation });
    }
  }
  return kernels;
}

} // namespace

// Leaves of several levels beside each other, some of them uniform in N: none is passed by, none counts twice.
TEST(TreeTint, GathersALinearFieldExactlyAcrossLevels)
{
  const Source source =
    withFields(balls(), { linearField({ 1.5, 0, 0 }), linearField({ 0.3, -0.4, 1.2 }) });
  for (const Interpolation interpolation : allInterpolations)
  {
    for (const Vector& direction : directions)
    {
      Gathering<> gathering(source, direction, 0.001, interpolation);
      EXPECT_GE(gathering.statistics.finestLevel - gathering.statistics.coarsestLevel, 3);
      for (const KernelChoice& kernel : someKernelsOf(interpolation))
      {
        SCOPED_TRACE(std::string(name(kernel.interpolation)) + ", integrator " +
          std::to_string(static_cast<int>(kernel.integrator)));
        RaySettings settings;
        settings.kernel = kernel;
        settings.stepVoxels = 0.7;
        settings.adaptiveTolerance = 1e-3;
        gathering.trace(settings);
        EXPECT_LT(
          gathering.worst(0, [](const auto& x, const auto& d) { return 1.5 * lengthInCube(x, d); }),
          2e-4);
        EXPECT_LT(
          gathering.worst(1, [](const auto& x, const auto& d) { return 1.3 * lengthInCube(x, d); }),
          2e-4);
      }
    }
  }
}

// In gas that is the same everywhere: leaves are as fine as the field needs.
TEST(TreeTint, TheErrorIsWithinTheTolerance)
{
  const std::array<double, 3> centre{ 0.2, -0.1, 0.15 };
  const Source medium = std::make_shared<CalmSource>();
  for (const double width : { 0.3, 0.05 })
  {
    const Source source = withFields(medium, { ballField(centre, width) });
    for (const Vector& direction : directions)
    {
      std::int64_t bricks = 0;
      for (const double tolerance : { 0.1, 0.02, 0.005 })
      {
        const Gathering<> gathering(source, direction, tolerance);
        const double worst = gathering.worst(
          0, [&](const auto& x, const auto& d) { return gatheredOfBall(centre, width, x, d); });
        // Through its middle a ray gathers 2.
        EXPECT_LT(worst, 2 * tolerance) << "width " << width << ", tolerance " << tolerance;
        EXPECT_GT(gathering.statistics.constantLeaves, 0);
        EXPECT_GT(gathering.statistics.bricks, bricks);
        bricks = gathering.statistics.bricks;
      }
    }
  }
}

TEST(TreeTint, IsTheSameForPacksOfRays)
{
  const Source source =
    withFields(balls(), { ballField({ 0, 0.1, 0 }, 0.3), linearField({ 0.3, -0.4, 1.2 }) });
  const auto compare = [](auto&& gathering, Interpolation interpolation, double allowed)
  {
    for (const KernelChoice& kernel : someKernelsOf(interpolation))
    {
      RaySettings settings;
      settings.kernel = kernel;
      settings.adaptiveTolerance = 1e-3;
      gathering.trace(settings, Simd::None);
      const std::vector<float> one = gathering.traced.gathered;
      gathering.trace(settings);
      const std::vector<float>& packs = gathering.traced.gathered;
      ASSERT_EQ(one.size(), packs.size());
      std::size_t differ = 0;
      for (std::size_t i = 0; i < one.size(); ++i)
      {
        const double difference = static_cast<double>(one[i]) - static_cast<double>(packs[i]);
        differ += std::abs(difference) <= allowed ? 0 : 1;
      }
      // Steps begin at leaves, where rounding may decide.
      EXPECT_LE(differ, one.size() / 50);
    }
  };
  for (const Interpolation interpolation : allInterpolations)
  {
    compare(Gathering<float>(source, directions.back(), 0.02, interpolation), interpolation, 2e-5);
    compare(Gathering<double>(source, directions.back(), 0.02, interpolation), interpolation, 2e-6);
  }
}

// Gas ends at x = 0.3 in a window: what is beyond counts for nothing, and next to it nothing is missing.
TEST(TreeTint, GathersNothingOutsideOfTheGas)
{
  const Source source =
    withFields(std::make_shared<HalfSource>(0, 1e-9, 0.3, 0.02), { linearField({ 0, 0.5, 1 }) });
  const Gathering<> across(source, { 0, 0, -1 }, 0.01);
  constexpr double voxel = 0.02; // beside the edge, where rays may be on either side of it
  EXPECT_LT(across.worst(0,
              [&](const auto& x, const auto&)
              {
                return std::abs(x.x - 0.3) < voxel || std::max(std::abs(x.x), std::abs(x.y)) > 1
                  ? std::nan("")
                  : (x.x < 0.3 ? 2 * std::sqrt(1.25) : 0);
              }),
    2e-4);
}

// Fields that vary nowhere change nothing, to the last bit.
TEST(TreeTint, UniformFieldsLeaveTheImageAsItIs)
{
  const Source plain = balls();
  const Source uniform = withFields(plain, { linearField({ 0, 0, 0 }) });
  Scene scene;
  scene.view.viewDirection = { 0.3, -0.5, -0.8 };
  scene.view.width = scene.view.height = 60;
  scene.samplesPerPixel = 1;
  scene.device = Device::Cpu;
  const Image without = Bench().render(tintedFieldOf(plain), scene);
  scene.fieldColors = { { 1, 0, 0 } };
  const Image with = Bench().render(tintedFieldOf(uniform), scene);
  // But for rounding: rays that gather fields take their steps in another loop.
  ASSERT_EQ(without.deflection.size(), with.deflection.size());
  float largest = 0, difference = 0;
  for (std::size_t i = 0; i < with.deflection.size(); ++i)
  {
    largest = std::max(largest, std::abs(without.deflection[i]));
    difference = std::max(difference, std::abs(with.deflection[i] - without.deflection[i]));
  }
  EXPECT_LT(difference, 1e-5 * largest);
  EXPECT_EQ(without.stepsTaken, with.stepsTaken);
  EXPECT_EQ(without.medium.bricks, with.medium.bricks);
  for (std::size_t i = 0; i < with.color.size(); ++i)
  {
    EXPECT_EQ(with.color[i], with.intensity[i / 3]);
  }
}

TEST(TreeTint, KeepsToItsMemoryAndDoesNotDependOnThreads)
{
  const Source source = withFields(balls(),
    { ballField({ 0.2, 0.1, 0 }, 0.03), ballField({ -0.3, 0.1, 0.4 }, 0.05),
      linearField({ 0.1, 0, 0.1 }) });
  const Field field = tintedFieldOf(source);
  Scene scene;
  scene.view.width = scene.view.height = 250;
  scene.samplesPerPixel = 1;
  scene.mediumTolerance = 0.002;
  scene.device = Device::Cpu;
  scene.fieldColors = { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } };
  constexpr std::int64_t memory = 12 << 20;
  scene.mediumMemory = memory;
  scene.threads = 1;
  const Image one = Bench().render(field, scene);
  EXPECT_LE(one.medium.bytes, memory);
  EXPECT_GT(one.medium.bytes, memory / 2);
  EXPECT_TRUE(one.medium.isMemoryShort);
  scene.threads = 3;
  const Image three = Bench().render(field, scene);
  EXPECT_EQ(one.color, three.color);
  EXPECT_EQ(one.medium.bytes, three.medium.bytes);
}

TEST(TreeTint, AsManyColoursAsTheSourceHasFields)
{
  Field field = tintedFieldOf(withFields(balls(), { linearField({ 1, 0, 0 }) }));
  Scene scene;
  scene.device = Device::Cpu;
  scene.fieldColors = { { 1, 0, 0 }, { 0, 1, 0 } };
  EXPECT_THROW(Bench().render(field, scene), Error);
  field.gradients.count = 2;
  EXPECT_THROW(Bench().render(field, scene), Error);
}

namespace
{

class TreeTintOnDevice : public OnDevice
{
};

} // namespace

// In leaves of all sizes, the colour is that of the gradients' mixture.
TEST_P(TreeTintOnDevice, FieldsMixByTheirGradients)
{
  const Source source =
    withFields(balls(), { linearField({ 0, 0.3, -0.4 }), linearField({ 1.5, 0, 0 }) });
  Scene scene;
  scene.fieldColors = { { 1, 0, 0 }, { 0.25f, 0.5f, 1 } };
  scene.view.width = scene.view.height = 60;
  scene.view.focalPoint = Vector{ 0.42, -0.31, 0.2 };
  scene.view.parallelScale = 0.2;
  scene.samplesPerPixel = 1;
  scene.kScale = 1000;
  scene.mediumTolerance = 0.02;
  scene.device = GetParam();
  const Image image = Bench().render(tintedFieldOf(source), scene);
  EXPECT_GE(image.medium.finestLevel - image.medium.coarsestLevel, 2);
  const std::array<double, 3> mixture{ (0.5 + 1.5 * 0.25) / 2, 1.5 * 0.5 / 2, 1.5 / 2 };
  for (int row = 0; row < image.height; ++row)
  {
    for (int column = 0; column < image.width; ++column)
    {
      const std::size_t pixel = pixelOf(image, column, row);
      for (std::size_t channel = 0; channel < 3; ++channel)
      {
        EXPECT_NEAR(double{ image.color[3 * pixel + channel] } / double{ image.intensity[pixel] },
          mixture[channel], 2e-4);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Devices, TreeTintOnDevice, bothDevices(), deviceName);

} // namespace schlieren
