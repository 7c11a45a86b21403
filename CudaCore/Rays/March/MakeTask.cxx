// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rays/March/MakeTask.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace schlieren
{

namespace
{

/// Index coordinates that steps are to be measured in, by the light's unit of length. By a step of d smallest voxels,
/// leapfrog takes a bent ray's deflection wrong by d^2 |nu''| / 6, which shall be a thousandth. |nu''| is no more than
/// twice the steepest gradient by a smallest voxel. Where nothing depends on z only that needs steps along it.
template <class Real>
Vec3<double> scaleOfSteps(const Medium<Real>& medium, const Light& light, PathModel path)
{
  Vec3<double> scale = light.indexScale;
  const bool isLayer = medium.tree != nullptr && medium.tree->shape() == BrickShape::Layer;
  if (isLayer)
  {
    scale.z = 0;
  }
  if (path == PathModel::Straight)
  {
    return scale;
  }
  const double perVoxel = std::max({ scale.x, scale.y, scale.z });
  const double finest = medium.tree ? std::exp2(medium.tree->statistics().finestLevel) : 1;
  constexpr double allowed = 1e-3;
  const double steepest =
    std::max({ medium.slope.x * scale.x, medium.slope.y * scale.y, medium.slope.z * scale.z }) /
    perVoxel / finest; // nu by voxel
  const double voxelsAlong = std::sqrt(6 * allowed / (2 * steepest));
  const double least = perVoxel / std::max(1., voxelsAlong);
  return { std::max(scale.x, least), std::max(scale.y, least), std::max(scale.z, least) };
}

/// The most of q that light has where it enters the data.
double largestKickAtEntry(double largestNu, const Light& light)
{
  if (!light.faces.refract)
  {
    return largestNu;
  }
  // |sqrt(cosine^2 + 2 nu + nu^2) - cosine|, of nu of both signs.
  const double cosine = light.smallestCosine();
  const double square = cosine * cosine;
  const double kick = largestNu * (2 + largestNu);
  const double back = std::min(largestNu * std::max(0., 2 - largestNu), square);
  return std::max(
    kick / (cosine + std::sqrt(square + kick)), back / (cosine + std::sqrt(square - back)));
}

/// The most of q that a ray has which meets the steepest gradient all along its way, or, where that may turn it around,
/// that of such a ray.
template <class Real>
double largestQOf(const Medium<Real>& medium, const Light& light)
{
  constexpr double turned = 2;
  const double atEntry = largestKickAtEntry(medium.largestNu, light);
  const double cosine = light.smallestCosine();
  const double bend = (1 + medium.largestNu) * length(scaled(medium.slope, light.indexScale));
  // The path s after which the ray has advanced by the depth at the latest, for the ray that is inclined most:
  // ((1 - nu) cosine - bend at entry) s - bend s^2 / 2. At entry, that across the light counts.
  const double across =
    light.faces.refract ? std::sqrt(std::max(0., 1 - cosine * cosine)) * atEntry : 0;
  const double forward = (1 - medium.largestNu) * cosine - across;
  const double discriminant = forward * forward - 2 * bend * light.depth;
  return forward > 0 && discriminant > 0
    ? atEntry + across + bend * 2 * light.depth / (forward + std::sqrt(discriminant))
    : atEntry + turned;
}

} // namespace

template <class Real>
RayTask<Real> makeTask(const Medium<Real>& medium, const HomogeneityMap<Real>* map,
  const FieldGradientsView& gradients, const Light& light, const RaySettings& settings)
{
  RayTask<Real> task{};
  task.medium = medium.view();
  if (map != nullptr)
  {
    task.map = map->view();
  }
  if (gradients.count > 0)
  {
    task.gradients = gradients;
  }
  task.light = light;
  task.indexScale = static_cast<Vec3<Real>>(light.indexScale);
  // Beside solids no longer than a voxel, or rays would step through thin ones.
  const double voxels =
    task.medium.solid == nullptr ? settings.stepVoxels : std::min(settings.stepVoxels, 1.);
  const double finest = medium.tree ? std::exp2(medium.tree->statistics().finestLevel) : 1;
  // No longer than it takes to be through all of it with one step, whatever rounding does.
  const double fastest = std::max(light.fastest(scaleOfSteps(medium, light, settings.kernel.path)),
    std::min(settings.stepVoxels, 1.) / (2 * finest * light.depth));
  const double step = voxels / fastest;
  task.step = static_cast<Real>(step);
  task.stepAtEdge = static_cast<Real>(std::min(settings.stepVoxels, 1.) / fastest);
  constexpr double margin = 1.01; // for the integrator's error
  task.largestQ = static_cast<Real>(margin * largestQOf(medium, light));
  const double straightSteps =
    std::ceil(light.depth / light.smallestCosine() / task.stepAtEdge * finest) + 1;
  constexpr double largestLimit = std::numeric_limits<std::int32_t>::max();
  // Where n is small, a step leads less far; and an adaptive one may have to be much shorter.
  constexpr double smallestIndex = 1e-3;
  const double slow = medium.largestNu < 1 ? 1 / std::max(1 - medium.largestNu, smallestIndex) : 1;
  // The error per length, which the tolerance limits, is of second order.
  const double finer = std::sqrt(std::max(1., usualTolerance / settings.adaptiveTolerance));
  const double shorter =
    settings.kernel.integrator == Integrator::Adaptive ? adaptiveFactor * finer : 1;
  task.stepLimit = static_cast<std::int32_t>(
    std::min(trappedFactor * straightSteps * slow * shorter, largestLimit));
  task.metresPerUnit = (1 + medium.ambient) * settings.lengthScale * light.unit;
  task.kernel = settings.kernel;
  // By what the steepest gradient would bend a ray over the same length, and no less than what rounding makes.
  const double steepest = length(scaled(medium.slope, light.indexScale));
  const double rounding =
    16 * medium.largestNu * static_cast<double>(std::numeric_limits<Real>::epsilon());
  const double allowed =
    std::max(settings.adaptiveTolerance * (steepest > 0 ? steepest : 1), rounding);
  task.allowedBend = static_cast<Real>(allowed);
  task.allowedOffset = static_cast<Real>(allowed * light.depth);
  return task;
}

template RayTask<float> makeTask(const Medium<float>&, const HomogeneityMap<float>*,
  const FieldGradientsView&, const Light&, const RaySettings&);
template RayTask<double> makeTask(const Medium<double>&, const HomogeneityMap<double>*,
  const FieldGradientsView&, const Light&, const RaySettings&);

} // namespace schlieren
