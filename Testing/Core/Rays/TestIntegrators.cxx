// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// How the error of each integrator falls with its step, against what the same grid gives in the limit of
// short steps, so that the grid's own error is out of it; and what the drift of |p| shows.
#include "ClosedForms.h"

#include <map>
#include <utility>

namespace schlieren
{

namespace
{

/// A strong lens without symmetry to the rays, wide compared with a voxel (which is 1 here).
constexpr double lensWidth = 48;
constexpr double lensPeak = 0.3;
const Point lensHalf{ 48, 48, 96 };
double lens(double x, double y, double z)
{
  const double a = x - 5, b = y + 3;
  return lensPeak *
    std::exp(-(a * a + 1.5 * b * b + z * z + 0.5 * a * z) / (lensWidth * lensWidth));
}
/// Largest |grad n^2| / 2: n times 0.858 peak / width, and the narrowest direction is 1.22 times narrower.
constexpr double lensBend = (1 + lensPeak) * 0.858 * 1.22 * lensPeak / lensWidth;

/// Images of the lens by one bench, each with single rays through most of it.
class Lens
{
public:
  explicit Lens(Device device)
  {
    scene.device = device;
    scene.precision = Precision::Double;
    scene.pathModel = PathModel::Refracted;
    scene.interpolation = Interpolation::Cubic;
    scene.samplesPerPixel = 1;
    scene.view = raysAround({ 1.3, 0.7, 0 }, 5, 5, 12.1);
    medium_.field.ambient = 0;
  }

  Image take(Integrator integrator, double step)
  {
    scene.integrator = integrator;
    scene.stepSize = step;
    return bench_.render(medium_.field, scene);
  }

  /// What the others are compared with.
  Image truth()
  {
    const double tolerance = std::exchange(scene.adaptiveTolerance, 1e-9);
    Image image = take(Integrator::Adaptive, 0.25);
    scene.adaptiveTolerance = tolerance;
    return image;
  }

