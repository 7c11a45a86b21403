// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// How rays become an image: where light goes, how exact it is, and what must not change it.
#include "Fields.h"
#include "Film/Exposure.h"
#include "Rays/RayStarts.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace schlieren
{

namespace
{

double mean(const PixelArray<float>& image)
{
  return std::accumulate(image.begin(), image.end(), 0.) / static_cast<double>(image.size());
}

/// A blob of gas beside a solid ball; how far away the screen is decides what becomes of the light.
struct Bodies
{
  explicit Bodies(double peak, bool hasBall)
    : gas(cube(24, 1),
        [=](double x, double y, double z)
        {
          return hasBall && std::hypot(x - 0.5, y, z) < 0.2
            ? std::nan("")
            : peak * std::exp(-(x * x + 2 * y * y + z * z) / 0.1);
        })
  {
    gas.field.ambient = 0;
    scene.device = Device::Cpu;
    scene.cutoff = Cutoff::Shadowgraph;
    scene.view.viewDirection = { -0.2, 0.1, -1 };
    scene.view.width = 48;
    scene.view.height = 36;
    scene.samplesPerPixel = 3;
  }

  SampledField<float> gas;
  Scene scene;
};

TEST(Estimators, EmittedLightIsOnTheFilmOrOutside)
{
  for (const double peak : { 1e-6, 1e-3, -1e-3, 0.2 })
  {
    for (const bool hasBall : { false, true })
    {
      Bodies bodies(peak, hasBall);
      Scene& scene = bodies.scene;
      Bench bench;
      for (const double distance : { 0., 3., 100., 3000., 1e9 })
      {
        scene.screenDistance = distance;
        for (const Cutoff cutoff : { Cutoff::Shadowgraph, Cutoff::KnifeEdge })
        {
          scene.cutoff = cutoff;
          const Image image = bench.render(bodies.gas.field, scene);
          const LightBalance& light = image.light;
          EXPECT_NEAR(light.onFilm + light.outside, light.emitted, 1e-14 * light.emitted);
          EXPECT_NEAR(light.onFilm, mean(image.intensity), 1e-6 * light.onFilm);
          EXPECT_GT(light.emitted, 0.4);
          EXPECT_GE(light.outside, 0);
          EXPECT_GT(light.onFilm, 0);
        }
      }
    }
  }
}

/// Where a film holds all that is bent, none of it is lost.
TEST(Estimators, BentLightAddsUpToTheUndisturbed)
{
  const SampledField<float> lens(cube(32, 1),
    [](double x, double y, double z) { return 2e-2 * std::exp(-(x * x + y * y + z * z) / 0.02); });
  Scene scene;
  scene.device = Device::Cpu;
  scene.cutoff = Cutoff::Shadowgraph;
  scene.view.width = scene.view.height = 64;
  scene.view.parallelScale = 3;
  scene.samplesPerPixel = 2;
  for (const double distance : { 0., 3., 6., 20. }) // before, about and past the focus
  {
    scene.screenDistance = distance;
    const Image image = Bench().render(lens.field, scene);
    EXPECT_NEAR(mean(image.intensity), 1, 1e-6);
    EXPECT_NEAR(image.light.onFilm, 1, 1e-9);
    const auto [least, most] = std::minmax_element(image.intensity.begin(), image.intensity.end());
    EXPECT_GE(*least, 0);
    EXPECT_GT(*most, distance > 0 ? 1.5 : 1);
  }
}

/// The same bend everywhere in a cube that fills the image: light is as even in its outermost pixels, though
/// that beside the cube is not bent.
TEST(Estimators, LightIsEvenUpToTheSidesOfTheMedium)
{
  constexpr double gradient = 1e-7, k = 1e6;
  const SampledField<float> wedge(
    cube(16, 1), [](double, double y, double) { return gradient * y; });
  Scene scene;
  scene.device = Device::Cpu;
  scene.knifeEdgeAngle = 90;
  scene.kScale = k;
  scene.view.width = scene.view.height = 32;
  scene.samplesPerPixel = 1;
  const Image image = Bench().render(wedge.field, scene);
  for (const float light : image.intensity)
  {
    ASSERT_NEAR(light, 0.5 + k * 2 * gradient, 1e-4);
  }
}

/// Rays that are not cached are traced again, for the same image.
TEST(Estimators, ImagesDoNotDependOnTheMemoryBudget)
{
  Bodies bodies(1e-3, true);
  Scene& scene = bodies.scene;
  scene.smoothingRadius = 2;
  scene.samplesPerPixel = 5;
  const Image cached = Bench().render(bodies.gas.field, scene);
  for (const std::size_t budget :
    { std::size_t{ 0 }, std::size_t{ 200000 }, std::size_t{ 400000 }, std::size_t{ 1 } << 40 })
  {
    scene.memoryBudget = budget;
    Bench bench;
    const Image image = bench.render(bodies.gas.field, scene);
    EXPECT_EQ(image.intensity, cached.intensity);
    EXPECT_EQ(image.deflection, cached.deflection);
    EXPECT_EQ(image.opticalPathDifference, cached.opticalPathDifference);
    EXPECT_EQ(image.raysTraced, cached.raysTraced);
    // A second image.
    const std::int64_t traced = bench.work().raysTraced;
    EXPECT_EQ(bench.render(bodies.gas.field, scene).intensity, cached.intensity);
    if (budget == 0)
    {
      EXPECT_EQ(bench.work().raysTraced, 2 * traced);
    }
    else if (budget > 1000000)
    {
      EXPECT_EQ(bench.work().raysTraced, traced);
    }
    else
    {
      EXPECT_GT(bench.work().raysTraced, traced);
      EXPECT_LT(bench.work().raysTraced, 2 * traced);
    }
  }
}

/// Rays that Gaussians have bent on their way from z = 0, by the weak column's and ball's closed forms.
struct GaussianLens
{
  enum class Shape
  {
    Column, ///< along v
    Ball
  };

  static constexpr int size = 96;
  static constexpr double radius = 12; ///< pixels
  static constexpr std::int64_t margin = 12;
  Shape shape;
  double strength; ///< distance to the screen by that to the focus; < 0: the light is spread

  /// Where a ray lands that starts at (x, y) from the middle.
  std::array<double, 2> operator()(double x, double y) const
  {
    // D d eps/dx = -strength in the middle.
    const double squared = x * x + (shape == Shape::Ball ? y * y : 0);
    const double bent = 1 - strength * std::exp(-squared / (radius * radius));
    return { bent * x, shape == Shape::Ball ? bent * y : y };
  }

  /// Of passes of rays.
  PixelArray<float> image(int passes, double side = 1) const
  {
    std::vector<std::vector<RayExit>> exits;
    std::vector<TracedRays> rays;
    for (int number = 0; number < passes; ++number)
    {
      const Pass pass{ -margin, -margin, size + 2 * margin, size + 2 * margin,
        pixelOffset(number, 1, passes) };
      std::vector<RayExit>& ofPass = exits.emplace_back();
      for (std::int64_t ray = 0; ray < pass.columns * pass.rows; ++ray)
      {
        const double x = pass.columnOf(ray) - middle, y = pass.rowOf(ray) - middle;
        const std::array<double, 2> lands = (*this)(x, y);
        ofPass.push_back(
          { { 0, 0 }, { static_cast<float>(lands[0] - x), static_cast<float>(lands[1] - y) }, 0,
            RayFate::Left, 0 });
      }
    }
    for (int number = 0; number < passes; ++number)
    {
      rays.push_back({ { -margin, -margin, size + 2 * margin, size + 2 * margin,
                         pixelOffset(number, 1, passes), { 0, 0 }, side },
        exits[static_cast<std::size_t>(number)].data() });
    }
    Films films(1, size, size, 10000000);
    expose(rays, Shadowgraph{}, { 0, 1, 1 }, margin, 2, films);
    return films.developIntensity(passes, 2);
  }

  /// Each pixel's mean of I / I0 = sum of 1 / |det(1 + D d eps/dx)| over folds.
  std::vector<double> truth() const
  {
    return std::abs(strength) < 0.6 ? truthWithoutFolds() : truthByCounting();
  }

  /// The formula, where each place of the screen is reached from one place only.
  std::vector<double> truthWithoutFolds() const
  {
    std::vector<double> light(size * size);
    constexpr int points = 4; // of a pixel, along each axis
    for (int j = 0; j < size * points; ++j)
    {
      for (int i = 0; i < size * points; ++i)
      {
        const double x = (i + 0.5) / points - 0.5 - middle, y = (j + 0.5) / points - 0.5 - middle;
        const double lands = shape == Shape::Ball ? std::hypot(x, y) : std::abs(x);
        const auto bent = [this](double r)
        { return 1 - strength * std::exp(-r * r / (radius * radius)); };
        double least = 0, most = 4 * size;
        for (int halving = 0; halving < 50; ++halving)
        {
          const double r = 0.5 * (least + most);
          (r * bent(r) < lands ? least : most) = r;
        }
        const double slope =
          bent(least) + 2 * least * least / (radius * radius) * (1 - bent(least));
        light[static_cast<std::size_t>((j / points) * size + i / points)] +=
          1. / (points * points * slope * (shape == Shape::Ball ? bent(least) : 1));
      }
    }
    return light;
  }

  /// How much of the undisturbed light lands in each pixel, by counting.
  std::vector<double> truthByCounting() const
  {
    const int points = shape == Shape::Ball ? 16 : 10000; // of a pixel, along each axis
    std::vector<double> light(size * size);
    const int across = (size + 2 * margin) * points;
    const int down = shape == Shape::Ball ? across : 1;
    for (int j = 0; j < down; ++j)
    {
      for (int i = 0; i < across; ++i)
      {
        const std::array<double, 2> lands = (*this)(
          (i + 0.5) / points - 0.5 - margin - middle, (j + 0.5) / points - 0.5 - margin - middle);
        const auto column = static_cast<int>(std::floor(lands[0] + middle + 0.5));
        const auto row =
          shape == Shape::Ball ? static_cast<int>(std::floor(lands[1] + middle + 0.5)) : 0;
        if (column >= 0 && column < size && row >= 0 && row < size)
        {
          light[static_cast<std::size_t>(row * size + column)] +=
            1. / (shape == Shape::Ball ? points * points : points);
        }
      }
    }
    for (std::size_t pixel = size; shape == Shape::Column && pixel < light.size(); ++pixel)
    {
      light[pixel] = light[pixel - size];
    }
    return light;
  }

  static constexpr double middle = 47.3; ///< no symmetry with the pixels
};

/// Root of the mean square of the pixels' differences from undisturbed light's intensity as 1.
double rmsError(const PixelArray<float>& image, const std::vector<double>& truth)
{
  double sum = 0;
  for (std::size_t pixel = 0; pixel < truth.size(); ++pixel)
  {
    const double error = static_cast<double>(image[pixel]) - truth[pixel];
    sum += error * error;
  }
  return std::sqrt(sum / static_cast<double>(truth.size()));
}

/// Before, at and beyond the caustic one ray per pixel has the light of the closed form, whose mean is 1.
TEST(Estimators, OneRayPerPixelIsExact)
{
  for (const double strength : { -2., 0.5, 0.9, 1., 1.5, 3., 5. })
  {
    for (const GaussianLens::Shape shape :
      { GaussianLens::Shape::Column, GaussianLens::Shape::Ball })
    {
      const GaussianLens lens{ shape, strength };
      const double most = strength == 0.5      ? 1e-3
        : shape == GaussianLens::Shape::Column ? 0.01
                                               : 0.03; // focused along both axes
      EXPECT_LT(rmsError(lens.image(1), lens.truth()), most) << strength;
    }
  }
}

/// Squares smaller than a pixel, as rays of 16 passes have them, blur less and leave no gaps that would be seen.
TEST(Estimators, ManyRaysPerPixelAreNearerToIt)
{
  constexpr int passes = 16;
  for (const double strength : { -2., 0.1, 0.5, 0.9, 1., 1.5, 3., 5. })
  {
    const GaussianLens lens{ GaussianLens::Shape::Column, strength };
    const std::vector<double> truth = lens.truth();
    const double one = rmsError(lens.image(1), truth);
    EXPECT_LT(rmsError(lens.image(passes, 0.25), truth), 0.3 * one) << strength;
    EXPECT_LT(rmsError(lens.image(passes, 0.5), truth), (strength < 5 ? 0.6 : 1) * one) << strength;
  }
  for (const double strength : { 0.1, 0.5, 3., 5. })
  {
    const GaussianLens lens{ GaussianLens::Shape::Ball, strength };
    const std::vector<double> truth = lens.truth();
    EXPECT_LT(rmsError(lens.image(passes, 0.5), truth), strength < 1 ? 1.5e-3 : 0.015) << strength;
  }
}

/// Light that is compressed has hardly any noise of the squares: with points of the sequence it was 0.0012 to 0.0014,
/// however many rays there were.
TEST(Estimators, SquaresOfManyRaysStayEven)
{
  const GaussianLens lens{ GaussianLens::Shape::Ball, 0.5 };
  const std::vector<double> truth = lens.truth();
  EXPECT_LT(rmsError(lens.image(16, 0.5), truth), 5e-4);
  EXPECT_LT(rmsError(lens.image(64, 0.25), truth), 3e-4);
  EXPECT_LT(rmsError(lens.image(256, 0.125), truth), 1.5e-4);
}

/// The image of so many rays per pixel that are not displaced; `exitAt`: of column and row.
template <class ExitAt>
PixelArray<float> imageOfManyRays(int size, int passes, const Cutoffs& cutoff, const ExitAt& exitAt)
{
  constexpr int margin = 2;
  std::vector<std::vector<RayExit>> exits;
  std::vector<TracedRays> rays;
  for (int number = 0; number < passes; ++number)
  {
    const Pass pass{ -margin, -margin, size + 2 * margin, size + 2 * margin, pixelOffset(number, 1),
      { 0, 0 }, sideOf(passes) };
    std::vector<RayExit>& ofPass = exits.emplace_back();
    for (std::int64_t ray = 0; ray < pass.columns * pass.rows; ++ray)
    {
      ofPass.push_back(exitAt(pass.columnOf(ray), pass.rowOf(ray)));
    }
    rays.push_back({ pass, nullptr });
  }
  for (std::size_t number = 0; number < rays.size(); ++number)
  {
    rays[number].exits = exits[number].data();
  }
  Films films(1, size, size, 10000000);
  expose(rays, cutoff, { 0, 1, 0 }, margin, 1, films);
  return films.developIntensity(passes, 1);
}

/// Waves of few pixels, oblique to them, have each pixel's mean: that of a sine over a square.
TEST(Estimators, ManyRaysPerPixelHaveThePixelsMean)
{
  constexpr int size = 40;
  constexpr double amplitude = 0.45;
  for (const double pixelsPerWave : { 3.4, 6.9 })
  {
    const double along = std::cos(0.35) / pixelsPerWave, up = std::sin(0.35) / pixelsPerWave;
    const auto sincOf = [](double turns) { return std::sin(pi * turns) / (pi * turns); };
    const double mean = sincOf(along) * sincOf(up);
    for (const int passes : { 4, 16, 64 })
    {
      const PixelArray<float> image = imageOfManyRays(size, passes, KnifeEdge::at(0, 1),
        [&](double column, double row) -> RayExit
        {
          const double turns = along * column + up * row;
          return { { amplitude * std::sin(2 * pi * turns), 0 }, { 0, 0 }, turns, RayFate::Left, 1 };
        });
      for (int pixel = 0; pixel < size * size; ++pixel)
      {
        const double turns = along * (pixel % size) + up * (pixel / size);
        ASSERT_NEAR(image[static_cast<std::size_t>(pixel)],
          0.5 + amplitude * mean * std::sin(2 * pi * turns), 0.1 / passes)
          << pixelsPerWave << " " << passes;
      }
    }
  }
}

/// Paths that bend within a pixel, as at fronts: a wave of few pixels, by a third of a fringe. Fringes between rays that are
/// a pixel apart would show less of it, however many there are.
TEST(Estimators, ManyRaysPerPixelShowFringesOfBentPaths)
{
  constexpr int size = 24, parts = 24;
  constexpr double along = 0.28, up = 0.1, amplitude = 0.35;
  const auto pathAt = [](double column, double row)
  { return amplitude * std::sin(2 * pi * (along * column + up * row)); };
  const auto meanAt = [&](int column, int row)
  {
    double sum = 0;
    for (int part = 0; part < parts * parts; ++part)
    {
      const auto inPixel = [&](int n) { return (n + 0.5) / parts - 0.5; };
      sum += std::cos(2 * pi * pathAt(column + inPixel(part % parts), row + inPixel(part / parts)));
    }
    return 0.5 + 0.5 * sum / (parts * parts);
  };
  for (const int passes : { 16, 64 })
  {
    const PixelArray<float> image = imageOfManyRays(size, passes, Interferogram{ 1, {} },
      [&](double column, double row) -> RayExit {
        return { { 0, 0 }, { 0, 0 }, pathAt(column, row), RayFate::Left, 1 };
      });
    for (int pixel = 0; pixel < size * size; ++pixel)
    {
      ASSERT_NEAR(
        image[static_cast<std::size_t>(pixel)], meanAt(pixel % size, pixel / size), 0.4 / passes)
        << passes << " " << pixel;
    }
  }
}

/// The fixed-point scale has room for any number of samples, wherever their light lands.
TEST(Estimators, SumsHaveRoom)
{
  for (const int samples : { 1, 4096, 4097, 1000000, 2147483647 })
  {
    EXPECT_GE(passesToHold(samples), samples);
    const std::int64_t rays = 12288LL * 12288LL; // 8192 x 8192 pixels and the widest margin
    const Film film(1, 1, rays * passesToHold(samples));
    EXPECT_GE(film.one(), samples <= 1000000 ? 1 << 15 : 1 << 4);
    EXPECT_LT(film.one() * static_cast<double>(rays) * samples, std::ldexp(1., 63));
  }
  EXPECT_EQ(passesToHold(1), passesToHold(4096));
}

} // namespace

} // namespace schlieren
