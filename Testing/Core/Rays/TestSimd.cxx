// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Rays side by side do what a ray does alone.
#include "Fields.h"
#include "Medium/Medium.h"
#include "Rays/Cpu/CpuTracer.h"
#include "Rays/March/MakeTask.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace schlieren
{

namespace
{

std::vector<Simd> levels()
{
  std::vector<Simd> there;
  for (const Simd simd : { Simd::Four, Simd::Avx2, Simd::Avx512 })
  {
    if (hasSimd(simd))
    {
      there.push_back(simd);
    }
  }
  return there;
}

/// A blob on a grid with three different spacings and numbers of points, none of which packs divide.
SampledField<double> blob()
{
  Grid grid;
  grid.dimensions = { 23, 30, 19 };
  grid.spacing = { 1, 0.7, 1.3 };
  return SampledField<double>(grid,
    [](double x, double y, double z)
    {
      const double a = (x - 10) / 4, b = (y - 9) / 5, c = (z - 12) / 5;
      return 0.05 * std::exp(-a * a - b * b - c * c);
    });
}

struct Traced
{
  TracedPass pass;
  double largest = 0; ///< deflection
};

template <class Real>
Traced traceWith(
  Simd simd, const Field& field, const RaySettings& settings, const LightSource& source)
{
  const Medium<Real> medium = buildMedium<Real>(field, settings.kernel.interpolation, 1);
  View view;
  view.viewDirection = { -0.5, 0.3, -0.7 };
  view.width = 37; // no multiple of a block, nor of a tile
  view.height = 29;
  const Light light = lightFrom(source, 0, field.grid, view, frameOf(field.grid, view));
  const RayTask<Real> task = makeTask<Real>(medium, light, settings);
  Traced traced;
  Pass pass{ -2, -3, 41, 35, { 0.25, -0.125 } };
  if (source.shape != SourceShape::Point)
  {
    pass.tilt[0] = 0.02;
    pass.tilt[1] = -0.05;
  }
  traced.pass.resize(pass);
  EXPECT_TRUE(traceOnCpu(task, pass, traced.pass, 2, {}, simd));
  for (const RayExit& exit : traced.pass.exits)
  {
    traced.largest = std::max(traced.largest, std::hypot(exit.deflection[0], exit.deflection[1]));
  }
  return traced;
}

template <class Real>
void expectSame(const RaySettings& settings, double kinks, const LightSource& source = {})
{
  const SampledField<double> field = blob();
  const Traced alone = traceWith<Real>(Simd::None, field.field, settings, source);
  ASSERT_GT(alone.largest, 0.01);
  for (const Simd simd : levels())
  {
    SCOPED_TRACE("simd " + std::to_string(static_cast<int>(simd)));
    const Traced packed = traceWith<Real>(simd, field.field, settings, source);
    const double allowed =
      std::max(2e3 * static_cast<double>(std::numeric_limits<Real>::epsilon()), kinks) *
      alone.largest;
    int different = 0;
    for (std::size_t ray = 0; ray < alone.pass.exits.size(); ++ray)
    {
      const RayExit& a = alone.pass.exits[ray];
      const RayExit& b = packed.pass.exits[ray];
      EXPECT_EQ(a.fate, b.fate);
      EXPECT_NEAR(a.deflection[0], b.deflection[0], allowed);
      EXPECT_NEAR(a.deflection[1], b.deflection[1], allowed);
      EXPECT_NEAR(a.opticalPathDifference, b.opticalPathDifference, 10 * allowed);
      EXPECT_NEAR(a.displacement[0], b.displacement[0], 20 * allowed);
      EXPECT_NEAR(a.displacement[1], b.displacement[1], 20 * allowed);
      different += a.steps != b.steps ? 1 : 0;
    }
    // Where a step ends next to the grid's side, rounding decides about one more.
    if (settings.kernel.integrator != Integrator::Adaptive)
    {
      EXPECT_LE(different, static_cast<int>(alone.pass.exits.size()) / 50);
    }
    EXPECT_NEAR(
      packed.pass.worstDrift, alone.pass.worstDrift, 0.05 * alone.pass.worstDrift + allowed);
  }
}

TEST(Simd, RaysSideBySideDoWhatOneDoes)
{
  for (const Interpolation interpolation : allInterpolations)
  {
    for (const Integrator integrator : { Integrator::Leapfrog, Integrator::Adaptive })
    {
      for (const PathModel path : { PathModel::Refracted, PathModel::Straight })
      {
        SCOPED_TRACE(std::string(name(interpolation)) + " integrator " +
          std::to_string(static_cast<int>(integrator)));
        RaySettings settings;
        settings.kernel = { path, integrator, interpolation };
        // Adaptive steps differ wherever rounding decides whether one is good enough.
        const double kinks = integrator == Integrator::Adaptive ? 1e-3 : 0;
        expectSame<float>(settings, kinks);
        expectSame<double>(settings, kinks);
      }
    }
  }
}

TEST(Simd, InclinedRaysSideBySideDoWhatOneDoes)
{
  LightSource slit;
  slit.distance = 50; // slopes up to 0.4
  slit.shape = SourceShape::Slit;
  slit.width = slit.length = 0.1;
  for (const Integrator integrator : { Integrator::Leapfrog, Integrator::Adaptive })
  {
    for (const PathModel path : { PathModel::Refracted, PathModel::Straight })
    {
      SCOPED_TRACE(static_cast<int>(integrator));
      RaySettings settings;
      settings.kernel = { path, integrator, Interpolation::Quadratic };
      expectSame<float>(settings, integrator == Integrator::Adaptive ? 1e-3 : 0, slit);
      expectSame<double>(settings, integrator == Integrator::Adaptive ? 1e-3 : 0, slit);
    }
  }
}

#ifdef __x86_64__
/// SCHLIEREN_SIMD=NATIVE compiles for what the processor of the build has, and these are the same then.
TEST(Simd, TheBestInstructionsOfThisProcessorAreThere)
{
  const bool hasAvx512 = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
    __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl");
  if (!__builtin_cpu_supports("fma") || !__builtin_cpu_supports("avx2"))
  {
    GTEST_SKIP() << "this processor has neither AVX2 nor AVX-512";
  }
  EXPECT_EQ(bestSimd(), hasAvx512 ? Simd::Avx512 : Simd::Avx2);
}
#endif

} // namespace

} // namespace schlieren
