// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Rays and steps per second on a GPU, beside what the device could do at most, and how far its images
// are from the CPU's. Needs no library, so that it runs wherever nvcc does.
//
//   GpuBenchmarks [largest grid, points per axis = 1024]
//
// The medium is a wavy jet in still gas, and a tree of bricks. In the paper's configuration (Brownlee et al. 2011, table 1) it has
// 480 x 720 x 100 points, seen along the third axis in 512 x 512 pixels with 10 samples each.
#include "Core/AnalyticSources.h"
#include "Device/CudaBuffer.h"
#include "Device/DeviceError.h"
#include "Device/Parallel.h"
#include "Schlieren.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <memory>
#include <vector>

namespace schlieren
{

namespace
{

constexpr int samplesPerPixel = 10;

/// What a device can do at most in a second.
struct Peak
{
  double memoryBytes;  ///< of its memory
  double cacheBytes;   ///< of all first-level caches: 128 bytes a cycle each
  double instructions; ///< of single threads: four warps' a cycle on each multiprocessor

  static Peak ofDevice()
  {
    const auto attribute = [](cudaDeviceAttr which)
    {
      int value = 0;
      checkCuda(cudaDeviceGetAttribute(&value, which, 0), "Asking for an attribute");
      return static_cast<double>(value);
    };
    const double cycles =
      1e3 * attribute(cudaDevAttrClockRate) * attribute(cudaDevAttrMultiProcessorCount);
    constexpr double bothEdges = 2;
    return { bothEdges * 1e3 * attribute(cudaDevAttrMemoryClockRate) *
        attribute(cudaDevAttrGlobalMemoryBusWidth) / 8,
      128 * cycles, 128 * cycles };
  }
};

/// Of one step with one sample of the medium, in single precision: points that are read, and instructions,
/// counted in what nvcc 13.0 makes of the loop for sm_90 (without those for leaving the grid).
struct Cost
{
  double points, instructions;

