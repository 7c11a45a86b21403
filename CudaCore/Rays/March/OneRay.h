// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Rays/March/Marcher.h"

#include <cmath>
#include <cstdint>

namespace schlieren
{

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
  chord.from = maximum(chord.from, minimum(a, b));
  chord.to = minimum(chord.to, maximum(a, b));
}

/// A ray where it enters the grid.
struct Entry
{
  double from;     ///< entry plane to there, along w
  double slope[2]; ///< of the undisturbed ray, along u and v
  double cosine;   ///< between it and w
};

/// Puts a ray of a pass where it meets the grid, without a look at the medium there.
template <class Number, int Lanes>
SCHLIEREN_HD Entry meetGrid(const RayTask<Number>& task, const Pass& pass, std::int64_t ray,
  RayBatch<Number, Lanes>& batch, int i)
{
  batch.steps[i] = 0;
  const Light& light = task.light;
  const double column = pass.columnOf(ray), row = pass.rowOf(ray);
  Vec3<double> start = light.start(column, row);
  double slope[2] = { 0, 0 };
  double cosine = 1;
  Vec3<double> steep = light.w, along = light.perLength, per = light.lengthPer;
  if (light.inclination.isInclined(pass.tilt)) // else nothing to divide by
  {
    start += light.shift(pass.tilt);
    slope[0] = light.inclination.at(0, column, pass.tilt[0]);
    slope[1] = light.inclination.at(1, row, pass.tilt[1]);
    cosine = 1 / std::sqrt(1 + slope[0] * slope[0] + slope[1] * slope[1]);
    steep = light.w + slope[0] * light.u + slope[1] * light.v;
    along = scaled(light.indexScale, steep);
    per = { 1 / along.x, 1 / along.y, 1 / along.z };
  }
  const Vec3<double>& last = task.medium.last;
  Chord chord{ light.first, light.depth };
  clip(chord, start.x, along.x, per.x, last.x);
  clip(chord, start.y, along.y, per.y, last.y);
  clip(chord, start.z, along.z, per.z, last.z);
  if (!(chord.from < chord.to))
  {
    batch.fate[i] = RayFate::Missed;
    return {};
  }
  const Vec3<double> at = clampTo(start + chord.from * along, last);
  const auto put = [i](const auto& from, auto& to)
  {
    to[0][i] = from.x;
    to[1][i] = from.y;
    to[2][i] = from.z;
  };
  put(at, batch.start);
  put(static_cast<Vec3<Number>>(cosine * steep), batch.direction);
  put(static_cast<Vec3<Number>>(cosine * along), batch.perLength);
  batch.fate[i] = RayFate::Left;
  return { chord.from, { slope[0], slope[1] }, cosine };
}

template <class Number, int Lanes>
SCHLIEREN_HD Vec3<double> startOf(const RayBatch<Number, Lanes>& batch, int i)
{
  return { batch.start[0][i], batch.start[1][i], batch.start[2][i] };
}

/// Puts a ray of a pass where it enters the grid, if no wall is there: the steps' middles do not look at the grid's faces.
template <class Number, int Lanes>
SCHLIEREN_HD Entry enterGrid(const RayTask<Number>& task, const Pass& pass, std::int64_t ray,
  RayBatch<Number, Lanes>& batch, int i)
{
  const Entry entry = meetGrid(task, pass, ray, batch, i);
  if (batch.fate[i] == RayFate::Left && isWallAt(task.medium, startOf(batch, i)))
  {
    batch.fate[i] = RayFate::Blocked;
  }
  return entry;
}

/// Whether the faces let light of p = d + q out, along u, v and w: it may be reflected totally.
SCHLIEREN_HD bool leavesThrough(
  const ExitFaces& faces, const Vec3<double>& d, const Vec3<double>& q)
{
  const double u = faces.ratio * (d.x + q.x), v = faces.ratio * (d.y + q.y);
  return !faces.refract || u * u + v * v < 1;
}

