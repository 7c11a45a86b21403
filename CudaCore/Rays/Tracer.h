// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Medium/FieldGradients.h"
#include "Medium/Medium.h"
#include "Rays/CudaPass.h"
#include "Rays/Light.h"
#include "Rays/Marcher.h"
#include "Rays/RayExit.h"

#include <memory>
#include <vector>

namespace schlieren
{

/// A ray that has taken this many times the steps of a straight one is trapped.
constexpr int trappedFactor = 8;

/// An adaptive ray may take this many times more: where the gradient has kinks its steps are short.
constexpr int adaptiveFactor = 64;

/// The piece of the line start + s * along, s >= 0, inside the box [0, last]; empty if from > to.
struct Chord
{
  double from, to;
};

/// `per` is 1 / along.
SCHLIEREN_HD void clip(Chord& chord, double start, double along, double per, double last)
{
  if (along == 0)
  {
    chord.to = start < 0 || start > last ? -1 : chord.to;
    return;
  }
  const double a = (0 - start) * per;
  const double b = (last - start) * per;
  chord.from = greater(chord.from, lesser(a, b));
  chord.to = lesser(chord.to, greater(a, b));
}

/// Puts the ray that starts at (column, row) of the picture, in pixels from the centre of pixel (0, 0),
/// where it enters the grid. Returns how far that is from the entry plane.
template <class Number, int Lanes>
SCHLIEREN_HD double enterGrid(
  const RayTask<Number>& task, double column, double row, RayBatch<Number, Lanes>& batch, int i)
{
  batch.steps[i] = 0;
  const Vec3<double> start = task.light.start(column, row);
  const Vec3<double> last = static_cast<Vec3<double>>(task.medium.last);
  Chord chord{ 0, task.light.depth };
  clip(chord, start.x, task.light.perLength.x, task.light.lengthPer.x, last.x);
  clip(chord, start.y, task.light.perLength.y, task.light.lengthPer.y, last.y);
  clip(chord, start.z, task.light.perLength.z, task.light.lengthPer.z, last.z);
  if (!(chord.from < chord.to))
  {
    batch.fate[i] = RayFate::Missed;
    return 0;
  }
  const Vec3<Number> at =
    clampTo(static_cast<Vec3<Number>>(start + chord.from * task.light.perLength), task.medium.last);
  batch.start[0][i] = at.x;
  batch.start[1][i] = at.y;
  batch.start[2][i] = at.z;
  // Where it enters and leaves, too: the steps' midpoints do not look at the grid's faces.
  batch.fate[i] =
    task.medium.solid != nullptr && isSolid(task.medium, at) ? RayFate::Blocked : RayFate::Left;
  return chord.from;
}

/// What becomes of a ray whose march is over; `from` is what enterGrid gave.
template <class Number, int Lanes>
SCHLIEREN_HD RayExit leaveGrid(
  const RayTask<Number>& task, const RayBatch<Number, Lanes>& batch, int i, double from)
{
  RayExit exit{ { 0, 0 }, { 0, 0 }, 0, batch.fate[i], batch.steps[i] };
  if (exit.fate != RayFate::Left)
  {
    return exit;
  }
  const Vec3<Number> gridOffset{ batch.offset[0][i], batch.offset[1][i], batch.offset[2][i] };
  const Vec3<Number> end = Vec3<Number>{ batch.start[0][i], batch.start[1][i], batch.start[2][i] } +
    batch.length[i] * task.straight.perLength + gridOffset;
  if (task.medium.solid != nullptr && isSolid(task.medium, clampTo(end, task.medium.last)))
  {
    exit.fate = RayFate::Blocked;
    return exit;
  }
  const Vec3<double> q = { static_cast<double>(batch.q[0][i]), static_cast<double>(batch.q[1][i]),
    static_cast<double>(batch.q[2][i]) };
  const double alongU = dot(q, task.light.u);
  const double alongV = dot(q, task.light.v);
  const bool bends = task.kernel.path != PathModel::Straight;
  double forward = 1;
  double momentum = 1;
  if (bends)
  {
    forward += dot(q, task.light.w);
    if (!(forward > 0))
    {
      exit.fate = RayFate::Turned;
      return exit;
    }
    momentum = std::sqrt(alongU * alongU + alongV * alongV + forward * forward);
  }
  const double perMomentum = 1 / momentum;
  exit.deflection[0] = alongU * perMomentum;
  exit.deflection[1] = alongV * perMomentum;
  exit.opticalPathDifference =
    (static_cast<double>(batch.path[i]) - static_cast<double>(batch.pathError[i])) *
    task.metresPerUnit;

  // From where it leaves the grid, straight on to the exit plane.
  const Vec3<double> offset =
    scaled(task.light.unitsPerIndex, static_cast<Vec3<double>>(gridOffset));
  const double remaining = task.light.depth - from - static_cast<double>(batch.length[i]) -
    (bends ? dot(offset, task.light.w) : 0);
  const double further = remaining / forward;
  exit.displacement[0] =
    static_cast<float>((dot(offset, task.light.u) + further * alongU) * task.light.unit);
  exit.displacement[1] =
    static_cast<float>((dot(offset, task.light.v) + further * alongV) * task.light.unit);
  return exit;
}

/// Traces one ray, with the kernel that is given. `gathered` receives the sums of the fields' gradients.
template <class Kernel, class Number>
SCHLIEREN_HD RayExit traceRay(
  const RayTask<Number>& task, double column, double row, float* gathered, Number& drift)
{
  RayBatch<Number, 1> batch{};
  const double from = enterGrid(task, column, row, batch, 0);
  batch.gathered[0] = gathered;
  march<Kernel, Number>(task, batch);
  drift = batch.drift[0];
  return leaveGrid(task, batch, 0, from);
}

/// What of a scene matters to rays.
struct RaySettings
{
  KernelChoice kernel{ PathModel::Refracted, Integrator::Leapfrog, Interpolation::Quadratic };
  double stepVoxels = 1;
  double adaptiveTolerance = 1e-5;
  double lengthScale = 1; ///< metres per data unit
};

/// `map`: null where nothing is to be skipped. Both stay the caller's.
template <class Real>
RayTask<Real> makeTask(const Medium<Real>& medium, const HomogeneityMap<Real>* map,
  const FieldGradientsView& gradients, const Light& light, const RaySettings& settings);

/// The furthest that any ray is displaced sideways on the exit plane, and its largest slope there;
/// infinite where no bound is known. From |dq/ds| <= (1 + nu) |grad nu| with the medium's largest
/// values, for a ray that goes through all of the grid's depth.
struct DisplacementBound
{
  double displacement; ///< data units
  double slope;
};
template <class Real>
DisplacementBound boundDisplacement(const Medium<Real>& medium, const Light& light);

/// The rays of a pass, row by row, and what each has gathered of each field's gradient: its integral
/// over the ray, a number without unit. Nothing where the view has no fields.
struct TracedPass
{
  std::vector<RayExit> exits;
  std::vector<float> gathered;
  std::unique_ptr<CudaPass> onDevice; ///< the rays, if they stay there; `exits` is empty then
  std::int64_t crossed = 0;           ///< of rays on the device: how many met the grid
  double worstDrift = 0;              ///< of | |p| / n - 1 | where rays leave the grid

  /// Makes room on the host.
  void resize(const Pass& pass, int fields)
  {
    onDevice.reset();
    const auto rays = static_cast<std::size_t>(pass.columns * pass.rows);
    exits.resize(rays);
    gathered.assign(rays * static_cast<std::size_t>(fields), 0);
  }
  std::size_t bytes() const
  {
    const std::size_t rays = exits.size() + (onDevice ? onDevice->size() : 0);
    return rays * sizeof(RayExit) + gathered.size() * sizeof(float);
  }
};

/// Which instructions trace rays side by side.
enum class Simd
{
  None, ///< one ray at a time
  Four, ///< what every processor of the architecture has (x86-64: SSE2)
  Avx2,
  Avx512
};

/// The best one of this processor.
Simd bestSimd();

/// Traces a pass on the CPU into `traced`, which has its size. Returns false if aborted. `simd` must be one
/// that the processor has.
template <class Real>
bool traceOnCpu(const RayTask<Real>& task, const Pass& pass, TracedPass& traced, int threads,
  const Monitor& monitor, Simd simd = bestSimd());

} // namespace schlieren
