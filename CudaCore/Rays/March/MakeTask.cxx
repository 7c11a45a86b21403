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

/// Voxels of the finest leaves by index coordinates.
template <class Real>
double finestOf(const Medium<Real>& medium)
{
  return medium.tree ? std::exp2(medium.tree->statistics().finestLevel) : 1;
}

/// What d^2 |nu''| / 6 may be: that much of a bent ray's deflection a step of length d of leapfrog takes wrong.
constexpr double allowedOfBends = 1e-3;

/// How many voxels long a step may be where nu changes by no more than `perVoxel` from voxel to voxel, and nu'' therefore is no
/// more than twice that.
double voxelsAcross(double perVoxel)
{
  return std::max(1., std::sqrt(6 * allowedOfBends / (2 * perVoxel)));
}

/// Index coordinates that a step along the light is to be measured in, by the light's unit of length: voxels that it
/// crosses.
template <class Real>
Vec3<double> scaleAlong(const Medium<Real>& medium, const Light& light)
{
  Vec3<double> scale = light.indexScale;
  const bool isLayer = medium.tree != nullptr && medium.tree->shape() == BrickShape::Layer;
  scale.z = isLayer ? 0 : scale.z;
  return scale;
}

/// The same, of rays that bend. Each axis says how many of its own voxels a step may be long, by the steepest gradient along
/// it. So where nothing changes along a short edge of the voxels, as in a layer that is seen edge-on, that edge shortens no
/// step.
template <class Real>
Vec3<double> scaleOfSteps(const Medium<Real>& medium, const Light& light, PathModel path)
{
  const Vec3<double> scale = scaleAlong(medium, light);
  if (path == PathModel::Straight)
  {
    return scale;
  }
  const double finest = finestOf(medium);
  // What differs by rounding only does not change.
  const double rounding =
    8 * static_cast<double>(std::numeric_limits<Real>::epsilon()) * medium.largestNu;
  const auto leastFor = [&](double slope, double ofAxis)
  {
    const double byVoxel = slope / finest;
    return byVoxel > rounding ? ofAxis / voxelsAcross(byVoxel) : 0;
  };
  const double least = std::max({ leastFor(medium.slope.x, scale.x),
    leastFor(medium.slope.y, scale.y), leastFor(medium.slope.z, scale.z) });
  return { std::max(scale.x, least), std::max(scale.y, least), std::max(scale.z, least) };
}

/// The same, of steps that look for walls: they are so short that no ray can be bent through a wall along a short edge of the
/// voxels, whatever changes along that.
template <class Real>
Vec3<double> scaleAtWalls(const Medium<Real>& medium, const Light& light, PathModel path)
{
  const Vec3<double> scale = scaleAlong(medium, light);
  if (path == PathModel::Straight)
  {
    return scale;
  }
  const double perVoxel = std::max({ scale.x, scale.y, scale.z });
  const double steepest =
    std::max({ medium.slope.x * scale.x, medium.slope.y * scale.y, medium.slope.z * scale.z }) /
    perVoxel / finestOf(medium);
  const double least = perVoxel / voxelsAcross(steepest);
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

/// After how many steps a ray is trapped. `step`: the shortest.
template <class Real>
std::int32_t stepLimitOf(
  const Medium<Real>& medium, const Light& light, const RaySettings& settings, Real step)
{
  const double finest = finestOf(medium);
  const double path = light.depth / light.smallestCosine();
  const double shortest = std::min(settings.stepVoxels, 1.);
  const auto stepsOf = [&](double length) { return std::ceil(path / length * finest) + 1; };
  const double straightSteps = stepsOf(static_cast<double>(step));
  const double byVoxels = stepsOf(shortest / light.fastest(scaleAlong(medium, light)));
  // Where n is small, a step leads less far; and an adaptive one may have to be much shorter.
  constexpr double smallestIndex = 1e-3;
  const double slow = medium.largestNu < 1 ? 1 / std::max(1 - medium.largestNu, smallestIndex) : 1;
  // The error per length, which the tolerance limits, is of second order.
  const double finer = std::sqrt(std::max(1., usualTolerance / settings.adaptiveTolerance));
  const double shorter =
    settings.kernel.integrator == Integrator::Adaptive ? adaptiveFactor * finer : 1;
  const double most = std::min(straightSteps * slow * shorter,
    byVoxels * slow * shorter + mostStepsOfBends / trappedFactor / settings.stepVoxels * finer);
  constexpr double largestLimit = std::numeric_limits<std::int32_t>::max();
  return static_cast<std::int32_t>(std::min(trappedFactor * most, largestLimit));
}

} // namespace

template <class Real>
RayTask<Real> makeTask(const Medium<Real>& medium, const Light& light, const RaySettings& settings)
{
  RayTask<Real> task{};
  task.medium = medium.view();
  task.light = light;
  task.indexScale = static_cast<Vec3<Real>>(light.indexScale);
  const PathModel path = settings.kernel.path;
  const double finest = finestOf(medium);
  const double atMostVoxel = std::min(settings.stepVoxels, 1.);
  // No longer than it takes to be through all of it with one step, whatever rounding does.
  const auto stepOf = [&](double voxels, const Vec3<double>& scale)
  {
    return static_cast<Real>(
      voxels / std::max(light.fastest(scale), atMostVoxel / (2 * finest * light.depth)));
  };
  const Vec3<double> atWalls = scaleAtWalls(medium, light, path);
  // Beside solids no longer than a voxel, or rays would step through thin ones.
  task.step = task.medium.solid == nullptr
    ? stepOf(settings.stepVoxels, scaleOfSteps(medium, light, path))
    : stepOf(atMostVoxel, atWalls);
  task.stepAtEdge = stepOf(atMostVoxel, atWalls);
  constexpr double margin = 1.01; // for the integrator's error
  task.largestQ = static_cast<Real>(margin * largestQOf(medium, light));
  const Vec3<double>& scale = light.indexScale;
  const double widthOfLeaf = BrickMaker<Real>::edge;
  task.mayCrossLeaves = static_cast<double>(task.step) * static_cast<double>(task.largestQ) *
      std::max({ scale.x, scale.y, scale.z }) >
    widthOfLeaf;
  task.stepLimit = stepLimitOf(medium, light, settings, task.stepAtEdge);
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

template RayTask<float> makeTask(const Medium<float>&, const Light&, const RaySettings&);
template RayTask<double> makeTask(const Medium<double>&, const Light&, const RaySettings&);

} // namespace schlieren
