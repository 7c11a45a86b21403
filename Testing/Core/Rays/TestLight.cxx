// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Light of a point source and of extended ones: against rays that are integrated without the tracer, and
// against the geometry of shadows.
#include "ClosedForms.h"
#include "Film/Shading.h"
#include "Messages.h"
#include "Rays/Light.h"
#include "Rays/RayStarts.h"

#include <algorithm>
#include <random>
#include <utility>

namespace schlieren
{

namespace
{

/// Gas whose index is not that around it where light enters and leaves.
ClosedForm slope(double peak)
{
  return linearMedium(peak, { 0.2 * peak, -0.3 * peak, 0.1 * peak });
}

constexpr double blobHalf = 3;
constexpr double sourceDistance = 8;

/// The undisturbed ray of a pixel, with unit momentum, in the middle of the data.
RayState undisturbed(const Image& image, const Scene& scene, const Grid& grid, int column, int row)
{
  const Frame& frame = image.frame;
  const Point u = asPoint(frame.u), v = asPoint(frame.v), w = asPoint(frame.w);
  const double a = (column - 0.5 * (image.width - 1)) * frame.pixelSize;
  const double b = (row - 0.5 * (image.height - 1)) * frame.pixelSize;
  const GridBox box = boxOf(grid);
  const Point centre = 0.5 * (box.low + box.high);
  const Point focal = scene.view.focalPoint ? asPoint(*scene.view.focalPoint) : centre;
  const Point axis = focal + dot(centre - focal, w) * w; // there, in the plane of the centre
  const Point d = w + (1 / *scene.source.distance) * (a * u + b * v);
  return { axis + a * u + b * v, (1 / length(d)) * d, 0 };
}

/// What the bench should say of a pixel by Runge and Kutta's method in the medium itself.
Reading truthOf(const ClosedForm& form, const Image& image, const Scene& scene, const Grid& grid,
  int column, int row)
{
  const GridBox box = boxOf(grid);
  const RayState middle = undisturbed(image, scene, grid, column, row);
  const Point d = middle.momentum;
  const RayState back = leaving(
    box,
    [&](double way) {
      return RayState{ middle.position - way * d, d, 0 };
    },
    1. / 64);
  const RayState start{ back.position, std::sqrt(1 + form.excess(back.position)) * d, 0 };
  const RayState end = integrated(form, start, box, 1. / 256);
  const Point w = asPoint(image.frame.w);
  const auto onExitPlane = [&](const Point& position, const Point& direction)
  { return position + ((image.frame.exit - dot(position, w)) / dot(direction, w)) * direction; };
  const Point landed = onExitPlane(end.position, end.momentum);
  const Point moved = landed - onExitPlane(middle.position, d);
  const Point turned = (1 / length(end.momentum)) * end.momentum - d;
  const Point u = asPoint(image.frame.u), v = asPoint(image.frame.v);
  return { { dot(turned, u), dot(turned, v) }, { dot(moved, u), dot(moved, v) },
    end.path + length(landed - end.position) - dot(landed - start.position, d) };
}

Comparison compare(const ClosedForm& form, const Image& image, const Scene& scene, const Grid& grid)
{
  return compared(
    image, [&](int column, int row) { return truthOf(form, image, scene, grid, column, row); });
}

Scene divergingScene(Device device)
{
  Scene scene;
  scene.device = device;
  scene.source.distance = sourceDistance;
  scene.samplesPerPixel = 1;
  scene.pathModel = PathModel::Refracted;
  scene.view = raysAround({ 0.1, 0.2, 0 }, 7, 7, 0.33);
  return scene;
}

class DivergingLight : public OnDevice
{
};

TEST_P(DivergingLight, IsBentAsTheEquationOfRaysSays)
{
  const Grid grid = boxGrid(1. / 16, { blobHalf, blobHalf, blobHalf });
  for (const auto& [form, peak] : { std::pair{ blob(3e-4), 3e-4 }, std::pair{ blob(0.05), 0.05 },
         std::pair{ slope(3e-4), 3e-4 }, std::pair{ slope(0.05), 0.05 } })
  {
    const SampledField<double> medium = sampled(grid, form);
    Field field = medium.field;
    field.ambient = 0;
    Bench bench;
    for (const Vector& direction : { Vector{ 0, 0, -1 }, Vector{ -0.5, 0.4, -0.8 } })
    {
      for (const Integrator integrator : allIntegrators)
      {
        SCOPED_TRACE(std::string(name(integrator)) + " peak " + std::to_string(peak));
        Scene scene = divergingScene(GetParam());
        scene.view.viewDirection = direction;
        scene.precision = Precision::Double;
        scene.interpolation = Interpolation::Cubic;
        scene.integrator = integrator;
        scene.stepSize = 0.5;
        const Image image = bench.render(field, scene);
        const Comparison found = compare(form, image, scene, grid);
        const double allowed = 2e-4;
        EXPECT_LT(found.error.deflection, allowed * found.size.deflection);
        EXPECT_LT(found.error.displacement, allowed * found.size.displacement);
        EXPECT_LT(found.error.opticalPathDifference, allowed * found.size.opticalPathDifference);
      }
    }
  }
}

/// With a weak medium all is linear in it, whatever single precision does to numbers of the size of 1.
TEST_P(DivergingLight, KeepsItsDigitsInFaintMedia)
{
  const Grid grid = boxGrid(1. / 16, { blobHalf, blobHalf, blobHalf });
  for (const ClosedForm& form : { blob(1e-10), slope(1e-10) })
  {
    const SampledField<double> medium = sampled(grid, form);
    Field field = medium.field;
    field.ambient = 0;
    for (const PathModel path : { PathModel::Refracted, PathModel::Straight })
    {
      SCOPED_TRACE(name(path));
      Scene scene = divergingScene(GetParam());
      scene.pathModel = path;
      scene.interpolation = Interpolation::Cubic;
      const Comparison found = compare(form, Bench().render(field, scene), scene, grid);
      EXPECT_LT(found.error.deflection, 1e-3 * found.size.deflection);
      EXPECT_LT(found.error.displacement, 1e-3 * found.size.displacement);
      EXPECT_LT(found.error.opticalPathDifference, 1e-3 * found.size.opticalPathDifference);
    }
  }
}

/// Gas that is the same everywhere bends nothing, however light crosses it.
TEST_P(DivergingLight, IsUndisturbedByUniformGas)
{
  const SampledField<float> gas(cube(24, 1), [](double, double, double) { return 3e-4; });
  for (const SourceShape shape : { SourceShape::Point, SourceShape::Slit, SourceShape::Disc })
  {
    Scene scene;
    scene.device = GetParam();
    scene.view.width = 40;
    scene.view.height = 30;
    scene.view.parallelScale = 1.3;
    scene.samplesPerPixel = 5;
    scene.cutoff = Cutoff::Shadowgraph;
    scene.source.distance = 4;
    scene.source.shape = shape;
    scene.source.width = 0.2;
    scene.source.length = 0.1;
    scene.pathModel = PathModel::Refracted;
    for (const double ambient : { 3e-4, 1e-4 })
    {
      Field field = gas.field;
      field.ambient = ambient;
      const Image image = Bench().render(field, scene);
      // Of the rounding of nu = 2e-4, where the gas around is another.
      const float allowed = ambient == 3e-4 ? 1e-16f : 1e-9f;
      for (std::size_t pixel = 0; pixel < image.intensity.size(); ++pixel)
      {
        EXPECT_NEAR(image.intensity[pixel], 1, 1e-6);
        EXPECT_LE(std::abs(image.deflection[2 * pixel]), allowed);
        EXPECT_LE(std::abs(image.deflection[2 * pixel + 1]), allowed);
        EXPECT_LE(std::abs(image.displacement[2 * pixel]), allowed);
        EXPECT_LE(std::abs(image.displacement[2 * pixel + 1]), allowed);
      }
    }
  }
}

/// The further the source, the less it differs from collimated light: by the ratio of the distances.
TEST_P(DivergingLight, OfAFarSourceIsCollimated)
{
  const Grid grid = boxGrid(1. / 8, { blobHalf, blobHalf, blobHalf });
  const SampledField<double> medium = sampled(grid, blob(1e-3));
  Field field = medium.field;
  field.ambient = 0;
  Scene scene = divergingScene(GetParam());
  scene.precision = Precision::Double;
  Bench bench;
  const auto at = [&](std::optional<double> distance)
  {
    scene.source.distance = distance;
    return bench.render(field, scene);
  };
  const Image collimated = at({});
  const double near = differences(at(1e3), collimated).deflection;
  const double far = differences(at(1e5), collimated).deflection;
  EXPECT_GT(near, 0);
  EXPECT_NEAR(far / near, 1e-2, 1e-3);
  EXPECT_LT(differences(at(1e300), collimated).deflection, 1e-15);
  EXPECT_LT(differences(at(std::numeric_limits<double>::infinity()), collimated).deflection, 1e-15);
}

/// Half way between two points of the grid, because the nearest one decides about solids.
constexpr double wallEdge = 0.2125;

/// A solid wall one point thick in the plane z = `place`, from x = wallEdge on.
SampledField<float> wall(double place)
{
  const Grid grid = boxGrid(0.025, { 1, 0.25, 1 });
  return SampledField<float>(grid,
    [=](double x, double, double z)
    {
      return x > wallEdge && std::abs(z - place) < 0.5 * grid.spacing[2]
        ? std::numeric_limits<double>::quiet_NaN()
        : 0.;
    });
}

Scene wallScene(Device device)
{
  Scene scene;
  scene.device = device;
  scene.view.width = 300;
  scene.view.height = 1;
  scene.view.parallelScale = 0.5 * 0.00375;
  scene.view.focalPoint = Vector{ 0.1, 0, 0 };
  scene.samplesPerPixel = 1;
  scene.kScale = 0; // a knife edge that lets half of all light pass
  scene.stepSize = 0.5;
  return scene;
}

INSTANTIATE_TEST_SUITE_P(, DivergingLight, bothDevices(), deviceName);

class ExtendedSource : public OnDevice
{
};

/// The fraction of a source's light that passes an edge, `beyond` it in half widths of the source's shadow.
double passedOf(SourceShape shape, double beyond)
{
  const double x = std::clamp(beyond, -1., 1.);
  return shape == SourceShape::Slit
    ? 0.5 * (1 + x)
    : 0.5 + (x * std::sqrt(1 - x * x) + std::asin(x)) / pi; // a segment of a circle
}

/// Blur is as wide as the source seen through the edge: angle times the distance from the plane in focus.
TEST_P(ExtendedSource, BlursWhatIsOutOfFocus)
{
  struct Case
  {
    std::optional<double> distance;
    double place, focus;
  };
  constexpr double angle = 0.2;
  constexpr int passes = 128;
  for (const Case& at : { Case{ {}, 0.75, 0 }, Case{ {}, -0.75, 0.5 }, Case{ {}, -0.75, -0.75 },
         Case{ 4., 0.75, 0 }, Case{ 4., -0.5, 2 }, Case{ 4., 0.75, 0.75 } })
  {
    const SampledField<float> field = wall(at.place);
    for (const SourceShape shape : { SourceShape::Slit, SourceShape::Disc })
    {
      SCOPED_TRACE(std::to_string(at.place) + " seen from " + std::to_string(at.focus));
      Scene scene = wallScene(GetParam());
      scene.view.width = 100;
      scene.samplesPerPixel = passes;
      scene.source = { at.distance, shape, angle, shape == SourceShape::Slit ? 0.2 : 0. };
      scene.focusOffset = at.focus;
      const Image image = Bench().render(field.field, scene);

      // X (1 + zeta / R) + t (zeta - z) beyond the edge is dark, |t| <= angle / 2 / M.
      const double perDistance = at.distance ? 1 / *at.distance : 0;
      const double size = 1 + at.place * perDistance;
      const double half =
        0.5 * angle / (1 + at.focus * perDistance) * std::abs(at.place - at.focus) / size;
      const double edge = (wallEdge - 0.1) / size;
      double worst = 0;
      for (int column = 0; column < image.width; ++column)
      {
        const double x = (column - 0.5 * (image.width - 1)) * image.frame.pixelSize;
        const double pixel = image.frame.pixelSize; // also about what the wall's thickness does
        const auto passed = [&](double by)
        { return passedOf(shape, (edge - x + by) / std::max(half, 1e-9)); };
        const double light = image.intensity[pixelOf(image, column, 0)] / 0.5;
        const double above = light - passed(1.5 * pixel), below = passed(-1.5 * pixel) - light;
        worst = std::max({ worst, above, below });
      }
      EXPECT_LT(worst, 0.03);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(, ExtendedSource, bothDevices(), deviceName);

TEST(SourcePoints, FillTheSourceEvenly)
{
  constexpr int passes = 1000;
  for (const std::uint32_t seed : { 1u, 7u })
  {
    const LightSource disc{ {}, SourceShape::Disc, 0.2, 0 };
    const LightSource slit{ {}, SourceShape::Slit, 0.2, 0.1 };
    EXPECT_EQ(sourcePoint(disc, 30, 0, seed), (std::array<double, 2>{ 0, 0 }));
    EXPECT_EQ(sourcePoint(slit, 30, 0, seed), (std::array<double, 2>{ 0, 0 }));
    int inInner = 0, inFirst = 0, inCorner = 0;
    for (int pass = 1; pass <= passes; ++pass)
    {
      const std::array<double, 2> inDisc = sourcePoint(disc, 30, pass, seed);
      const double radius = std::hypot(inDisc[0], inDisc[1]);
      ASSERT_LE(radius, 0.1);
      inInner += radius < 0.05 ? 1 : 0;
      inFirst += inDisc[0] > 0 && inDisc[1] > 0 ? 1 : 0;

      const std::array<double, 2> inSlit = sourcePoint(slit, 30, pass, seed);
      const double across = inSlit[0] * std::sqrt(0.75) + inSlit[1] * 0.5;
      const double along = inSlit[1] * std::sqrt(0.75) - inSlit[0] * 0.5;
      ASSERT_LE(std::abs(across), 0.1 * (1 + 1e-12));
      ASSERT_LE(std::abs(along), 0.05 * (1 + 1e-12));
      inCorner += across > 0.05 && along < 0 ? 1 : 0;
    }
    EXPECT_NEAR(inInner, passes / 4, 5);
    EXPECT_NEAR(inFirst, passes / 4, 10);
    EXPECT_NEAR(inCorner, passes / 8, 10);
  }
  EXPECT_NE(sourcePoint({ {}, SourceShape::Disc, 0.2, 0 }, 0, 3, 1),
    sourcePoint({ {}, SourceShape::Disc, 0.2, 0 }, 0, 3, 2));
}

/// A point source is the same for all films and knives; an extended one is not.
TEST(LightOfCachedRays, IsTracedAgainOnlyWhereItDiffers)
{
  const SampledField<float> field(cube(16, 1), [](double x, double, double) { return 1e-4 * x; });
  Scene scene;
  scene.device = Device::Cpu;
  scene.view.width = scene.view.height = 16;
  Bench bench;
  std::int64_t before = 0;
  const auto tracesAgain = [&]
  {
    bench.render(field.field, scene);
    const bool does = bench.work().raysTraced != before;
    before = bench.work().raysTraced;
    return does;
  };
  tracesAgain();
  scene.source.width = 0.1; // of a point
  scene.focusOffset = 0.3;
  scene.knifeEdgeAngle = 40;
  EXPECT_FALSE(tracesAgain());
  scene.source.distance = 5;
  EXPECT_TRUE(tracesAgain());
  scene.focusOffset = 0.2;
  scene.knifeEdgeAngle = 20;
  EXPECT_FALSE(tracesAgain());
  scene.source.shape = SourceShape::Disc;
  EXPECT_TRUE(tracesAgain());
  scene.source.length = 0.2; // of a disc
  scene.knifeEdgeAngle = 10;
  EXPECT_FALSE(tracesAgain());
  scene.focusOffset = 0.1;
  EXPECT_TRUE(tracesAgain());
  scene.source.shape = SourceShape::Slit;
  EXPECT_TRUE(tracesAgain());
  scene.knifeEdgeAngle = 5;
  EXPECT_TRUE(tracesAgain());
  scene.kScale = 100;
  EXPECT_FALSE(tracesAgain());
}

/// Of a ray that is bent where it leaves the grid: straight on to the film from there.
TEST(RayAtFilm, IsWhereGeometrySays)
{
  std::mt19937 random(1);
  std::uniform_real_distribution<double> any(-1, 1);
  for (int trial = 0; trial < 200; ++trial)
  {
    const double distance = 2 * any(random);   // exit plane to film
    const double fromSource = 3 + any(random); // source to exit plane
    const double pixel = 0.01;
    const double column = 100 * any(random), row = 100 * any(random);
    const bool isCollimated = trial % 4 == 0;
    const double most = isCollimated ? 0 : 0.1;
    const double tilt[2] = { most * any(random), most * any(random) };
    const Inclination inclination{ { most * any(random), most * any(random) },
      isCollimated ? 0 : 0.002 };
    // Undisturbed light, in the data and behind them, by Snell's law.
    const Point within{ inclination.at(0, column, tilt[0]), inclination.at(1, row, tilt[1]), 1 };
    const double ratio = trial % 4 == 1 ? 1.4 : 1;
    Point d = (ratio / length(within)) * within;
    d.z = std::sqrt(1 - d.x * d.x - d.y * d.y);
    const Point slope = (1 / d.z) * d;
    RayExit exit{};
    exit.fate = RayFate::Left;
    exit.opticalPathDifference = 3;
    const double eps[2] = { 0.1 * any(random), 0.1 * any(random) };
    const float moved[2] = { static_cast<float>(0.1 * any(random)),
      static_cast<float>(0.1 * any(random)) };
    for (int axis = 0; axis < 2; ++axis)
    {
      exit.deflection[axis] = eps[axis];
      exit.displacement[axis] = moved[axis];
    }
    Projection projection{ distance, 1 / pixel, 7, inclination };
    projection.exitRatio = ratio;
    projection.perSourceDistance = isCollimated ? 0 : 1 / (fromSource + distance);
    const RayAtFilm found = rayAtFilm(exit, column, row, tilt, projection);

    // The exit plane is at 0, the undisturbed ray goes through its origin.
    const Point source = -fromSource * slope;
    Point p{ d.x + eps[0], d.y + eps[1], 0 };
    p.z = std::sqrt(1 - p.x * p.x - p.y * p.y);
    const Point leaves{ moved[0], moved[1], 0 };
    const Point lands = leaves + (distance / p.z) * p;
    EXPECT_NEAR(found.position[0], column + (lands.x - distance * slope.x) / pixel, 1e-9);
    EXPECT_NEAR(found.position[1], row + (lands.y - distance * slope.y) / pixel, 1e-9);
    EXPECT_EQ(found.position[0], found.place[0]);
    EXPECT_EQ(found.position[1], found.place[1]);
    // Up to the exit plane OPD is against the plane wave along d; on the film, of a source, against the sphere.
    const double path = dot(leaves, d) + distance / p.z;
    const double reference = isCollimated ? distance : length(lands - source) - length(source);
    EXPECT_NEAR(found.path, 3 + 7 * (path - reference), 1e-12);
  }
}

/// Light of a source that enters the data through a face seems to come from `ratio` times as far before it (Snell's law of
/// small angles), as the film seems to be so much further behind. From a pupil, distances count from the focal plane.
TEST(Magnification, IsThatOfSimilarTriangles)
{
  const Grid grid = boxGrid(0.25, { 1, 1.5, 2 });
  View view;
  view.focalPoint = Vector{ 0.1, 0.2, 0.5 };
  constexpr double film = 0.7, sourceAt = 5;
  const Frame frame = frameOf(grid, view);
  for (const double ratio : { 1., 1.33 })
  {
    const ExitFaces faces{ ratio != 1, ratio };
    const Light light = lightFrom({ sourceAt }, film, grid, view, frame, faces);
    const double distance = 2 + ratio * (sourceAt - 2);
    EXPECT_NEAR(light.inclination.perPixel, frame.pixelSize / distance, 1e-15);
    EXPECT_NEAR(light.magnification, 1 + (2 + ratio * film) / distance, 1e-14);
  }
  view.viewAngle = 20;
  const Frame seen = frameOf(grid, view);
  const Light light = lightFrom({}, film, grid, view, seen);
  EXPECT_NEAR(light.inclination.perPixel, seen.pixelSize / seen.pupil, 1e-15);
  EXPECT_NEAR(light.magnification, 1 + (0.5 + 2 + film) / seen.pupil, 1e-14);
}

TEST(LightMistakes, AreReported)
{
  const SampledField<float> field(cube(8, 1), [](double x, double, double) { return 1e-4 * x; });
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  Scene scene;
  scene.device = Device::Cpu;
  scene.view.width = scene.view.height = 8;
  for (const double distance : { 0., -3., 0.5, 1., nan })
  {
    scene.source.distance = distance;
    expectError(messageOf(field.field, scene), "SourceDistance");
  }
  scene.source.distance = 1.3; // the image's corners are at 1.41
  expectError(messageOf(field.field, scene), "45");
  scene.source.distance = 3;
  scene.focusOffset = -3;
  expectError(messageOf(field.field, scene), "FocusOffset");
  scene.focusOffset = nan;
  expectError(messageOf(field.field, scene), "FocusOffset");
  scene.focusOffset = 0;
  scene.source.distance.reset();
  scene.source.shape = SourceShape::Disc;
  scene.source.width = 2.1;
  expectError(messageOf(field.field, scene), "45");
}

} // namespace

} // namespace schlieren