/// Finds by how much light of p = d + q, to first order in q unless it bends, has turned behind the faces.
SCHLIEREN_HD void findDeflection(const ExitFaces& faces, const Vec3<double>& d,
  const Vec3<double>& q, bool bends, double (&deflection)[2])
{
  double perMomentum = faces.ratio;
  double longer = 0;
  if (!faces.refract)
  {
    perMomentum = 1;
    longer = dot(d, q); // 1 - 1 / |p|
    if (bends)
    {
      const double momentum = length(d + q);
      const double perBoth = 1 / (momentum * (momentum + 1));
      perMomentum = (momentum + 1) * perBoth;
      longer = (2 * longer + dot(q, q)) * perBoth;
    }
  }
  deflection[0] = q.x * perMomentum - d.x * longer;
  deflection[1] = q.y * perMomentum - d.y * longer;
}

/// What becomes of a ray whose march is over.
template <class Number, int Lanes>
SCHLIEREN_HD RayExit leaveGrid(
  const RayTask<Number>& task, const RayBatch<Number, Lanes>& batch, int i, const Entry& entry)
{
  RayExit exit{ { 0, 0 }, { 0, 0 }, 0, batch.fate[i], batch.steps[i] };
  if (exit.fate != RayFate::Left)
  {
    return exit;
  }
  const auto of = [i](const Number(&from)[3][Lanes]) {
    return Vec3<Number>{ from[0][i], from[1][i], from[2][i] };
  };
  const Vec3<Number> gridOffset = of(batch.offset);
  if (task.medium.solid != nullptr &&
    isSolid(task.medium, clampTo(of(batch.end), task.medium.leafHigh)))
  {
    exit.fate = RayFate::Blocked;
    return exit;
  }
  const Light& light = task.light;
  const Vec3<double> ofGrid = static_cast<Vec3<double>>(of(batch.q));
  const Vec3<double> q = { dot(ofGrid, light.u), dot(ofGrid, light.v), dot(ofGrid, light.w) };
  const Vec3<double> d = { entry.slope[0] * entry.cosine, entry.slope[1] * entry.cosine,
    entry.cosine };
  const bool bends = task.kernel.path != PathModel::Straight;
  // p = d + q; of a straight ray to first order in q.
  const double forward = bends ? d.z + q.z : d.z;
  if (!(forward > 0) || !leavesThrough(light.faces, d, q))
  {
    exit.fate = RayFate::Turned;
    return exit;
  }
  findDeflection(light.faces, d, q, bends, exit.deflection);
  exit.opticalPathDifference =
    (static_cast<double>(batch.path[i]) - static_cast<double>(batch.pathError[i])) *
    task.metresPerUnit;

  // From where it leaves the grid, straight on to the exit plane, and how far it is from the undisturbed ray
  // there: p.u / p.w - d.u / d.w per unit along w, where d.u / d.w is the slope.
  const Vec3<double> offset = scaled(light.unitsPerIndex, static_cast<Vec3<double>>(gridOffset));
  const double ahead = dot(offset, light.w);
  const double remaining = light.depth - entry.from -
    static_cast<double>(batch.length[i]) * entry.cosine - (bends ? ahead : 0);
  const double further = remaining / forward;
  if (bends)
  {
    // It is longer than that of the undisturbed wave by 1 - d.p / |p| per unit, which is |p / |p| - d|^2 / 2.
    const double momentum = length(d + q);
    const Vec3<double> turned = q - ((2 * dot(d, q) + dot(q, q)) / (momentum + 1)) * d;
    exit.opticalPathDifference +=
      0.5 * further / momentum * dot(turned, turned) * task.metresPerUnit;
  }
  exit.displacement[0] = static_cast<float>(
    (dot(offset, light.u) - ahead * entry.slope[0] + further * (q.x - q.z * entry.slope[0])) *
    light.unit);
  exit.displacement[1] = static_cast<float>(
    (dot(offset, light.v) - ahead * entry.slope[1] + further * (q.y - q.z * entry.slope[1])) *
    light.unit);
  return exit;
}

/// Traces one ray of a pass, with the kernel that is given.
template <class Kernel, class May, class Number>
SCHLIEREN_HD RayExit traceRay(
  const RayTask<Number>& task, const Pass& pass, std::int64_t ray, Number& drift)
{
  RayBatch<Number, 1> batch{};
  const Entry entry = enterGrid(task, pass, ray, batch, 0);
  march<Kernel, Number, May>(task, batch);
  drift = batch.drift[0];
  return leaveGrid(task, batch, 0, entry);
}

} // namespace schlieren
