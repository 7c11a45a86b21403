// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// Volumes of more than 2^31 samples, of which the memory exists only where a ray looks.
#include "ClosedForms.h"
#include "Rays/Cpu/CpuTracer.h"
#include "Rays/Light.h"
#include "Rays/March/MakeTask.h"

#include <sys/mman.h>

namespace schlieren
{

namespace
{

/// A linear field on a grid of `points`^3, written along the rays only.
template <class Real>
class SparseVolume
{
public:
  static constexpr std::int64_t points = 1400;
  static constexpr std::int64_t stride = points + 2;
  static constexpr std::int64_t samples = stride * stride * stride;
  static_assert(samples > std::int64_t{ 1 } << 31);

  static Real valueAt(std::int64_t i, std::int64_t j, std::int64_t k)
  {
    return static_cast<Real>(1e-9) *
      static_cast<Real>(2 * (i - points) - 3 * (j - points) + (k - points));
  }

  SparseVolume()
    : memory_(mmap(
        nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0))
  {
  }
  ~SparseVolume()
  {
    if (exists())
    {
      munmap(memory_, bytes);
    }
  }
  SparseVolume(const SparseVolume&) = delete;
  SparseVolume& operator=(const SparseVolume&) = delete;

  bool exists() const { return memory_ != MAP_FAILED; }

  /// Around the line along z through (i, j), far from the origin of all axes.
  void write(std::int64_t i, std::int64_t j)
  {
    constexpr std::int64_t reach = 4;
    for (std::int64_t k = -1; k <= points; ++k)
    {
      for (std::int64_t b = j - reach; b <= j + reach && b <= points; ++b)
      {
        for (std::int64_t a = i - reach; a <= i + reach && a <= points; ++a)
        {
          static_cast<Real*>(memory_)[((k + 1) * stride + b + 1) * stride + a + 1] =
            valueAt(a, b, k);
        }
      }
    }
  }

  MediumView<Real> view() const
  {
    constexpr Real last = static_cast<Real>(points - 1);
    constexpr double far = points - 1;
    return { static_cast<const Real*>(memory_), stride, stride * stride, { 0, 0, 0 },
      { last, last, last }, { far, far, far } };
  }

private:
  static constexpr std::size_t bytes = (samples + 16) * sizeof(Real);
  void* memory_;
};

template <class Real>
class Addresses : public testing::Test
{
};
using Reals = testing::Types<float, double>;
TYPED_TEST_SUITE(Addresses, Reals);

TYPED_TEST(Addresses, ReachBeyondTwoThousandMillionSamples)
{
  using Real = TypeParam;
  SparseVolume<Real> volume;
  if (!volume.exists())
  {
    GTEST_SKIP() << "this system reserves no memory that is not used";
  }
  constexpr std::int64_t points = SparseVolume<Real>::points;
  constexpr std::int64_t i = points - 7, j = points - 5;
  volume.write(i, j);

  Grid grid;
  grid.dimensions = { points, points, points };
  View view = raysAround({ i + 0.25, j + 0.25, 0 }, 4, 4, 0.125);
  const Light light = collimatedLight(grid, frameOf(grid, view));
  // What else rays need, from a medium of the same slope.
  SampledField<double> field(
    cube(5, 2), [](double x, double y, double z) { return 1e-9 * (2 * x - 3 * y + z); });
  field.field.ambient = 0;
  Pass pass{};
  pass.columns = pass.rows = 4;
  for (const Interpolation interpolation : allInterpolations)
  {
    const Medium<Real> medium = buildMedium<Real>(field.field, interpolation, 1);
    for (const Integrator integrator : { Integrator::Leapfrog, Integrator::Adaptive })
    {
      for (const Simd simd : { Simd::None, Simd::Four, Simd::Avx2, Simd::Avx512 })
      {
        if (!hasSimd(simd))
        {
          continue;
        }
        SCOPED_TRACE(std::string(name(interpolation)) + " " + name(integrator) + " " +
          std::to_string(static_cast<int>(simd)));
        RaySettings settings;
        settings.kernel = { PathModel::Refracted, integrator, interpolation };
        RayTask<Real> task = makeTask<Real>(medium, light, settings);
        task.medium = volume.view();
        TracedPass traced;
        traced.resize(pass);
        ASSERT_TRUE(traceOnCpu(task, pass, traced, 1, {}, simd));
        for (const RayExit& exit : traced.exits)
        {
          ASSERT_EQ(exit.fate, RayFate::Left);
          const double depth = points - 1;
          EXPECT_NEAR(exit.deflection[0] / (2e-9 * depth), 1, 1e-4);
          EXPECT_NEAR(exit.deflection[1] / (-3e-9 * depth), 1, 1e-4);
        }
      }
    }
  }
}

} // namespace

} // namespace schlieren
