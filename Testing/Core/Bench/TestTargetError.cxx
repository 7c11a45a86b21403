// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// Scene::targetError: whether the error that an image is said to have is the one that it has.
#include "AnalyticSources.h"
#include "Fields.h"
#include "TrueError.h"

#include <algorithm>
#include <cmath>
#include <memory>

namespace schlieren
{

namespace
{

double ball(double x, double y, double z) { return 1e-3 * std::exp(-6 * (x * x + y * y + z * z)); }

/// A shock of three voxels across, oblique to all axes, before a ball.
double shock(double x, double y, double z)
{
  const double across = 0.8 * x + 0.5 * y + 0.33 * z - 0.1;
  return 1e-4 * std::tanh(across / 0.05) + 3e-4 * std::exp(-8 * (x * x + y * y + z * z));
}

struct Case
{
  const char* name;
  Cutoff cutoff;
  double target;
};
void PrintTo(const Case& of, std::ostream* out) { *out << of.name; }

Scene sceneOf(const Case& of)
{
  Scene scene;
  scene.device = Device::Cpu;
  scene.cutoff = of.cutoff;
  scene.view.width = scene.view.height = 96;
  scene.view.viewDirection = { 0.3, -0.4, -1 };
  scene.wavelength = 1e-4; // ten fringes
  scene.screenDistance = 4;
  scene.background.distance = 4;
  return scene;
}

/// What settings beyond those that can be chosen make. `isInParts`: of 16 pixels for each, where paths are smooth with one ray.
Image finest(const Field& field, Scene scene, double k, bool isInParts)
{
  scene.targetError = 0;
  scene.interpolation = Interpolation::Cubic;

  scene.stepSize = 0.5;
  scene.mediumTolerance = 1e-4;
  scene.pathModel = PathModel::Refracted;
  scene.samplesPerPixel = isOfCamera(scene.cutoff) ? 1 : 64;
  if (k > 0)
  {
    scene.kScale = k;
  }
  if (!isInParts)
  {
    return Bench().render(field, scene);
  }
  const bool isOnScreen = scene.cutoff == Cutoff::Shadowgraph;
  constexpr int finer = 4;
  scene.samplesPerPixel = 1;
  Image truth = Bench().render(field, scene);
  Scene fine = scene;
  fine.view.width *= finer;
  fine.view.height *= finer;
  fine.samplesPerPixel = isOnScreen ? 16 : 1;
  const Image inParts = Bench().render(field, fine);
  for (int pixel = 0; pixel < scene.view.width * scene.view.height; ++pixel)
  {
    double light = 0;
    for (int part = 0; part < finer * finer; ++part)
    {
      const int column = pixel % scene.view.width * finer + part % finer;
      const int row = pixel / scene.view.width * finer + part / finer;
      light += static_cast<double>(
        inParts.intensity[static_cast<std::size_t>(row * fine.view.width + column)]);
    }
    truth.intensity[static_cast<std::size_t>(pixel)] = static_cast<float>(light / (finer * finer));
  }
  return truth;
}

Image finest(const Field& field, const Scene& scene, double k)
{
  return finest(field, scene, k, scene.cutoff == Cutoff::Shadowgraph);
}

class TargetError : public testing::TestWithParam<Case>
{
protected:
  /// Targets from what can be seen to a tenth of what cannot.
  void expectKept(const Field& field) const
  {
    Scene scene = sceneOf(GetParam());
    double before = std::numeric_limits<double>::infinity();
    Image truth;
    for (const double share : { 8., 1., 0.125 })
    {
      scene.targetError = share * GetParam().target;
      SCOPED_TRACE(scene.targetError);
      Bench bench;
      const Image image = bench.render(field, scene);
      if (truth.intensity.empty())
      {
        truth = finest(field, scene, image.kScale);
        scene.kScale = image.kScale > 0 ? std::optional<double>(image.kScale) : std::nullopt;
      }
      const double error = trueError(image, truth, scene,
        [&](std::size_t pixel) { return truth.opticalPathDifference[pixel] != 0; });
      EXPECT_EQ(image.accuracy.target, scene.targetError);
      EXPECT_NE(image.accuracy.limit, ErrorSource::None);
      if (image.accuracy.isKept())
      {
        EXPECT_LE(error, scene.targetError);
      }
      // At the rim of the data a ray through the middle of each pixel can do better than some beside it. On a screen many rays
      // blur less, but where light is smooth the edges of their squares are noise.
      const double noise = scene.cutoff == Cutoff::Shadowgraph ? 3e-4 : 1e-6;
      EXPECT_LE(error, 1.05 * before + 0.25 * scene.targetError + noise);
      // Below a tenth of the target it need not be known.
      EXPECT_GT(image.accuracy.reached, 0.5 * error - 0.1 * scene.targetError);
      EXPECT_LT(image.accuracy.reached, 3 * error + 0.5 * scene.targetError);
      before = error;
    }
  }
};

INSTANTIATE_TEST_SUITE_P(Techniques, TargetError,
  testing::Values(Case{ "KnifeEdge", Cutoff::KnifeEdge, 1. / 256 },
    Case{ "BrightField", Cutoff::BrightField, 1. / 256 },
    Case{ "Shadowgraph", Cutoff::Shadowgraph, 1. / 256 },
    Case{ "Interferogram", Cutoff::Interferogram, 0.02 },
    Case{ "Background", Cutoff::Background, 0.02 }),
  [](const testing::TestParamInfo<Case>& test) { return test.param.name; });

TEST_P(TargetError, IsKeptBySmoothFlow)
{
  const SampledField<float> field(cube(48, 1), ball);
  expectKept(field.field);
}

TEST_P(TargetError, IsKeptAtAShock)
{
  const SampledField<float> field(cube(48, 1), shock);
  expectKept(field.field);
}

TEST_P(TargetError, IsKeptInATree)
{
  expectKept(fieldOf(
    std::make_shared<BallsSource>(std::vector<Ball>{ { { 0, 0, 0 }, 0.4, 1e-3 } }, 1., 0.1)));
}

/// What nothing can keep is said.
TEST(TargetErrors, ThatCannotBeKeptAreSaid)
{
  const SampledField<float> field(cube(24, 1), shock);
  Scene scene = sceneOf({ "", Cutoff::KnifeEdge, 0 });
  scene.view.width = scene.view.height = 12;
  scene.targetError = 1e-12;
  const Image image = Bench().render(field.field, scene);
  EXPECT_FALSE(image.accuracy.isKept());
  EXPECT_GT(image.accuracy.reached, 1e-12);
  EXPECT_GE(image.accuracy.largest, image.accuracy.reached);
}

/// Two fringes a pixel where paths are smooth: 0.006 of a fringe with one ray, 0.035 with squares of 16.
TEST(TargetErrors, OfSteepFringesAreThoseOfFewRays)
{
  const SampledField<float> field(cube(48, 1), ball);
  Scene scene = sceneOf({ "", Cutoff::Interferogram, 0.02 });
  scene.view.width = scene.view.height = 48;
  scene.wavelength = 4e-5;
  scene.targetError = 0.02;
  const Image image = Bench().render(field.field, scene);
  const double error = trueError(image, finest(field.field, scene, 0, true), scene,
    [&](std::size_t pixel) { return image.opticalPathDifference[pixel] != 0; });
  EXPECT_TRUE(image.accuracy.isKept()) << image.accuracy.reached;
  EXPECT_LT(image.samplesPerPixel, 16);
  EXPECT_LT(error, image.accuracy.reached);
  EXPECT_LT(image.accuracy.reached, 3 * error);
}

/// Edges are in 2 % of the pixels, half of which may err more: the error is that of edges that are moved as most are.
TEST(TargetErrors, OfBodiesInFewPixelsAreThoseOfMost)
{
  const Field field = fieldOf(std::make_shared<SphereSource>());
  Scene scene = sceneOf({ "", Cutoff::KnifeEdge, 1. / 256 });
  scene.view.width = scene.view.height = 72;
  scene.view.parallelScale = 3;
  scene.targetError = 1. / 256;
  const Image image = Bench().render(field, scene);
  const Image truth = finest(field, scene, image.kScale);
  const double error = trueError(
    image, truth, scene, [&](std::size_t pixel) { return truth.blockedFraction[pixel] < 1; });
  EXPECT_LT(error, image.accuracy.reached);
  EXPECT_LT(image.accuracy.reached, 3 * error);
}

/// Where memory does not suffice for the voxels that are needed.
TEST(TargetErrors, OfTooFewVoxelsAreSeen)
{
  std::vector<Ball> balls;
  for (int n = 0; n < 16; ++n)
  {
    balls.push_back({ { 0.4 * (n % 4) - 0.6, 0.4 * (n / 4) - 0.6, 0.1 * (n % 3) }, 0.06, 1e-3 });
  }
  const Field field = fieldOf(std::make_shared<BallsSource>(balls, 1., 0.01));
  Scene scene = sceneOf({ "KnifeEdge", Cutoff::KnifeEdge, 1. / 256 });
  scene.targetError = 1. / 256;
  scene.mediumMemory = std::size_t{ 1 } << 20;
  const Image image = Bench().render(field, scene);
  Scene enough = scene;
  enough.mediumMemory = std::size_t{ 1 } << 30;
  const Image truth = finest(field, enough, image.kScale);
  const double error = trueError(image, truth, scene,
    [&](std::size_t pixel) { return truth.opticalPathDifference[pixel] != 0; });
  EXPECT_GT(error, scene.targetError);
  EXPECT_FALSE(image.accuracy.isKept());
  EXPECT_EQ(image.accuracy.limit, ErrorSource::Voxels);
  EXPECT_GT(image.accuracy.reached, 0.5 * error);
  EXPECT_LT(image.accuracy.reached, 3 * error);
}

/// Single precision has an error of 0.02 fringes in 10^5.
TEST(TargetErrors, TakeDoublePrecisionForManyFringes)
{
  const SampledField<double> field(cube(32, 1), ball);
  Scene scene = sceneOf({ "", Cutoff::Interferogram, 0 });
  scene.view.width = scene.view.height = 8;
  scene.samplesPerPixel = 1;
  scene.wavelength = 1e-8;
  scene.targetError = 0.02;
  Bench bench;
  EXPECT_EQ(bench.render(field.field, scene).width, 8);
  EXPECT_EQ(bench.work().mediumBuilds, 2);
}

/// A new view, or another knife edge, needs no new medium.
TEST(TargetErrors, KeepTheMedium)
{
  Scene scene = sceneOf({ "", Cutoff::KnifeEdge, 0 });
  scene.view.width = scene.view.height = 64;
  scene.targetError = 1. / 256;
  const Field field = fieldOf(
    std::make_shared<BallsSource>(std::vector<Ball>{ { { 0, 0, 0 }, 0.4, 1e-3 } }, 1., 0.1));
  Bench bench;
  bench.render(field, scene);
  const std::int64_t builds = bench.work().mediumBuilds;
  scene.knifeEdgeAngle = 30;
  EXPECT_TRUE(bench.render(field, scene).accuracy.isKept());
  EXPECT_EQ(bench.work().raySets, 1);
  scene.view.viewDirection = { 1, 0.1, 0.2 };
  EXPECT_TRUE(bench.render(field, scene).accuracy.isKept());
  EXPECT_EQ(bench.work().mediumBuilds, builds);
}

/// A medium that is too coarse for its target is refined, unless others use it: as fine as one that is made so at once.
TEST(TargetErrors, RefineTheMediumThatIsThere)
{
  constexpr double usual = 0.0035, refined = 0.001; // tolerances
  Scene scene = sceneOf({ "", Cutoff::KnifeEdge, 0 });
  scene.targetError = 1. / 4096;
  const Field field = fieldOf(std::make_shared<ShellSource>());
  Bench bench;
  const Image image = bench.render(field, scene);
  EXPECT_EQ(bench.work().mediumBuilds, 1);
  const auto withTolerance = [&](double tolerance)
  {
    Scene same = scene;
    same.targetError = 0;
    same.interpolation = Interpolation::Cubic;
    same.kScale = image.kScale;
    same.mediumTolerance = tolerance;
    same.stepSize = image.stepSize;
    same.samplesPerPixel = image.samplesPerPixel;
    return Bench().render(field, same);
  };
  const Image atOnce = withTolerance(refined);
  const auto errorOf = [&](const Image& of)
  { return trueError(of, atOnce, scene, [](std::size_t) { return true; }); };
  const double few = 0.25 * errorOf(withTolerance(usual));
  EXPECT_LT(errorOf(image), few);

  const auto media = std::make_shared<SharedMedia>();
  Bench first, second;
  first.setMedia(media);
  second.setMedia(media);
  Scene coarse = scene;
  coarse.targetError = 0;
  coarse.interpolation = Interpolation::Cubic;
  coarse.mediumTolerance = usual;
  const Image before = first.render(field, coarse);
  EXPECT_LT(errorOf(second.render(field, scene)), few);
  EXPECT_EQ(second.work().mediumBuilds, 1); // the one that it began with is the first's
  EXPECT_EQ(media->count(), 2);
  EXPECT_EQ(first.render(field, coarse).medium.voxels, before.medium.voxels);
}

/// Another knife edge takes the rays of the image before, also where something is shown before the settings are found.
TEST(TargetErrors, KeepTheRays)
{
  const SampledField<float> field(cube(32, 1), shock);
  Scene scene = sceneOf({ "", Cutoff::KnifeEdge, 0 });
  scene.targetError = 1. / 256;
  scene.kScale = 500;
  Monitor mayPause;
  mayPause.paused = [] { return false; };
  Bench bench;
  const auto render = [&]
  {
    Image image = bench.render(field.field, scene, mayPause);
    while (bench.isUnfinished())
    {
      image = bench.resume(mayPause);
    }
    return image;
  };
  const Image first = render();
  const std::int64_t sets = bench.work().raySets;
  scene.knifeEdgeAngle = 1;
  const Image second = render();
  EXPECT_EQ(bench.work().raySets, sets);
  EXPECT_TRUE(second.accuracy.isKept());
  EXPECT_EQ(second.samplesPerPixel, first.samplesPerPixel);
  EXPECT_NE(second.intensity, first.intensity);
  EXPECT_EQ(second.intensity, Bench().render(field.field, scene).intensity);
}

TEST(TargetErrors, AbortedEndsThem)
{
  const SampledField<float> field(cube(32, 1), shock);
  Scene scene = sceneOf({ "", Cutoff::KnifeEdge, 0 });
  scene.targetError = 1. / 256;
  Bench bench;
  EXPECT_TRUE(bench.render(field.field, scene, { {}, [] { return true; } }).aborted);
  EXPECT_FALSE(bench.render(field.field, scene).aborted);
}

/// However often its search for settings is paused, the image is the same.
TEST(TargetErrors, MayBePaused)
{
  const SampledField<float> field(cube(32, 1), shock);
  Scene scene = sceneOf({ "", Cutoff::Interferogram, 0 });
  scene.targetError = 0.02;
  const Image atOnce = Bench().render(field.field, scene);
  Monitor always;
  always.paused = [] { return true; };
  Bench bench;
  Image image = bench.render(field.field, scene, always);
  while (image.intensity.empty())
  {
    image = bench.resume(always);
  }
  EXPECT_EQ(image.samples, 1); // something to look at
  int calls = 1, withoutLight = 0;
  for (; bench.isUnfinished(); ++calls)
  {
    EXPECT_FALSE(image.finished);
    withoutLight += image.intensity.empty() ? 1 : 0;
    ASSERT_LT(calls, 10000);
    image = bench.resume(always);
  }
  EXPECT_GT(withoutLight, 3); // before the first pass
  EXPECT_EQ(image.intensity, atOnce.intensity);
  EXPECT_EQ(image.accuracy.reached, atOnce.accuracy.reached);
  EXPECT_EQ(image.samplesPerPixel, atOnce.samplesPerPixel);

  bench.render(field.field, scene, always);
  bench.cancel();
  EXPECT_FALSE(bench.isUnfinished());
}

TEST(TargetErrors, AreRefusedWhereTheyAreNone)
{
  const SampledField<float> field(cube(8, 1), shock);
  Scene scene = sceneOf({ "", Cutoff::KnifeEdge, 0 });
  for (const double bad : { -1., std::numeric_limits<double>::quiet_NaN() })
  {
    scene.targetError = bad;
    EXPECT_THROW(Bench().render(field.field, scene), Error);
  }
}

/// A strong lens around a body throws all light of the view out of the image: what lands there is from around it.
TEST(TargetErrors, OfLightFromOutsideAreSeen)
{
  const SampledField<float> field(cube(32, 1),
    [](double x, double y, double z)
    {
      const double r = std::sqrt(x * x + y * y + z * z);
      return r < 0.25 ? std::numeric_limits<double>::quiet_NaN() : 0.25 * std::exp(-4 * r * r);
    });
  Scene scene = sceneOf({ "", Cutoff::Shadowgraph, 0 });
  scene.view.viewDirection = { 0, 0, -1 };
  scene.view.parallelScale = 0.4;
  scene.view.width = scene.view.height = 32;
  scene.targetError = 1. / 256;
  const Image image = Bench().render(field.field, scene);
  const Image truth = finest(field.field, scene, 0);
  EXPECT_GT(*std::max_element(truth.intensity.begin(), truth.intensity.end()), 0);
  const double error = trueError(image, truth, scene,
    [&](std::size_t pixel) { return truth.opticalPathDifference[pixel] != 0; });
  EXPECT_GT(image.accuracy.reached, 0);
  EXPECT_TRUE(error <= scene.targetError || !image.accuracy.isKept());
}

/// Light that crosses the data between rays that look at all of the view, wherever it is between these.
TEST(TargetErrors, OfLightThroughASlitAreSeen)
{
  Grid grid;
  grid.dimensions = { 257, 9, 9 };
  grid.spacing = { 1. / 128, 1. / 8, 1. / 8 };
  grid.origin = { -1, -0.5, -0.5 };
  for (const double middle : { 5.5, 7.5, 10.5 })
  {
    SCOPED_TRACE(middle);
    const SampledField<float> field(grid,
      [&](double x, double y, double)
      {
        return std::abs(x - middle / 128) > 0.6 / 128 ? std::numeric_limits<double>::quiet_NaN()
                                                      : 1e-4 * std::sin(9 * y);
      });
    Scene scene = sceneOf({ "", Cutoff::KnifeEdge, 0 });
    scene.view.viewDirection = { 0, 0, -1 };
    scene.view.width = 256;
    scene.view.height = 48;
    scene.targetError = 0.5; // which the fewest rays keep
    const Image image = Bench().render(field.field, scene);
    EXPECT_TRUE(std::any_of(image.blockedFraction.begin(), image.blockedFraction.end(),
      [](float blocked) { return blocked < 1; }));
    EXPECT_GT(image.accuracy.reached, 0);
  }
}

/// Where no light crosses the data there is nothing to keep.
TEST(TargetErrors, NeedLight)
{
  const SampledField<float> field(cube(8, 1), shock);
  Scene scene = sceneOf({ "", Cutoff::KnifeEdge, 0 });
  scene.view.focalPoint = Vector{ 100, 0, 0 };
  scene.view.parallelScale = 1;
  scene.targetError = 1. / 256;
  const Image image = Bench().render(field.field, scene);
  EXPECT_TRUE(image.accuracy.isKept());
  EXPECT_EQ(image.accuracy.reached, 0);
}

} // namespace

} // namespace schlieren
