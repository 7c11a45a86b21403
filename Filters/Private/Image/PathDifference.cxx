// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Image/PathDifference.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace filters
{

namespace
{

/// numbers = middle + scale (numbers - others)
template <class Number>
void subtract(schlieren::PixelArray<Number>& numbers, const schlieren::PixelArray<Number>& others,
  Number middle = 0, Number scale = 1)
{
  for (std::size_t i = 0; i < std::min(numbers.size(), others.size()); ++i)
  {
    numbers[i] = middle + scale * (numbers[i] - others[i]);
  }
}

/// Adds the numbers of rays and steps, and the time.
void addRays(schlieren::Image& sum, const schlieren::Image& image)
{
  sum.raysTraced += image.raysTraced;
  sum.stepsTaken += image.stepsTaken;
  sum.raysBlocked += image.raysBlocked;
  sum.raysLost += image.raysLost;
  sum.traceSeconds += image.traceSeconds;
}

schlieren::Image differenceOf(
  schlieren::Image&& refracted, const schlieren::Image& straight, double middle)
{
  schlieren::Image image = std::move(refracted);
  const auto level = static_cast<float>(middle);
  subtract(image.intensity, straight.intensity, level, 0.5f);
  subtract(image.color, straight.color, level, 0.5f);
  subtract(image.backgroundDisplacement, straight.backgroundDisplacement);
  subtract(image.deflection, straight.deflection);
  subtract(image.opticalPathDifference, straight.opticalPathDifference);
  subtract(image.displacement, straight.displacement);
  subtract(image.blockedFraction, straight.blockedFraction);
  image.undisturbedLevel = middle;
  addRays(image, straight);
  image.accuracy.reached = 0.5 * std::hypot(image.accuracy.reached, straight.accuracy.reached);
  image.accuracy.largest = 0.5 * std::hypot(image.accuracy.largest, straight.accuracy.largest);
  image.accuracy.ofData = 0.5 * std::hypot(image.accuracy.ofData, straight.accuracy.ofData);
  schlieren::PixelArray<float>& estimate = image.accuracy.estimate;
  const schlieren::PixelArray<float>& ofStraight = straight.accuracy.estimate;
  for (std::size_t i = 0; i < std::min(estimate.size(), ofStraight.size()); ++i)
  {
    estimate[i] = 0.5F * std::hypot(estimate[i], ofStraight[i]);
  }
  image.samples = std::min(image.samples, straight.samples);
  image.finished = image.finished && straight.finished;
  return image;
}

} // namespace

//------------------------------------------------------------------------------
schlieren::Image PathDifference::Begin(
  const schlieren::Field& field, const schlieren::Scene& scene, const MonitorOf& monitorOf)
{
  this->Cancel();
  for (const Path path : { REFRACTED, STRAIGHT })
  {
    this->Scenes[path] = scene;
    this->Scenes[path].memoryBudget = scene.memoryBudget / 2;
  }
  this->Scenes[REFRACTED].pathModel = schlieren::PathModel::Refracted;
  this->Scenes[STRAIGHT].pathModel = schlieren::PathModel::Straight;
  this->Scenes[STRAIGHT].histogramSize = 0;
  this->Field = field;
  return this->Resume(monitorOf);
}

//------------------------------------------------------------------------------
schlieren::Image PathDifference::Resume(const MonitorOf& monitorOf)
{
  bool hasNew = false;
  for (const Path path : { REFRACTED, STRAIGHT })
  {
    const auto& other = this->Images[path == REFRACTED ? STRAIGHT : REFRACTED];
    const bool isDone = this->Images[path] && this->Images[path]->finished;
    if (isDone || (path == STRAIGHT && !other)) // k follows from the other image
    {
      continue;
    }
    schlieren::Monitor monitor = monitorOf(other && other->finished ? 1 : 0.5);
    if (monitor.progress)
    {
      monitor.progress = [this, path, report = monitor.progress](double done)
      {
        this->Done[path] = done;
        report((this->Done[REFRACTED] + this->Done[STRAIGHT]) / 2);
      };
    }
    schlieren::Bench& bench = *this->Benches[path];
    schlieren::Image image = bench.isUnfinished()
      ? bench.resume(monitor)
      : bench.render(*this->Field, this->Scenes[path], monitor);
    if (image.aborted)
    {
      this->Cancel();
      return image;
    }
    if (!image.intensity.empty())
    {
      this->Images[path] = std::move(image);
      hasNew = true;
    }
    if (path == REFRACTED && hasNew && this->Images[path]->kScale > 0)
    {
      this->Scenes[STRAIGHT].kScale = this->Images[path]->kScale;
    }
  }
  auto& [refracted, straight] = this->Images;
  if (!hasNew || !straight)
  {
    schlieren::Image nothing;
    nothing.finished = false;
    return nothing;
  }
  const schlieren::Technique& technique = schlieren::techniqueOf(this->Scenes[REFRACTED].cutoff);
  const double middle = technique.plane == schlieren::RecordedPlane::Screen ? 1 : 0.5;
  if (!refracted->finished || !straight->finished)
  {
    return differenceOf(schlieren::Image(*refracted), *straight, middle);
  }
  schlieren::Image image = differenceOf(std::move(*refracted), *straight, middle);
  this->Cancel();
  return image;
}

//------------------------------------------------------------------------------
void PathDifference::Cancel()
{
  for (const Path path : { REFRACTED, STRAIGHT })
  {
    this->Benches[path]->cancel();
    this->Images[path].reset();
    this->Done[path] = 0;
  }
  this->Field.reset();
}

} // namespace filters