  Scene scene;

private:
  SampledField<double> medium_{ boxGrid(1, lensHalf), lens };
  Bench bench_;
};

/// The mean order that errors show, of the step being halved again and again.
struct Order
{
  double deflection, displacement, opticalPathDifference;
};
Order orderOf(const Worst& coarse, const Worst& fine, double halvings)
{
  return { std::log2(coarse.deflection / fine.deflection) / halvings,
    std::log2(coarse.displacement / fine.displacement) / halvings,
    std::log2(coarse.opticalPathDifference / fine.opticalPathDifference) / halvings };
}

class Integrators : public OnDevice
{
};

TEST_P(Integrators, ConvergeAtTheirOrder)
{
  struct Expected
  {
    Integrator integrator;
    double coarse, fine; ///< steps: short enough for the order to show, errors well above rounding
    double order;
  };
  Lens lensOnBench(GetParam());
  lensOnBench.scene.adaptiveTolerance = 1; // so that its steps are as long as they may be
  const Image truth = lensOnBench.truth();
  for (const Expected& expected :
    { Expected{ Integrator::Leapfrog, 4, 1, 2 }, Expected{ Integrator::Adaptive, 8, 4, 3 } })
  {
    SCOPED_TRACE(name(expected.integrator));
    const Worst coarse = differences(lensOnBench.take(expected.integrator, expected.coarse), truth);
    const Worst fine = differences(lensOnBench.take(expected.integrator, expected.fine), truth);
    const Order order = orderOf(coarse, fine, std::log2(expected.coarse / expected.fine));
    for (const double found : { order.deflection, order.displacement, order.opticalPathDifference })
    {
      EXPECT_GT(found, expected.order - 0.35);
      EXPECT_LT(found, expected.order + 0.75); // of so long steps the next order is felt, too
    }
  }
}

TEST_P(Integrators, AgreeInTheLimit)
{
  Lens lensOnBench(GetParam());
  const Image truth = lensOnBench.truth();
  EXPECT_LT(differences(lensOnBench.take(Integrator::Adaptive, 1), truth).deflection, 1e-6);
  EXPECT_LT(differences(lensOnBench.take(Integrator::Leapfrog, 0.05), truth).deflection, 1e-6);
}

/// The local errors that are allowed, tolerance times steepest bend along all of the ray, add up to that
/// times its length; no kick is magnified more than twice here. What is compared is a result of second
/// order, what is used one of third: steps go by the tolerance's power 1/2, the error by 3/2 of it, at
/// least by 1.
TEST_P(Integrators, AdaptiveKeepsItsTolerance)
{
  Lens lensOnBench(GetParam());
  const Image truth = lensOnBench.truth();
  const double length = 2 * lensHalf.z;
  std::vector<double> errors;
  std::vector<double> steps;
  for (const double tolerance : { 1e-2, 1e-3, 1e-4, 1e-5 })
  {
    SCOPED_TRACE(tolerance);
    lensOnBench.scene.adaptiveTolerance = tolerance;
    const Image image = lensOnBench.take(Integrator::Adaptive, 16);
    const Worst worst = differences(image, truth);
    EXPECT_LT(worst.deflection, 2 * tolerance * lensBend * length);
    EXPECT_LT(worst.displacement, 2 * tolerance * lensBend * length * length);
    EXPECT_LT(worst.opticalPathDifference, 2 * tolerance * lensBend * length * length);
    errors.push_back(worst.displacement);
    steps.push_back(static_cast<double>(image.stepsTaken));
  }
  for (std::size_t i = 1; i < errors.size(); ++i)
  {
    EXPECT_GT(steps[i], steps[i - 1]);
  }
  // Where the step is not held by its upper limit.
  const double slope = std::log10(errors[1] / errors.back()) / 2;
  EXPECT_GT(slope, 0.9);
  EXPECT_LT(slope, 2);
}

/// |p| = n holds along exact rays, and nothing in the integration forces it.
TEST_P(Integrators, MomentumDriftShowsTheError)
{
  Lens lensOnBench(GetParam());
  lensOnBench.scene.adaptiveTolerance = 1; // so that its steps are as long as they may be
  const auto drift = [&](Integrator integrator, double step)
  { return lensOnBench.take(integrator, step).momentumDrift; };
  for (const auto& [integrator, step, order] :
    { std::tuple{ Integrator::Leapfrog, 2., 2. }, { Integrator::Adaptive, 8., 3. } })
  {
    SCOPED_TRACE(name(integrator));
    const double coarse = drift(integrator, step), fine = drift(integrator, step / 2);
    EXPECT_GT(fine, 0);
    EXPECT_LT(coarse, 0.1);
    EXPECT_GT(std::log2(coarse / fine), order - 0.4);
  }
  EXPECT_LT(lensOnBench.truth().momentumDrift, 1e-8);

  const SampledField<float> weak(
    boxGrid(4, lensHalf), [](double x, double y, double z) { return 1e-3 * lens(x, y, z); });
  Scene scene = lensOnBench.scene;
  scene.stepSize = 1;
  scene.integrator = Integrator::Leapfrog;
  scene.precision = Precision::Single;
  EXPECT_LT(Bench().render(weak.field, scene).momentumDrift, 1e-6);
  scene.pathModel = PathModel::Straight;
  EXPECT_EQ(Bench().render(weak.field, scene).momentumDrift, 0);
}

INSTANTIATE_TEST_SUITE_P(, Integrators, bothDevices(), deviceName);

/// Every way to trace there is, on the Gaussian column N = A exp(-(x^2 + y^2)) along z, seen along y. Each
/// has a bound of its own, derived here; errors are relative to the largest deflection,
/// sqrt(2 pi / e) A, and to the largest optical path, sqrt(pi) A. h is the spacing.
struct Way
{
  Device device;
  PathModel model;
  Integrator integrator;
};
void PrintTo(const Way& way, std::ostream* out)
{
  *out << name(way.device) << name(way.model) << name(way.integrator);
}

class EveryWay : public testing::TestWithParam<Way>
{
protected:
  void SetUp() override
  {
    if (GetParam().device == Device::Cuda && !cudaAvailable())
    {
      GTEST_SKIP() << "no CUDA device";
    }
  }

  static constexpr double peak = 2.7e-4;
  static constexpr double half = 3;
  static constexpr std::int64_t points = 49;
  static constexpr double h = 2 * half / (points - 1);
  const double largestDeflection = std::sqrt(2 * pi) * peak * std::exp(-0.5);
  const double largestPath = std::sqrt(pi) * peak;

  struct Bound
  {
    double deflection, opticalPathDifference;
  };

  /// The line of sight integrates the interpolation's error across it; along it the error, the same in
  /// each cell, sums to nothing. The largest |f'|, ..., |f''''| of f = exp(-x^2) are 0.858, 2, 4.9, 12.
  Bound ofGrid(Interpolation interpolation) const
  {
    const double perDeflection = std::sqrt(pi) * peak / largestDeflection;
    return interpolation == Interpolation::Quadratic
      ? Bound{ perDeflection * h * h / 12 * 4.9, 0.008 * h * h * h * 4.9 } // B2 / 2 and B3 / 6
      : Bound{ perDeflection * 0.008 * h * h * h * 12,
          h * h * h * h / 384 * 12 }; // B3 / 6, B4 / 24
  }

