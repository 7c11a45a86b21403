// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// What the film's estimators and noise filters are worth: errors against closed forms and against images of
// many more rays, and how much images change as samples come in. Prints tables; takes minutes.
#include "Jet.h"
#include "Schlieren.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

namespace
{

using namespace schlieren;

/// Root of the mean square difference.
template <class A, class B>
double rmsDifference(const A& a, const B& b)
{
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    const double difference = static_cast<double>(a[i]) - static_cast<double>(b[i]);
    sum += difference * difference;
  }
  return std::sqrt(sum / static_cast<double>(a.size()));
}

Scene cpuScene(int width, int height)
{
  Scene scene;
  scene.device = Device::Cpu;
  scene.view.width = width;
  scene.view.height = height;
  scene.memoryBudget = std::size_t{ 3 } << 29;
  return scene;
}

/// An image without noise.
struct Truth
{
  Scene scene;
  std::vector<double> image;
};

/// A row of the table: errors, over all images, of a sheet of a few rays and of more and more photons.
void printErrors(
  const std::string& name, Bench& bench, const Field& field, const std::vector<Truth>& truths)
{
  std::printf("| %s |", name.c_str());
  const auto print = [&](FilmEstimator estimator, int samples)
  {
    double squares = 0;
    for (const Truth& truth : truths)
    {
      Scene scene = truth.scene;
      scene.filmEstimator = estimator;
      scene.samplesPerPixel = samples;
      squares += std::pow(rmsDifference(bench.render(field, scene).intensity, truth.image), 2);
    }
    std::printf(" %.4f |", std::sqrt(squares / static_cast<double>(truths.size())));
  };
  for (const int samples : { 1, 4 })
  {
    print(FilmEstimator::Sheet, samples);
  }
  for (const int samples : { 1, 4, 32, 128 })
  {
    print(FilmEstimator::Photon, samples);
  }
  std::printf("\n");
  std::fflush(stdout);
}

void printErrorsHeader(const char* what)
{
  std::printf("\n%s\n\n| | sheet, 1 | sheet, 4 | photons, 1 | 4 | 32 | 128 "
              "|\n|---|---|---|---|---|---|---|\n",
    what);
}

/// Shadowgraphs of a weak Gaussian column N = A exp(-(x^2 + z^2) / s^2): eps = -2 sqrt(pi) A (x / s)
/// exp(-x^2 / s^2), I / I0 = sum of 1 / |1 + D d eps/dx| over folds. In focus for D = s / (2 sqrt(pi) A).
void column()
{
  constexpr std::int64_t n = 97;
  constexpr double half = 4, radius = 1, peak = 1e-5;
  const double pi = std::acos(-1.);
  std::vector<double> samples;
  Field field;
  field.grid.dimensions = { n, 3, n };
  const double h = 2 * half / (n - 1);
  field.grid.spacing = { h, half, h };
  field.grid.origin = { -half, -half, -half };
  field.ambient = 0;
  for (std::int64_t k = 0; k < n; ++k)
  {
    for (std::int64_t j = 0; j < 3; ++j)
    {
      for (std::int64_t i = 0; i < n; ++i)
      {
        const double x = h * static_cast<double>(i) - half, z = h * static_cast<double>(k) - half;
        samples.push_back(peak * std::exp(-(x * x + z * z) / (radius * radius)));
      }
    }
  }
  field.doubles = samples.data();
  printErrorsHeader("Gaussian column, shadowgraph, screen at so many focal lengths (128 pixels, "
                    "its radius 16 of them). Against the closed form");
  Bench bench;
  const double focus = radius / (2 * std::sqrt(pi) * peak);
  for (const double lengths : { 0.5, 0.9, 1., 1.5, 3., 5. })
  {
    std::vector<Truth> truths;
    for (const double phase : { 0.2, 0.45, 0.7, 0.95 }) // of the pixels, under the column
    {
      Scene scene = cpuScene(128, 4);
      scene.precision = Precision::Double;
      scene.interpolation = Interpolation::Cubic;
      scene.pathModel = PathModel::Straight;
      scene.cutoff = Cutoff::Shadowgraph;
      scene.view.parallelScale = 0.125;
      const double pixel = 2 * scene.view.parallelScale / scene.view.height;
      scene.view.focalPoint = Vector{ phase * pixel, 0, 0 };
      scene.screenDistance = lengths * focus - half;
      // How much light lands in each pixel, by counting.
      std::vector<double> profile(128);
      constexpr int points = 20000;
      for (int i = 0; i < 2 * 128 * points; ++i)
      {
        const double x = (i + 0.5) / points * pixel - 128 * pixel;
        const double lands = x * (1 - lengths * std::exp(-x * x / (radius * radius)));
        const double column = std::floor(lands / pixel - phase + 64);
        if (column >= 0 && column < 128)
        {
          profile[static_cast<std::size_t>(column)] += 1. / points;
        }
      }
      std::vector<double> truth;
      for (int row = 0; row < 4; ++row)
      {
        truth.insert(truth.end(), profile.begin(), profile.end());
      }
      truths.push_back({ scene, truth });
    }
    char name[32];
    std::snprintf(name, sizeof(name), "%.1f", lengths);
    printErrors(name, bench, field, truths);
  }
}

