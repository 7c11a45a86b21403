// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// Rays through the leaves of a tree.
#include "Fields.h"

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace schlieren
{

namespace
{

class BallSource : public MediumSource
{
public:
  Box bounds() const override { return { { -1, -1, -1 }, { 1, 1, 1 } }; }
  double ambient() const override { return 0; }
  Content contentOf(const Box&) const override
  {
    return { 0, 1e-3, { 0.01, 0.01, 0.01 }, false, true, false };
  }
  static double at(double x, double y, double z)
  {
    return 1e-3 * std::exp(-(x * x + y * y + z * z) / (2 * 0.25 * 0.25));
  }
  void sample(const Lattice& lattice, double* n, Place* places, float*) const override
  {
    std::size_t to = 0;
    for (int k = 0; k < lattice.points[2]; ++k)
      for (int j = 0; j < lattice.points[1]; ++j)
        for (int i = 0; i < lattice.points[0]; ++i)
        {
          n[to] = at(lattice.first[0] + i * lattice.spacing[0],
            lattice.first[1] + j * lattice.spacing[1], lattice.first[2] + k * lattice.spacing[2]);
          places[to++] = Place::Gas;
        }
  }
};

} // namespace

TEST(TreeRays, FollowAGaussianBall)
{
  for (const Integrator integrator : { Integrator::Leapfrog, Integrator::Rk4, Integrator::Adaptive })
  for (const Vector& direction : { Vector{ 0, 0, -1 }, Vector{ 0.3, -0.5, -0.8 } })
  {
    Field ofTree;
    const auto source = std::make_shared<BallSource>();
    ofTree.source = source;
    ofTree.grid = coarsestGrid(*source);
    ofTree.version = 1;
    Grid grid;
    grid.dimensions = { 257, 257, 257 };
    grid.origin = { -1, -1, -1 };
    grid.spacing = { 1 / 128., 1 / 128., 1 / 128. };
    static SampledField<float> uniform(grid, BallSource::at);
    Scene scene;
    scene.view.viewDirection = direction;
    scene.view.width = scene.view.height = 256;
    scene.view.parallelScale = 1;
    scene.samplesPerPixel = 1;
    scene.integrator = integrator;
    scene.pathModel = PathModel::Refracted;
    const auto run = [&](Field& field)
    {
      Bench bench;
      Image image = bench.render(field, scene);
      field.version++;
      const Image second = bench.render(field, scene);
      std::printf("%g s, %g steps/ray, %g Msteps/s, lost %lld, drift %g\n", second.traceSeconds,
        double(second.stepsTaken) / double(second.raysTraced),
        double(second.stepsTaken) / second.traceSeconds * 1e-6, (long long)second.raysLost,
        second.momentumDrift);
      return second;
    };
    const Image a = run(ofTree);
    const Image b = run(uniform.field);
    double worst = 0, most = 0, worstPath = 0, mostPath = 0;
    for (std::size_t i = 0; i < a.deflection.size(); ++i)
    {
      worst = std::max(worst, double(std::abs(a.deflection[i] - b.deflection[i])));
      most = std::max(most, double(std::abs(b.deflection[i])));
    }
    for (std::size_t i = 0; i < a.opticalPathDifference.size(); ++i)
    {
      worstPath = std::max(worstPath, std::abs(a.opticalPathDifference[i] - b.opticalPathDifference[i]));
      mostPath = std::max(mostPath, std::abs(b.opticalPathDifference[i]));
    }
    std::printf("integrator %d: deflection %g, path %g\n", int(integrator), worst / most, worstPath / mostPath);
  }
}

} // namespace schlieren
