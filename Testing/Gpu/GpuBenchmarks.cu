// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Rays and steps per second on a GPU, and how far its images are from the CPU's. Needs no library, so that it runs wherever
// nvcc does.
//
//   GpuBenchmarks [largest grid, points per axis = 1024]
//
// The medium is a wavy jet in still gas, and a tree of bricks. In the paper's configuration (Brownlee et al. 2011, table 1) it has
// 480 x 720 x 100 points, seen along the third axis in 512 x 512 pixels with 10 samples each.
#include "Core/AnalyticSources.h"
#include "Device/Parallel.h"
#include "Schlieren.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace schlieren
{

namespace
{

/// A jet along y, wavy, in still gas.
struct Jet
{
  Jet(std::int64_t nx, std::int64_t ny, std::int64_t nz)
    : samples(static_cast<std::size_t>(nx * ny * nz))
  {
    static std::uint64_t versions = 0;
    field.grid.dimensions = { nx, ny, nz };
    field.ambient = 0;
    field.version = ++versions;
    const double half = 0.5 * static_cast<double>(std::min({ nx, ny, nz }));
    parallelFor(nz, 1, 0,
      [&](std::int64_t begin, std::int64_t end)
      {
        for (std::int64_t k = begin; k < end; ++k)
        {
          for (std::int64_t j = 0; j < ny; ++j)
          {
            for (std::int64_t i = 0; i < nx; ++i)
            {
              samples[static_cast<std::size_t>((k * ny + j) * nx + i)] =
                at((static_cast<double>(i) - 0.5 * static_cast<double>(nx)) / half,
                  static_cast<double>(j) / half,
                  (static_cast<double>(k) - 0.5 * static_cast<double>(nz)) / half);
            }
          }
        }
      });
    field.singles = samples.data();
  }

  static float at(double x, double y, double z)
  {
    const double centre = 0.1 * std::sin(5 * y);
    const double radius = 0.3 + 0.05 * std::sin(9 * y + 4 * z);
    const double r2 = ((x - centre) * (x - centre) + z * z) / (radius * radius);
    return r2 < 40 ? static_cast<float>(3e-4 * std::exp(-r2)) : 0.f;
  }

  Field field;
  std::vector<float> samples;
};

Scene sceneOf(const Vector& viewDirection)
{
  Scene scene;
  scene.view.viewDirection = viewDirection;
  scene.samplesPerPixel = 10;
  scene.kScale = 1000; // the image alone, not the search for its k
  scene.pathModel = PathModel::Refracted;
  scene.device = Device::Cuda;
  return scene;
}

double secondsOf(const std::chrono::steady_clock::time_point& start)
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Root mean square and worst, by the largest value.
struct Differences
{
  double rms, worst;
};

template <class Values>
Differences differences(const Values& host, const Values& device)
{
  double most = 0, worst = 0, squares = 0;
  for (std::size_t n = 0; n < host.size(); ++n)
  {
    const double difference =
      std::abs(static_cast<double>(device[n]) - static_cast<double>(host[n]));
    most = std::fmax(most, std::abs(static_cast<double>(host[n])));
    worst = std::fmax(worst, difference);
    squares += difference * difference;
  }
  return { std::sqrt(squares / static_cast<double>(host.size())) / most, worst / most };
}

/// Measures one scene. Rays are traced again for each image, because the seed changes.
void measure(const std::string& what, Bench& bench, const Field& field, Scene scene)
{
  bench.render(field, scene); // sends the medium to the device
  double traced = 1e300, whole = 1e300;
  Image image;
  for (int n = 0; n < 3; ++n)
  {
    ++scene.seed;
    const auto start = std::chrono::steady_clock::now();
    image = bench.render(field, scene);
    whole = std::min(whole, secondsOf(start));
    traced = std::min(traced, image.traceSeconds);
  }
  scene.knifeEdgeAngle = 90;
  const auto start = std::chrono::steady_clock::now();
  bench.render(field, scene);
  const double again = secondsOf(start);

  // One sample is enough to compare, and takes a tenth of the CPU's time.
  scene.samplesPerPixel = 1;
  const Image device = bench.render(field, scene);
  scene.device = Device::Cpu;
  const Image host = bench.render(field, scene);
  const Differences deflection = differences(host.deflection, device.deflection);
  std::printf("%-50s %8.2e %8.2e %7.2fms %7.2fms %7.0e %7.0e %7.0e\n", what.c_str(),
    static_cast<double>(image.raysTraced) / traced, static_cast<double>(image.stepsTaken) / traced,
    1e3 * whole, 1e3 * again, deflection.rms, deflection.worst,
    differences(host.opticalPathDifference, device.opticalPathDifference).worst);
  std::fflush(stdout);
}

/// Quadratic and Cubic splines, and with the k that is found by the image.
void measureMedium(const std::string& medium, const Field& field, const Vector& viewDirection)
{
  Bench bench;
  for (const Interpolation interpolation : { Interpolation::Quadratic, Interpolation::Cubic })
  {
    Scene scene = sceneOf(viewDirection);
    scene.interpolation = interpolation;
    measure(medium + (interpolation == Interpolation::Cubic ? ", cubic" : ", quadratic"), bench,
      field, scene);
  }
  Scene scene = sceneOf(viewDirection);
  scene.kScale.reset();
  measure(medium + ", automatic k", bench, field, scene);
}

/// What another cutoff costs is under "again".
void measureCutoffs(const Field& field, const Vector& viewDirection)
{
  Bench bench;
  Scene scene = sceneOf(viewDirection);
  for (const auto& [name, cutoff] :
    { std::pair{ "shadowgraph", Cutoff::Shadowgraph },
      std::pair{ "bright field", Cutoff::BrightField }, std::pair{ "graded", Cutoff::GradedFilter },
      std::pair{ "colour", Cutoff::ColorFilter }, std::pair{ "fringes", Cutoff::Interferogram },
      std::pair{ "background", Cutoff::Background } })
  {
    scene.cutoff = cutoff;
    measure(name, bench, field, scene);
  }
}

/// The medium of a mesh: two balls in a far field of 50 times their size.
void measureTree()
{
  const auto source = std::make_shared<BallsSource>(std::vector<Ball>{
    { { -0.005, 0.002, 0 }, 0.01, 1e-4 }, { { 0.012, -0.01, 0.01 }, 0.004, 1e-4 } });
  const Field field = fieldOf(source);
  Bench bench;
  for (const Vector& direction : { Vector{ 0, 0, -1 }, Vector{ -0.64, 0.48, -0.6 } })
  {
    Scene scene = sceneOf(direction);
    scene.view.parallelScale = 0.04;
    scene.mediumTolerance = 0.003;
    measure(direction[0] == 0 ? "tree, along z" : "tree, aslant", bench, field, scene);
  }
}

/// Other kernels than leapfrog in single precision.
void measureKernels(const Field& field, const Vector& viewDirection)
{
  Bench bench;
  Scene scene = sceneOf(viewDirection);
  scene.integrator = Integrator::Adaptive;
  measure("adaptive", bench, field, scene);
  scene.precision = Precision::Double;
  measure("adaptive, double", bench, field, scene);
  scene.integrator = Integrator::Leapfrog;
  measure("leapfrog, double", bench, field, scene);
  scene.pathModel = PathModel::Straight;
  measure("straight, double", bench, field, scene);
}

void run(std::int64_t largest)
{
  std::printf("rays/s, steps/s: of tracing. image: all of it; again: with another knife edge.\n"
              "rms, worst, OPD: differences of GPU and CPU, by the largest value\n"
              "%-50s %8s %8s %9s %9s %7s %7s %7s\n",
    "medium", "rays/s", "steps/s", "image", "again", "rms", "worst", "OPD");
  const Vector aslant{ -0.64, 0.48, -0.6 }, alongZ{ 0, 0, -1 };
  {
    const Jet jet(480, 720, 100);
    measureMedium("480 x 720 x 100, along z", jet.field, alongZ);
    measureCutoffs(jet.field, alongZ);
  }
  measureTree();
  {
    const Jet jet(256, 256, 256);
    measureMedium("256^3, along z", jet.field, alongZ);
    measureMedium("256^3, aslant", jet.field, aslant);
    measureKernels(jet.field, aslant);
  }
  if (largest > 256)
  {
    const Jet jet(largest, largest, largest);
    measureMedium(std::to_string(largest) + "^3, aslant", jet.field, aslant);
  }
}

} // namespace

} // namespace schlieren

int main(int argc, char** argv)
{
  const long largest = argc > 1 ? std::strtol(argv[1], nullptr, 10) : 1024;
  std::string reason;
  if (!schlieren::cudaAvailable(&reason))
  {
    std::fprintf(stderr, "no CUDA device: %s\n", reason.c_str());
    return 1;
  }
  try
  {
    schlieren::run(largest);
  }
  catch (const std::exception& failure)
  {
    std::fprintf(stderr, "%s\n", failure.what());
    return 1;
  }
  return 0;
}
