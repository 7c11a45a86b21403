// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// What rays lose in a tree of bricks: the same field as one grid of 256^3 points and as bricks with voxels of the same
// size, traced in turns; and trees of many levels, with and without walls. 512^2 rays on one thread, Quadratic and
// Leapfrog in single precision. Prints a table: rays and steps by CPU seconds, medians of all turns.
//
//   SchlierenTreeRayBenchmarks [turns [simd ...]]      simd: 1 SSE2, 2 AVX2, 3 AVX-512 by gathers, 4 by rows
#include "MeasuredTrees.h"
#include "Rays/Cpu/CpuTracer.h"
#include "Rays/March/MakeTask.h"

#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <memory>
#include <string>
#include <vector>

namespace
{

using namespace schlieren;

struct Rates
{
  double rays = 0, steps = 0; ///< a second
};

class Tracing
{
public:
  Tracing(const Medium<float>& medium, const Light& light, PathModel path, int width, int height)
    : pass_{ 0, 0, width, height, { 0, 0 } }
  {
    RaySettings settings;
    settings.kernel.path = path;
    task_ = makeTask<float>(medium, nullptr, FieldGradientsView{}, light, settings);
    traced_.resize(pass_, 0);
  }
  Rates run(Simd simd)
  {
    const std::clock_t start = std::clock();
    traceOnCpu(task_, pass_, traced_, 1, {}, simd);
    const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    Rates rates;
    for (const RayExit& exit : traced_.exits)
    {
      rates.steps += exit.steps;
      rates.rays += exit.steps > 0 ? 1 : 0;
    }
    return { rates.rays / seconds, rates.steps / seconds };
  }

private:
  Pass pass_;
  RayTask<float> task_;
  TracedPass traced_;
};

double median(std::vector<double> all)
{
  std::sort(all.begin(), all.end());
  return all[all.size() / 2];
}

const char* nameOf(Simd simd)
{
  const char* names[] = { "one ray", "SSE2", "AVX2", "AVX-512", "AVX-512, rows" };
  return names[static_cast<int>(simd)];
}

void compareWithGrid(int turns, const std::vector<Simd>& simds)
{
  constexpr std::int64_t edge = 256;
  const auto source = std::make_shared<WavesSource>();
  const double voxel = 2. / edge;
  const Medium<float> tree = treeOf(source, 0, everything({ 1, 0, 0 }, { 0, 1, 0 }, voxel));
  std::vector<float> samples;
  for (std::int64_t k = 0; k < edge; ++k)
  {
    for (std::int64_t j = 0; j < edge; ++j)
    {
      for (std::int64_t i = 0; i < edge; ++i)
      {
        const auto at = [&](std::int64_t n) { return (static_cast<double>(n) + 0.5) * voxel - 1; };
        samples.push_back(static_cast<float>(source->refractivity(at(i), at(j), at(k))));
      }
    }
  }
  Field field;
  field.grid.dimensions = { edge, edge, edge };
  field.grid.spacing = { voxel, voxel, voxel };
  field.grid.origin = { 0.5 * voxel - 1, 0.5 * voxel - 1, 0.5 * voxel - 1 };
  field.singles = samples.data();
  field.ambient = 0;
  const Medium<float> image = buildMedium<float>(field, Interpolation::Quadratic, 0);
  const auto statistics = tree.tree->statistics();
  std::printf("256^3, as a grid and as %lld bricks of level %d to %d, %lld uniform leaves\n",
    static_cast<long long>(statistics.bricks), statistics.coarsestLevel, statistics.finestLevel,
    static_cast<long long>(statistics.constantLeaves));
  std::puts(
    "| view | path | instructions | grid, 1e6 rays/s | tree | tree by grid | least | most | "
    "grid, 1e6 steps/s | tree |");
  std::puts("|---|---|---|---|---|---|---|---|---|---|");
  for (const PathModel path : { PathModel::Refracted, PathModel::Straight })
  {
    for (const Direction& direction : directions)
    {
      View view;
      view.viewDirection = direction.view;
      const Grid& grid = tree.tree->grid();
      const Frame frame = frameOf(grid, view);
      Tracing inImage(image, collimatedLight(field.grid, frame), path, view.width, view.height);
      Tracing inTree(tree, collimatedLight(grid, frame), path, view.width, view.height);
      for (const Simd simd : simds)
      {
        std::vector<double> ofImage, ofTree, ratio, imageSteps, treeSteps;
        for (int turn = 0; turn < turns; ++turn)
        {
          const Rates a = inImage.run(simd);
          const Rates b = inTree.run(simd);
          ofImage.push_back(a.rays * 1e-6);
          ofTree.push_back(b.rays * 1e-6);
          ratio.push_back(b.rays / a.rays);
          imageSteps.push_back(a.steps * 1e-6);
          treeSteps.push_back(b.steps * 1e-6);
        }
        std::printf("| %s | %s | %s | %.3f | %.3f | %.2f | %.2f | %.2f | %.0f | %.0f |\n",
          direction.name, path == PathModel::Straight ? "straight" : "refracted", nameOf(simd),
          median(ofImage), median(ofTree), median(ratio),
          *std::min_element(ratio.begin(), ratio.end()),
          *std::max_element(ratio.begin(), ratio.end()), median(imageSteps), median(treeSteps));
        std::fflush(stdout);
      }
    }
  }
}

void traceTree(const char* name, const std::shared_ptr<const AnalyticSource>& source,
  const Vector& middle, double half, double finest, int turns, const std::vector<Simd>& simds)
{
  for (const Direction& direction : { directions[0], directions[2] })
  {
    View view;
    view.viewDirection = direction.view;
    view.focalPoint = middle;
    view.parallelScale = half;
    const Frame frame = frameOf(coarsestGrid(*source), view);
    const Light light = collimatedLight(coarsestGrid(*source), frame);
    const Vec3<double> centre{ middle[0], middle[1], middle[2] };
    const Medium<float> medium = treeOf(source, 0.01,
      { light.u, light.v, { dot(centre, light.u), dot(centre, light.v) }, { half, half }, finest });
    const auto statistics = medium.tree->statistics();
    Tracing tracing(medium, light, PathModel::Refracted, view.width, view.height);
    for (const Simd simd : simds)
    {
      std::vector<double> rays, steps;
      for (int turn = 0; turn < turns; ++turn)
      {
        const Rates rates = tracing.run(simd);
        rays.push_back(rates.rays * 1e-6);
        steps.push_back(rates.steps * 1e-6);
      }
      std::printf("| %s | %s | %d-%d | %lld | %s | %.3f | %.0f |\n", name, direction.name,
        statistics.coarsestLevel, statistics.finestLevel, static_cast<long long>(statistics.bricks),
        nameOf(simd), median(rays), median(steps));
      std::fflush(stdout);
    }
  }
}

} // namespace

int main(int count, char** arguments)
{
  const int turns = count > 1 ? std::max(std::atoi(arguments[1]), 1) : 5;
  std::vector<Simd> simds;
  for (int i = 2; i < count; ++i)
  {
    simds.push_back(static_cast<Simd>(std::atoi(arguments[i])));
  }
  if (simds.empty())
  {
    simds = { Simd::Avx2, Simd::Avx512 };
  }
  compareWithGrid(turns, simds);
  std::puts("\n| tree | view | levels | bricks | instructions | 1e6 rays/s | 1e6 steps/s |");
  std::puts("|---|---|---|---|---|---|---|");
  traceTree("three balls", std::make_shared<BallsSource>(threeBalls(1e-4)), { 0, 0, 0 }, 0.6, 1e-4,
    turns, simds);
  traceTree("bow shock and body, far field", std::make_shared<BowShockSource>(), { 0.5, 0, 0 }, 3,
    6. / 512, turns, simds);
  return 0;
}
