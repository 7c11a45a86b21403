// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// What it costs rays that each process has a part of the medium: processor seconds of all processes, which are threads
// here, against those of one process that has all. 512^2 rays, Quadratic in single precision, medians of all
// turns. Also how far deflections are from those of that process, by the largest one.
//
//   SchlierenDistributedRayBenchmarks [turns [processes ...]]
#include "MeasuredTrees.h"
#include "Rays/DistributedTracer.h"
#include "WorkerThread.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <memory>
#include <vector>

namespace
{

using namespace schlieren;

double secondsOf(const std::function<void()>& work)
{
  const std::clock_t start = std::clock();
  work();
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

double median(std::vector<double> all)
{
  std::sort(all.begin(), all.end());
  return all[all.size() / 2];
}

struct Flow
{
  const char* name;
  std::shared_ptr<const AnalyticSource> source;
  Vector middle;
  double half, finest;
};

Medium<float> coarseTree(const Flow& flow, const std::shared_ptr<BrickOwners>& owners)
{
  Field field;
  field.source = flow.source;
  field.grid = coarsestGrid(*flow.source);
  TreeSettings settings;
  settings.tolerance = 0.01;
  settings.owners = owners;
  return buildTree<float>(field, settings);
}

struct Rays
{
  Rays(const Flow& flow, const Direction& direction, Integrator integrator,
    const std::shared_ptr<BrickOwners>& owners)
    : medium(coarseTree(flow, owners))
  {
    const Grid grid = coarsestGrid(*flow.source);
    View view;
    view.viewDirection = direction.view;
    view.focalPoint = flow.middle;
    view.parallelScale = flow.half;
    const Light light = collimatedLight(grid, frameOf(grid, view));
    const Vec3<double> centre{ flow.middle[0], flow.middle[1], flow.middle[2] };
    refine(medium,
      { light.u, light.v, { dot(centre, light.u), dot(centre, light.v) }, { flow.half, flow.half },
        flow.finest },
      {});
    RaySettings settings;
    settings.kernel.integrator = integrator;
    task = makeTask<float>(medium, nullptr, FieldGradientsView{}, light, settings);
    pass = { 0, 0, view.width, view.height, { 0, 0 } };
    traced.resize(pass, 0);
  }

  Medium<float> medium;
  RayTask<float> task{};
  Pass pass{};
  TracedPass traced;
};

/// Of deflections, by the largest: the worst difference, the mean one, and which part is above 1e-6.
struct Difference
{
  double worst = 0, mean = 0, above = 0;
};
Difference differenceOf(const RayExits& a, const RayExits& b)
{
  double largest = 0;
  for (const RayExit& exit : b)
  {
    largest = std::max({ largest, std::abs(exit.deflection[0]), std::abs(exit.deflection[1]) });
  }
  Difference difference;
  const double count = 2 * static_cast<double>(a.size());
  for (std::size_t n = 0; n < a.size(); ++n)
  {
    for (int axis = 0; axis < 2; ++axis)
    {
      const double by = std::abs(a[n].deflection[axis] - b[n].deflection[axis]) / largest;
      difference.worst = std::max(difference.worst, by);
      difference.mean += by / count;
      difference.above += by > 1e-6 ? 1 / count : 0;
    }
  }
  return difference;
}

struct Method
{
  const char* name;
  Integrator integrator;
};

void compare(const Flow& flow, const Direction& direction, const Method& method,
  std::size_t processes, int turns)
{
  Rays alone(flow, direction, method.integrator, nullptr);
  std::vector<std::unique_ptr<Worker>> workers;
  std::vector<Channel*> channels;
  while (workers.size() + 1 < processes)
  {
    workers.push_back(std::make_unique<Worker>());
    channels.push_back(workers.back()->channel());
  }
  const auto owners = std::make_shared<BrickChannels>(channels);
  Rays parts(flow, direction, method.integrator, owners);
  DistributedTracer<float> tracer(parts.medium, *owners);
  std::vector<double> seconds, ratio;
  for (int turn = 0; turn < turns; ++turn)
  {
    const double ofAll =
      secondsOf([&] { traceOnCpu(alone.task, alone.pass, alone.traced, 1, {}, bestSimd()); });
    const double ofParts =
      secondsOf([&] { tracer.trace(parts.task, parts.pass, parts.traced, 1, {}); });
    seconds.push_back(ofAll);
    ratio.push_back(ofParts / ofAll);
  }
  const Difference difference = differenceOf(parts.traced.exits, alone.traced.exits);
  const double rays = static_cast<double>(parts.traced.crossed) * turns;
  const auto& traffic = tracer.traffic();
  const auto perRay = [rays](std::int64_t count) { return static_cast<double>(count) / rays; };
  std::printf(
    "| %s | %s | %s | %zu | %.3f | %.2f | %.2f | %.2f | %.0f | %.4f | %.0f | %.4f | %.1e | "
    "%.1e | %.1e |\n",
    flow.name, direction.name, method.name, processes, median(seconds), median(ratio),
    *std::min_element(ratio.begin(), ratio.end()),
    perRay(traffic.own.states + traffic.amongWorkers.states), perRay(traffic.own.bytes),
    perRay(traffic.own.messages), perRay(traffic.amongWorkers.bytes),
    perRay(traffic.amongWorkers.messages), difference.worst, difference.mean, difference.above);
  std::fflush(stdout);
}

} // namespace

int main(int count, char** arguments)
{
  const int turns = count > 1 ? std::max(std::atoi(arguments[1]), 1) : 5;
  std::vector<std::size_t> numbers;
  for (int n = 2; n < count; ++n)
  {
    numbers.push_back(static_cast<std::size_t>(std::max(std::atoi(arguments[n]), 1)));
  }
  if (numbers.empty())
  {
    numbers = { 1, 4 };
  }
  std::puts(
    "| medium | view | integrator | processes | seconds of one that has all | times as long | "
    "least | "
    "states/ray | bytes/ray of the first process | messages/ray of it | bytes/ray among others | "
    "messages/ray among them | worst difference | mean | above 1e-6 |");
  std::puts("|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|");
  const Flow flows[] = { { "three balls", std::make_shared<BallsSource>(threeBalls(1e-4)),
                           { 0, 0, 0 }, 0.6, 1e-4 },
    { "bow shock and body", std::make_shared<BowShockSource>(), { 0.5, 0, 0 }, 3, 6. / 512 } };
  for (const Flow& flow : flows)
  {
    for (const Direction& direction : { directions[0], directions[2] })
    {
      for (const Method& method : { Method{ "Leapfrog", Integrator::Leapfrog },
             Method{ "Rk4", Integrator::Rk4 }, Method{ "Adaptive", Integrator::Adaptive } })
      {
        for (const std::size_t processes : numbers)
        {
          compare(flow, direction, method, processes, turns);
        }
      }
    }
  }
  return 0;
}