  static Cost of(Interpolation interpolation)
  {
    return interpolation == Interpolation::Cubic ? Cost{ 64, 495 } : Cost{ 27, 298 };
  }
};

const char* name(Interpolation interpolation)
{
  return interpolation == Interpolation::Cubic ? "Cubic" : "Quadratic";
}

const char* name(Integrator integrator)
{
  return integrator == Integrator::Adaptive ? "Adaptive" : "Leapfrog";
}

const char* name(Cutoff cutoff)
{
  switch (cutoff)
  {
    case Cutoff::Shadowgraph:
      return "Shadowgraph";
    case Cutoff::Circular:
      return "Circular";
    case Cutoff::CircularComplement:
      return "Complement";
    case Cutoff::NumericalSchlieren:
      return "Numerical";
    case Cutoff::GradedFilter:
      return "Graded";
    case Cutoff::ColorFilter:
      return "Color";
    case Cutoff::Interferogram:
      return "Fringes";
    case Cutoff::Background:
      return "Background";
    default:
      return "Knife Edge";
  }
}

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
  scene.samplesPerPixel = samplesPerPixel;
  scene.kScale = 1000; // the image alone, not the search for its k
  scene.pathModel = PathModel::Refracted;
  scene.device = Device::Cuda;
  return scene;
}

double secondsOf(const std::chrono::steady_clock::time_point& start)
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// By the largest value. With Linear, whose gradient jumps from cell to cell, rounding puts single rays
/// into the next cell: the root mean square shows more there.
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

void printHeader()
{
  std::printf("%-26s %-11s %-9s %-8s %-5s %8s %8s %9s %9s %6s %6s %6s %7s %7s %7s\n", "medium",
    "cutoff", "sampling", "steps", "skip", "rays/s", "steps/s", "image", "again", "L1", "issue",
    "memory", "rms", "worst", "OPD");
}

/// Measures one scene. Rays are traced again for each image, because the seed changes.
void measure(const char* medium, Bench& bench, const Field& field, Scene scene, const Peak& peak)
{
  bench.render(field, scene); // sends the medium to the device
  double traced = 1e300, whole = 1e300;
  Image image;
  constexpr int repetitions = 3;
  for (int n = 0; n < repetitions; ++n)
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

  const double bytes = scene.precision == Precision::Single ? sizeof(float) : sizeof(double);
  const double steps = static_cast<double>(image.stepsTaken);
  const Cost cost = Cost::of(scene.interpolation);
  const std::array<std::int64_t, 3>& points = field.grid.dimensions;
  const double volume = field.source
    ? static_cast<double>(image.medium.bytes)
    : bytes * static_cast<double>(points[0] * points[1] * points[2]);
  const Differences deflection = differences(host.deflection, device.deflection);
  const Differences opticalPath =
    differences(host.opticalPathDifference, device.opticalPathDifference);
  std::printf(
    "%-26s %-11s %-9s %-8s %-5g %8.2e %8.2e %7.2fms %7.2fms %5.1f%% %5.1f%% %5.1f%% %7.0e "
    "%7.0e %7.0e\n",
    medium, name(scene.cutoff), name(scene.interpolation),
    image.pathModel == PathModel::Straight ? "straight" : name(scene.integrator),
    scene.homogeneityTolerance, static_cast<double>(image.raysTraced) / traced, steps / traced,
    1e3 * whole, 1e3 * again, 100 * steps * cost.points * bytes / traced / peak.cacheBytes,
    100 * steps * cost.instructions / traced / peak.instructions,
    100 * samplesPerPixel * volume / traced / peak.memoryBytes, deflection.rms, deflection.worst,
    opticalPath.worst);
  std::fflush(stdout);
}

void measureAll(
  const char* medium, const Field& field, const Vector& viewDirection, const Peak& peak)
{
  Bench bench;
  for (const Interpolation interpolation : { Interpolation::Quadratic, Interpolation::Cubic })
  {
    for (const double tolerance : { 0., 0.001 })
    {
      for (const Cutoff cutoff : { Cutoff::KnifeEdge, Cutoff::Shadowgraph })
      {
        Scene scene = sceneOf(viewDirection);
        scene.interpolation = interpolation;
        scene.homogeneityTolerance = tolerance;
        scene.cutoff = cutoff;
        measure(medium, bench, field, scene, peak);
      }
    }
  }
}

/// The medium of a mesh: two balls in a far field of 50 times their size.
void measureTree(const Peak& peak)
{
  const auto source = std::make_shared<BallsSource>(std::vector<Ball>{
    { { -0.005, 0.002, 0 }, 0.01, 1e-4 }, { { 0.012, -0.01, 0.01 }, 0.004, 1e-4 } });
  Field field;
  field.source = source;
  field.grid = coarsestGrid(*source);
  field.version = 1;
  Bench bench;
  for (const Vector& direction : { Vector{ 0, 0, -1 }, Vector{ -0.64, 0.48, -0.6 } })
  {
    Scene scene = sceneOf(direction);
    scene.view.parallelScale = 0.04;
    scene.mediumTolerance = 0.003;
    measure(direction[0] == 0 ? "tree, along z" : "tree, aslant", bench, field, scene, peak);
  }
}

/// As ParaView shows it by default: with the histogram of deflections and the k that is found by it.
void measureDefaults(
  const char* medium, const Field& field, const Vector& viewDirection, const Peak& peak)
{
  Bench bench;
  Scene scene = sceneOf(viewDirection);
  scene.kScale.reset();
  scene.histogramSize = 256;
  measure(medium, bench, field, scene, peak);
}

/// Every cutoff by both estimators. What another cutoff costs is under "again".
void measureCutoffs(
  const char* medium, const Field& field, const Vector& viewDirection, const Peak& peak)
{
  Bench bench;
  for (const FilmEstimator estimator : { FilmEstimator::Sheet, FilmEstimator::Photon })
  {
    std::printf("%s\n", estimator == FilmEstimator::Sheet ? "by sheet" : "by photon");
    for (const Cutoff cutoff : { Cutoff::KnifeEdge, Cutoff::Shadowgraph, Cutoff::Circular,
           Cutoff::CircularComplement, Cutoff::GradedFilter, Cutoff::ColorFilter,
           Cutoff::Interferogram, Cutoff::Background, Cutoff::NumericalSchlieren })
    {
      Scene scene = sceneOf(viewDirection);
      scene.filmEstimator = estimator;
      scene.cutoff = cutoff;
      measure(medium, bench, field, scene, peak);
    }
  }
}

/// Every kernel once.
void measureKernels(
  const char* medium, const Field& field, const Vector& viewDirection, const Peak& peak)
{
  for (const Precision precision : { Precision::Single, Precision::Double })
  {
    std::printf("%s precision\n", precision == Precision::Single ? "single" : "double");
    for (const Interpolation interpolation : { Interpolation::Quadratic, Interpolation::Cubic })
    {
      Bench bench;
      Scene scene = sceneOf(viewDirection);
      scene.precision = precision;
      scene.interpolation = interpolation;
      for (const Integrator integrator : { Integrator::Leapfrog, Integrator::Adaptive })
      {
        scene.integrator = integrator;
        measure(medium, bench, field, scene, peak);
      }
      scene.pathModel = PathModel::Straight;
      measure(medium, bench, field, scene, peak);
    }
  }
}

void run(std::int64_t largest)
{
  const Peak peak = Peak::ofDevice();
  std::printf(
    "At most: memory %.2f TB/s, first-level caches %.1f TB/s, %.1f T instructions/s.\n"
    "rays/s, steps/s: of tracing\n"
    "image: all of it; again: with another knife edge\n"
    "L1, issue: of the most that reading and calculating allow, if a step takes one sample\n"
    "  (Adaptive takes four)\n"
    "memory: if every pass, of a ray per pixel, read all of the medium from there\n"
    "rms, worst, OPD: differences of GPU and CPU, by the largest value\n",
    1e-12 * peak.memoryBytes, 1e-12 * peak.cacheBytes, 1e-12 * peak.instructions);
  printHeader();
  {
    const Jet jet(480, 720, 100);
    measureAll("480 x 720 x 100, along z", jet.field, { 0, 0, -1 }, peak);
    measureDefaults("the same, automatic k", jet.field, { 0, 0, -1 }, peak);
    measureCutoffs("480 x 720 x 100, along z", jet.field, { 0, 0, -1 }, peak);
  }
  measureTree(peak);
  const Vector aslant{ -0.64, 0.48, -0.6 };
  {
    const Jet jet(256, 256, 256);
    measureAll("256^3, along z", jet.field, { 0, 0, -1 }, peak);
    measureAll("256^3, aslant", jet.field, aslant, peak);
    measureKernels("256^3, aslant", jet.field, aslant, peak);
  }
  if (largest > 256)
  {
    const Jet jet(largest, largest, largest);
    measureAll((std::to_string(largest) + "^3, aslant").c_str(), jet.field, aslant, peak);
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