  Bound of(const Scene& scene) const
  {
    const bool bends = scene.pathModel != PathModel::Straight;
    double rest = bends ? 1e-6 : 2.2e-5; // the grid cuts erfc(3) off
    if (bends && scene.integrator == Integrator::Adaptive)
    {
      rest += scene.adaptiveTolerance * 0.858 * peak * 2 * half / largestDeflection;
    }
    if (scene.precision == Precision::Single)
    {
      rest += 5e-6;
    }
    const Bound grid = ofGrid(scene.interpolation);
    // A tenth more for the next term of the interpolation's error.
    return { 1.1 * grid.deflection + rest, 1.1 * grid.opticalPathDifference + rest };
  }
};

TEST_P(EveryWay, TracesTheGaussianColumnWithinItsBound)
{
  const SampledField<double> column(
    cube(points, half), [](double x, double y, double) { return peak * std::exp(-x * x - y * y); });
  Field field = column.field;
  field.ambient = 0;
  Scene scene;
  scene.device = GetParam().device;
  scene.pathModel = GetParam().model;
  scene.integrator = GetParam().integrator;
  scene.samplesPerPixel = 1;
  scene.view = raysAround({ 0.0137, 0, 0.0291 }, 97, 1, 4. / 97);
  scene.view.viewDirection = { 0, -1, 0 };
  scene.view.viewUp = { 0, 0, 1 };
  // A bent ray is not where the line of sight is, which shows in the second order, and goes a longer way
  // from the column to the exit plane: its truth is integrated in the column itself.
  std::vector<Reading> bentRays;
  const ClosedForm form{ [](const Point& x)
    {
      const double n = 1 + peak * std::exp(-x.x * x.x - x.y * x.y);
      return n * n - 1;
    },
    [](const Point& x)
    {
      const double nu = peak * std::exp(-x.x * x.x - x.y * x.y);
      return (-2 * (1 + nu) * nu) * Point{ x.x, x.y, 0 };
    },
    {} };
  const Frame frame = frameOf(field.grid, scene.view);
  for (int i = 0; i < scene.view.width; ++i)
  {
    RayState start{};
    const PixelCentre at{ frame.origin[0] + i * frame.pixelSize, frame.origin[1] };
    ASSERT_TRUE(entering(form, boxOf(field.grid), frame, at, start));
    const RayState end = integrated(form, start, boxOf(field.grid), 1. / 64);
    bentRays.push_back(readingOf(start, end, frame));
    const double paraxial = -2 * std::sqrt(pi) * peak * at.u * std::exp(-at.u * at.u);
    EXPECT_NEAR(bentRays.back().deflection[0], paraxial, 3e-4 * largestDeflection);
  }
  std::map<Interpolation, double> found;
  for (const Precision precision : bothPrecisions)
  {
    for (const Interpolation interpolation : allInterpolations)
    {
      scene.precision = precision;
      scene.interpolation = interpolation;
      SCOPED_TRACE(std::string(name(scene.interpolation)) + " " + name(scene.precision));
      const Image image = Bench().render(field, scene);
      EXPECT_EQ(image.pathModel, scene.pathModel);
      Worst worst;
      for (int i = 0; i < image.width; ++i)
      {
        const std::size_t pixel = static_cast<std::size_t>(i);
        const double y = centreOf(image, i, 0).u;
        const double deflection = -2 * std::sqrt(pi) * peak * y * std::exp(-y * y);
        const Reading straight{ { deflection, 0 }, { deflection * half, 0 },
          std::sqrt(pi) * peak * std::exp(-y * y) };
        worst.include(readingOf(image, pixel),
          scene.pathModel == PathModel::Straight ? straight : bentRays[pixel]);
      }
      const Bound bound = of(scene);
      EXPECT_LT(worst.deflection / largestDeflection, bound.deflection);
      EXPECT_LT(worst.displacement / (half * largestDeflection), bound.deflection);
      EXPECT_LT(worst.opticalPathDifference / largestPath, bound.opticalPathDifference);
      found[scene.interpolation] = worst.deflection;
    }
    // Each is what it says: 7.4 and 0.2 thousandths.
    EXPECT_GT(found[Interpolation::Quadratic], 10 * found[Interpolation::Cubic]);
  }
}

std::vector<Way> allWays()
{
  std::vector<Way> ways;
  for (const Device device : { Device::Cpu, Device::Cuda })
  {
    ways.push_back({ device, PathModel::Straight, Integrator::Leapfrog });
    for (const Integrator integrator : allIntegrators)
    {
      ways.push_back({ device, PathModel::Refracted, integrator });
    }
  }
  return ways;
}
INSTANTIATE_TEST_SUITE_P(
  , EveryWay, testing::ValuesIn(allWays()), testing::PrintToStringParamName());

} // namespace

} // namespace schlieren