Scene jetScene(int width, int height)
{
  Scene scene = cpuScene(width, height);
  scene.view.viewDirection = { -0.2, -0.3, -1 };
  scene.view.parallelScale = 0.0082;
  scene.kScale = 300;
  return scene;
}

/// Means of the pixels of images that are `scale` times as fine, each of many rays.
std::vector<double> fineTruth(const Field& field, const Scene& coarse, int scale)
{
  Scene scene = coarse;
  scene.view.width *= scale;
  scene.view.height *= scale;
  scene.filmEstimator = FilmEstimator::Photon;
  scene.samplesPerPixel = 16;
  scene.memoryBudget = 0;
  const Image fine = Bench().render(field, scene);
  std::vector<double> means(
    static_cast<std::size_t>(coarse.view.width) * static_cast<std::size_t>(coarse.view.height));
  for (int row = 0; row < scene.view.height; ++row)
  {
    for (int column = 0; column < scene.view.width; ++column)
    {
      means[static_cast<std::size_t>((row / scale) * coarse.view.width + column / scale)] +=
        static_cast<double>(
          fine.intensity[static_cast<std::size_t>(row * scene.view.width + column)]) /
        (scale * scale);
    }
  }
  return means;
}

void jetErrors(const Jet& jet)
{
  constexpr int finer = 4;
  printErrorsHeader("Jet, 512 x 288 pixels. Against images four times as fine, 256 rays a pixel");
  Bench bench;
  Scene scene = jetScene(512, 288);
  printErrors("knife edge", bench, jet.field, { { scene, fineTruth(jet.field, scene, finer) } });
  scene.cutoff = Cutoff::Shadowgraph;
  for (const double distance : { 0.02, 0.2, 2. })
  {
    scene.screenDistance = distance;
    char name[64];
    std::snprintf(name, sizeof(name), "shadowgraph, screen at %g m", distance);
    printErrors(name, bench, jet.field, { { scene, fineTruth(jet.field, scene, finer) } });
  }
}

/// Brownlee et al. 2011, figure 15.
void convergence(const Jet& jet)
{
  constexpr double radius = 6;
  std::printf(
    "\nJet, knife edge, 192 x 108 pixels: RMS difference of the intensity, as a fraction of full "
    "scale (black to white), between images of n and of 10 n samples a pixel. Cone filter "
    "of radius %g pixels, that is %.0f samples\n\n"
    "| | 1 and 10 | 10 and 100 | 100 and 1000 |\n|---|---|---|---|\n",
    radius, std::acos(-1.) * radius * radius);
  Bench bench;
  Scene scene = jetScene(192, 108);
  scene.noiseFilterRadius = radius;
  for (const FilmEstimator estimator : { FilmEstimator::Photon, FilmEstimator::Sheet })
  {
    for (const NoiseFilter filter : { NoiseFilter::None, NoiseFilter::Cone })
    {
      scene.filmEstimator = estimator;
      scene.noiseFilter = filter;
      std::printf("| %s, %s |", estimator == FilmEstimator::Photon ? "photons" : "sheet",
        filter == NoiseFilter::None ? "not filtered" : "filtered");
      PixelArray<float> last;
      for (const int samples : { 1, 10, 100, 1000 })
      {
        scene.samplesPerPixel = samples;
        PixelArray<float> image = bench.render(jet.field, scene).intensity;
        if (samples > 1)
        {
          std::printf(" %.3f %% |", 100 * rmsDifference(last, image));
        }
        last = std::move(image);
      }
      std::printf("\n");
      std::fflush(stdout);
    }
  }
}

} // namespace

/// All tables, or those that are named: column, jet, convergence.
int main(int argc, char* argv[])
{
  const std::vector<std::string> names(argv + 1, argv + argc);
  const auto isWanted = [&names](const char* name)
  { return names.empty() || std::find(names.begin(), names.end(), name) != names.end(); };
  if (isWanted("column"))
  {
    column();
  }
  const Jet jet;
  if (isWanted("jet"))
  {
    jetErrors(jet);
  }
  if (isWanted("convergence"))
  {
    convergence(jet);
  }
  return 0;
}
