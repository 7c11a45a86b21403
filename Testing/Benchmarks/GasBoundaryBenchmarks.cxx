// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Where the gas of a mesh ends: a sphere of radius 1 in a mesh of 1.2 million hexahedra with a far field of radius
// 50. To find its boundary, to sample bricks near the wall, and to find what places in the sphere are.
#include "Walls/GasBoundary.h"

#include "vtkDoubleArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkSmartPointer.h"
#include "vtkStructuredGrid.h"

#include <benchmark/benchmark.h>

#include <cmath>
#include <random>

namespace
{

using filters::GasBoundary;
using filters::Point;

vtkSmartPointer<vtkDataSet> sphereMesh()
{
  constexpr int n[3] = { 108, 76, 151 };
  constexpr double pi = 3.14159265358979323846;
  auto mesh = vtkSmartPointer<vtkStructuredGrid>::New();
  mesh->SetDimensions(n);
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (int k = 0; k < n[2]; ++k)
  {
    for (int j = 0; j < n[1]; ++j)
    {
      for (int i = 0; i < n[0]; ++i)
      {
        const double r = std::pow(50, i / (n[0] - 1.));
        const double theta = pi * j / (n[1] - 1), phi = 2 * pi * k / (n[2] - 1);
        points->InsertNextPoint(r * std::sin(theta) * std::cos(phi),
          r * std::sin(theta) * std::sin(phi), r * std::cos(theta));
      }
    }
  }
  mesh->SetPoints(points);
  vtkNew<vtkDoubleArray> values;
  values->SetNumberOfValues(mesh->GetNumberOfPoints());
  values->Fill(1e-4);
  mesh->GetPointData()->SetScalars(values);
  return mesh;
}

void findBoundary(benchmark::State& state)
{
  const auto mesh = sphereMesh();
  for (auto _ : state)
  {
    const GasBoundary boundary({ mesh }, nullptr, filters::Outside::Auto, {});
    benchmark::DoNotOptimize(&boundary);
  }
}

/// Bricks of range(0)^3 points whose spacing is range(1) / 1000.
void sampleBricks(benchmark::State& state)
{
  static const auto mesh = sphereMesh();
  static const GasBoundary boundary({ mesh }, nullptr, filters::Outside::Auto, {});
  const auto points = static_cast<int>(state.range(0));
  const double h = 1e-3 * static_cast<double>(state.range(1));
  struct Brick
  {
    schlieren::Lattice lattice;
    std::vector<unsigned char> isInCell;
  };
  std::vector<Brick> bricks(50);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-1, 1);
  for (Brick& brick : bricks)
  {
    const Point middle = filters::unit(Point{ any(random), any(random), any(random) });
    brick.lattice = { middle, { h, h, h }, { points, points, points } };
    for (double& first : brick.lattice.first)
    {
      first += (8 * any(random) - 0.5 * points) * h;
    }
    for (int k = 0; k < points; ++k)
    {
      for (int j = 0; j < points; ++j)
      {
        for (int i = 0; i < points; ++i)
        {
          const Point& first = brick.lattice.first;
          const Point x{ first[0] + i * h, first[1] + j * h, first[2] + k * h };
          brick.isInCell.push_back(filters::norm(x) > 1 ? 1 : 0);
        }
      }
    }
  }
  std::vector<schlieren::Place> places(bricks[0].isInCell.size());
  std::vector<float> distances(places.size());
  std::size_t next = 0;
  for (auto _ : state)
  {
    const Brick& brick = bricks[next++ % bricks.size()];
    boundary.sample(brick.lattice, brick.isInCell.data(), places.data(), distances.data());
    benchmark::DoNotOptimize(distances.data());
  }
}

void findKindsInBody(benchmark::State& state)
{
  static const auto mesh = sphereMesh();
  static const GasBoundary boundary({ mesh }, nullptr, filters::Outside::Auto, {});
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-0.5, 0.5);
  std::vector<Point> places(1000);
  for (Point& place : places)
  {
    place = { any(random), any(random), any(random) };
  }
  std::size_t next = 0;
  for (auto _ : state)
  {
    benchmark::DoNotOptimize(boundary.kindAt(places[next++ % places.size()], false));
  }
}

} // namespace

BENCHMARK(findBoundary)->Unit(benchmark::kMillisecond);
BENCHMARK(findKindsInBody)->Unit(benchmark::kMicrosecond);
BENCHMARK(sampleBricks)
  ->Unit(benchmark::kMicrosecond)
  ->ArgNames({ "points", "spacing" })
  ->ArgsProduct({ { 20, 24 }, { 5, 10, 20, 40, 80 } });
