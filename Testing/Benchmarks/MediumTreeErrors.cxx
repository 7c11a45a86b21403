// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// What the tree of bricks is worth: errors of straight rays against closed forms and line integrals, of the largest
// deflection, against voxels, memory and time. Prints a table.
#include "AnalyticSources.h"

#include <cstdio>
#include <ctime>
#include <memory>
#include <string>

namespace
{

using namespace schlieren;

struct Errors
{
  double rms = 0, worst = 0;
};

/// Of rays on a lattice over the column, but for those that come near a wall.
template <class Source>
Errors errorsOf(
  const MediumTree<float>& tree, const Source& source, const Column& column, int edge = 81)
{
  const Vec3<double> w = cross(column.u, column.v);
  double squares = 0, worst = 0, largest = 0;
  int rays = 0;
  for (int n = 0; n < edge * edge; ++n)
  {
    const double a = column.middle[0] + column.halfWidth[0] * (2. * (n % edge) / (edge - 1) - 1);
    const double b = column.middle[1] + column.halfWidth[1] * (2. * (n / edge) / (edge - 1) - 1);
    if (std::hypot(a, b) < 1.05 && source.placeAt(0, 0, 0) != Place::Gas)
    {
      continue;
    }
    const Vec3<double> place = a * column.u + b * column.v;
    const auto truth = source.deflectionAt(place, column.u, column.v);
    const Vec3<double> bend = bendAlong(tree, Interpolation::Quadratic, place, w);
    const double error = std::hypot(dot(bend, column.u) - truth[0], dot(bend, column.v) - truth[1]);
    squares += error * error;
    worst = std::max(worst, error);
    largest = std::max(largest, std::hypot(truth[0], truth[1]));
    ++rays;
  }
  return { std::sqrt(squares / rays) / largest, worst / largest };
}

/// Two rows for each tolerance: for one view, and for another after it.
template <class Source>
void printRows(const std::string& name, const std::shared_ptr<Source>& source, double half,
  const Vec3<double>& middle, double finest)
{
  const auto [u, v] = obliqueAxes();
  const Vec3<double> x{ 1, 0, 0 }, y{ 0, 1, 0 };
  const Column along{ x, y, { middle.x, middle.y }, { half, half }, finest };
  const Column oblique{ u, v, { dot(middle, u), dot(middle, v) }, { half, half }, finest };
  for (const double tolerance : { 1e-1, 1e-2, 1e-3 })
  {
    TreeSettings settings;
    settings.tolerance = tolerance;
    MediumTree<float> tree(source, source->ambient(), settings);
    const auto printRow = [&](const Column& column, const char* view)
    {
      source->lattices = 0;
      const std::clock_t start = std::clock();
      tree.refine(column);
      const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
      const auto statistics = tree.statistics();
      const Box box = source->bounds();
      const double uniform = std::pow((box.high[0] - box.low[0]) / statistics.smallestVoxel, 3);
      const Errors errors = errorsOf(tree, *source, column);
      std::printf("| %s | %s | %.0e | %d-%d | %lld | %lld | %d | %.1e | %.1e | %.1f | %.2f | %.1e "
                  "| %.1e |\n",
        name.c_str(), view, tolerance, statistics.coarsestLevel, statistics.finestLevel,
        static_cast<long long>(statistics.bricks),
        static_cast<long long>(statistics.constantLeaves), source->lattices.load(),
        static_cast<double>(statistics.voxels), uniform,
        static_cast<double>(statistics.bytes) * 1e-6, seconds, errors.rms, errors.worst);
      std::fflush(stdout);
    };
    printRow(along, "along the grid");
    printRow(oblique, "then oblique");
  }
}

} // namespace

int main()
{
  std::puts(
    "| field | view | tolerance | levels | bricks | uniform leaves | bricks sampled | voxels "
    "| of a uniform grid as fine | MB | CPU s | rms error | worst error |");
  std::puts("|---|---|---|---|---|---|---|---|---|---|---|---|---|");
  const std::vector<Ball> ball{ { { 0.03, -0.02, 0.01 }, 0.3, 1e-4 } };
  printRows("ball", std::make_shared<BallsSource>(ball), 0.7, { 0, 0, 0 }, 1e-4);
  printRows("three balls", std::make_shared<BallsSource>(threeBalls(1e-4)), 0.6, { 0, 0, 0 }, 1e-4);
  printRows("shell", std::make_shared<ShellSource>(), 0.6, { 0, 0, 0 }, 1e-3);
  printRows("bow shock", std::make_shared<BowShockSource>(), 3, { 0.5, 0, 0 }, 6. / 512);
  return 0;
}
