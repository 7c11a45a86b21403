// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// What the tree of bricks is worth: errors of straight rays against closed forms, against voxels, memory and time.
// Prints a table.
#include "AnalyticSources.h"

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>

namespace
{

using namespace schlieren;

struct Errors
{
  double rms = 0, worst = 0;
};

/// Of rays on a lattice over [-half, half]^2, of the largest deflection.
template <class Source>
Errors errorsOf(const MediumTree<float>& tree, const Source& source, Interpolation interpolation,
  const Vec3<double>& u, const Vec3<double>& v, double half, int edge = 101)
{
  const Vec3<double> w = cross(u, v);
  Errors errors;
  double largest = 0;
  for (int n = 0; n < edge * edge; ++n)
  {
    const double a = half * (2. * (n % edge) / (edge - 1) - 1);
    const double b = half * (2. * (n / edge) / (edge - 1) - 1);
    const Vec3<double> place = a * u + b * v;
    const auto truth = source.deflectionAt(place, u, v);
    const Vec3<double> bend = bendAlong(tree, interpolation, place, w);
    const double error = std::hypot(dot(bend, u) - truth[0], dot(bend, v) - truth[1]);
    errors.rms += error * error;
    errors.worst = std::max(errors.worst, error);
    largest = std::max(largest, std::hypot(truth[0], truth[1]));
  }
  largest = source.largestDeflection();
  return { std::sqrt(errors.rms / (edge * edge)) / largest, errors.worst / largest };
}

template <class Source>
void printRows(const std::string& name, const std::shared_ptr<Source>& source,
  const std::vector<double>& tolerances, Interpolation interpolation = Interpolation::Quadratic)
{
  for (const double tolerance : tolerances)
  {
    TreeSettings settings;
    settings.tolerance = tolerance;
    settings.interpolation = interpolation;
    source->lattices = 0;
    const auto start = std::chrono::steady_clock::now();
    MediumTree<float> tree(source, source->ambient(), settings);
    const auto [u, v] = obliqueAxes();
    const Vec3<double> x{ 1, 0, 0 }, y{ 0, 1, 0 };
    tree.refine(everything(x, y, 1e-4));
    const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    const auto statistics = tree.statistics();
    const int sampled = source->lattices;
    const Errors along = errorsOf(tree, *source, interpolation, x, y, 0.7);
    const Errors oblique = errorsOf(tree, *source, interpolation, u, v, 0.5);
    const double uniform = std::pow(2 / statistics.smallestVoxel, 3);
    std::printf("| %s | %.0e | %d-%d | %lld | %lld | %d | %.2e | %.1e | %.1f | %.2f | %.1e | %.1e "
                "| %.1e | %.1e |\n",
      name.c_str(), tolerance, statistics.coarsestLevel, statistics.finestLevel,
      static_cast<long long>(statistics.bricks), static_cast<long long>(statistics.constantLeaves),
      sampled, static_cast<double>(statistics.voxels), uniform,
      static_cast<double>(statistics.bytes) * 1e-6, seconds, along.rms, along.worst, oblique.rms,
      oblique.worst);
    std::fflush(stdout);
  }
}

} // namespace

int main()
{
  std::puts("| field | tolerance | levels | bricks | constant | sampled | voxels | uniform grid as "
            "fine | MB | seconds | rms, along "
            "the grid | worst | rms, oblique | worst "
            "|\n|---|---|---|---|---|---|---|---|---|---|---|---|---|---|");
  const std::vector<double> tolerances{ 1e-1, 1e-2, 1e-3 };
  printRows("one ball",
    std::make_shared<BallsSource>(std::vector<Ball>{ { { 0.03, -0.02, 0.01 }, 0.3, 1e-4 } }),
    tolerances);
  printRows("three balls", std::make_shared<BallsSource>(threeBalls(1e-4)), tolerances);
  return 0;
}
