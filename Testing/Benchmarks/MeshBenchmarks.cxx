// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// Adaptive meshes of many blocks to refractivity on a grid. And other meshes: the first conversion, which searches the cells that hold the grid's
// points; the third, which has kept them; and vtkResampleToImage, on the same mesh and in turns with the
// others, so that all meet the same machine. The least times of all turns.
#include "Cells/CellSampler.h"
#include "Cells/CellTree.h"

#include "Sources/MediumMaker.h"
#include "vtkCellData.h"
#include "vtkCellType.h"
#include "vtkDataSetTriangleFilter.h"
#include "vtkDoubleArray.h"
#include "vtkImageData.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkRefractiveIndex.h"
#include "vtkResampleToImage.h"
#include "vtkSMPTools.h"
#include "vtkSmartPointer.h"
#include "vtkStructuredGrid.h"
#include "vtkUnstructuredGrid.h"
#include "vtkXMLUnstructuredGridReader.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <functional>
#include <memory>
#include <numeric>
#include <stdexcept>
#include <vector>

namespace
{

using Mesh = vtkSmartPointer<vtkDataSet>;
using Reconstruction = filters::CellTree::Reconstruction;

vtkSmartPointer<vtkImageData> cube(int points)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(points, points, points);
  image->SetSpacing(1. / (points - 1), 1. / (points - 1), 1. / (points - 1));
  return image;
}

/// n^3 hexahedra, parallelepipeds or moved so that they are none.
vtkSmartPointer<vtkUnstructuredGrid> hexahedra(int n, bool isDistorted)
{
  const auto image = cube(n + 1);
  auto mesh = vtkSmartPointer<vtkUnstructuredGrid>::New();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    double x[3];
    image->GetPoint(i, x);
    const double move = isDistorted ? 0.3 / n * std::sin(37. * static_cast<double>(i)) : 0;
    points->InsertNextPoint(x[0] + move * x[0] * (1 - x[0]), x[1] + move * x[1] * (1 - x[1]),
      x[2] + move * x[2] * (1 - x[2]));
  }
  mesh->SetPoints(points);
  mesh->Allocate(image->GetNumberOfCells());
  vtkNew<vtkIdList> ids;
  for (vtkIdType i = 0; i < image->GetNumberOfCells(); ++i)
  {
    image->GetCellPoints(i, ids);
    std::swap(*ids->GetPointer(2), *ids->GetPointer(3)); // a voxel's to a hexahedron's order
    std::swap(*ids->GetPointer(6), *ids->GetPointer(7));
    mesh->InsertNextCell(VTK_HEXAHEDRON, ids);
  }
  return mesh;
}

Mesh tetrahedra(int n)
{
  vtkNew<vtkDataSetTriangleFilter> cut;
  cut->SetInputData(cube(n + 1));
  cut->Update();
  return cut->GetOutput();
}

Mesh cubicHexahedra()
{
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName(SCHLIEREN_TEST_DATA "/blob_lagrange_hex.vtu");
  reader->Update();
  return reader->GetOutput();
}

double secondsOf(const std::function<void()>& work)
{
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Of all threads: says more than the time where others use the machine, too.
double processorSecondsOf(const std::function<void()>& work)
{
  const std::clock_t start = std::clock();
  work();
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

/// The largest difference of points that both have, relative to the largest value; -1 where one has more.
double difference(vtkImageData* ours, vtkImageData* other)
{
  vtkDataArray* a = ours->GetPointData()->GetArray("Refractivity");
  vtkDataArray* b = other->GetPointData()->GetArray("N");
  vtkDataArray* inA = ours->GetPointData()->GetArray("vtkValidPointMask");
  vtkDataArray* inB = other->GetPointData()->GetArray("vtkValidPointMask");
  double worst = 0, most = 0;
  for (vtkIdType i = 0; i < a->GetNumberOfTuples(); ++i)
  {
    if (inA->GetComponent(i, 0) != 0 && inB->GetComponent(i, 0) != 0)
    {
      worst = std::max(worst, std::abs(a->GetComponent(i, 0) - b->GetComponent(i, 0)));
      most = std::max(most, std::abs(b->GetComponent(i, 0)));
    }
  }
  return worst / most;
}

/// Arguments: grid points per axis, threads.
void sample(benchmark::State& state, const std::function<Mesh()>& make)
{
  const int n = static_cast<int>(state.range(0));
  const Mesh mesh = make();
  vtkNew<vtkDoubleArray> values;
  values->SetName("N");
  for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
  {
    const double* x = mesh->GetPoint(i);
    values->InsertNextValue(3e-4 * std::exp(-10 * (x[0] * x[0] + x[1] * x[1])) + 1e-5 * x[2]);
  }
  mesh->GetPointData()->Initialize();
  mesh->GetPointData()->AddArray(values);

  const auto convert = [&](vtkRefractiveIndex* filter, vtkImageData* output)
  {
    filter->SetNumberOfThreads(static_cast<int>(state.range(1)));
    filter->SetIndexModel(vtkRefractiveIndex::REFRACTIVITY);
    filter->SetInputArrayToProcess(
      vtkRefractiveIndex::INDEX_ARRAY, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "N");
    filter->SetSamplingDimensions(n, n, n);
    filter->SetDoublePrecision(true);
    filter->GetMaker().convert(mesh, output, nullptr, filters::Numbers::Singles);
  };
  vtkNew<vtkRefractiveIndex> kept;
  vtkNew<vtkImageData> output;
  convert(kept, output);
  double first = 1e30, next = 1e30, vtk = 1e30;
  vtkNew<vtkResampleToImage> resampler;
  resampler->SetInputDataObject(mesh);
  resampler->SetSamplingDimensions(n, n, n);
  const vtkSMPTools::Config threads(static_cast<int>(state.range(1)), "STDThread", false);
  for (auto _ : state)
  {
    vtkNew<vtkRefractiveIndex> fresh;
    first = std::min(first, secondsOf([&] { convert(fresh, output); }));
    next = std::min(next, secondsOf([&] { convert(kept, output); }));
    resampler->Modified();
    vtkSMPTools::LocalScope(
      threads, [&] { vtk = std::min(vtk, secondsOf([&] { resampler->Update(); })); });
  }
  if (kept->GetMeshBuilds() != 1)
  {
    throw std::logic_error("The mesh was not kept.");
  }
  state.counters["first/s"] = first;
  state.counters["next/s"] = next;
  state.counters["vtk/s"] = vtk;
  state.counters["difference"] = difference(output, resampler->GetOutput());
}

BENCHMARK_CAPTURE(sample, tetrahedra_1080000, [] { return tetrahedra(60); })
  ->ArgNames({ "n", "threads" })
  ->ArgsProduct({ { 121 }, { 1, 2 } })
  ->Iterations(2)
  ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(sample, parallelepipeds_262144, [] { return hexahedra(64, false); })
  ->ArgNames({ "n", "threads" })
  ->ArgsProduct({ { 129 }, { 1, 2 } })
  ->Iterations(2)
  ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(sample, hexahedra_262144, [] { return hexahedra(64, true); })
  ->ArgNames({ "n", "threads" })
  ->ArgsProduct({ { 129 }, { 1, 2 } })
  ->Iterations(2)
  ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(sample, cubicHexahedra, cubicHexahedra)
  ->ArgNames({ "n", "threads" })
  ->ArgsProduct({ { 65 }, { 1, 2 } })
  ->Iterations(2)
  ->Unit(benchmark::kMillisecond);

/// A block of 4^3 cells with N in them.
vtkSmartPointer<vtkImageData> amrBlock(int i, int j, int k, double h)
{
  auto block = vtkSmartPointer<vtkImageData>::New();
  block->SetDimensions(5, 5, 5);
  block->SetSpacing(h, h, h);
  block->SetOrigin(4 * i * h, 4 * j * h, 4 * k * h);
  vtkNew<vtkDoubleArray> values;
  values->SetName("N");
  for (int cell = 0; cell < 64; ++cell)
  {
    values->InsertNextValue(1e-4 * std::sin(i + 0.7 * j + 1.3 * k + cell));
  }
  block->GetCellData()->AddArray(values);
  return block;
}

/// Argument: blocks along each axis, of which an eighth is refined into eight each: twice as many in all.
void amr(benchmark::State& state)
{
  const int n = static_cast<int>(state.range(0));
  vtkNew<vtkMultiBlockDataSet> blocks;
  const auto add = [&](vtkImageData* block)
  { blocks->SetBlock(blocks->GetNumberOfBlocks(), block); };
  for (int k = 0; k < n; ++k)
  {
    for (int j = 0; j < n; ++j)
    {
      for (int i = 0; i < n; ++i)
      {
        add(amrBlock(i, j, k, 1. / n));
        if (i < n / 2 && j < n / 2 && k < n / 2)
        {
          for (int part = 0; part < 8; ++part)
          {
            add(
              amrBlock(2 * i + (part & 1), 2 * j + (part >> 1 & 1), 2 * k + (part >> 2), 0.5 / n));
          }
        }
      }
    }
  }
  vtkNew<vtkRefractiveIndex> filter;
  filter->SetIndexModel(vtkRefractiveIndex::REFRACTIVITY);
  filter->SetInputArrayToProcess(
    vtkRefractiveIndex::INDEX_ARRAY, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "N");
  vtkNew<vtkImageData> output;
  double seconds = 1e30;
  for (auto _ : state)
  {
    seconds = std::min(seconds,
      secondsOf(
        [&] { filter->GetMaker().convert(blocks, output, nullptr, filters::Numbers::Singles); }));
  }
  double sum = 0;
  vtkDataArray* values = output->GetPointData()->GetArray("Refractivity");
  for (vtkIdType i = 0; i < values->GetNumberOfTuples(); ++i)
  {
    sum += (i % 7 + 1) * values->GetComponent(i, 0);
  }
  state.SetLabel(filter->GetGrid());
  state.counters["blocks"] = blocks->GetNumberOfBlocks();
  state.counters["s"] = seconds;
  state.counters["sum"] = sum; // the same whatever is made faster
}

/// A body-fitted mesh around a sphere of radius 1, out to 50: the first cell is 0.01 thick.
Mesh aroundSphere(int radial, int polar, int around)
{
  double low = 1, high = 2; // ratio of one cell to the next
  for (int i = 0; i < 60; ++i)
  {
    const double ratio = (low + high) / 2;
    (0.01 * (std::pow(ratio, radial - 1) - 1) / (ratio - 1) > 49 ? high : low) = ratio;
  }
  auto mesh = vtkSmartPointer<vtkStructuredGrid>::New();
  mesh->SetDimensions(radial, polar, around);
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  constexpr double pi = 3.14159265358979323846;
  for (int k = 0; k < around; ++k)
  {
    for (int j = 0; j < polar; ++j)
    {
      for (int i = 0; i < radial; ++i)
      {
        const double r = 1 + 0.01 * (std::pow(low, i) - 1) / (low - 1);
        const double a = pi * j / (polar - 1), b = 2 * pi * (k % (around - 1)) / (around - 1);
        points->InsertNextPoint(
          r * std::sin(a) * std::cos(b), r * std::sin(a) * std::sin(b), r * std::cos(a));
      }
    }
  }
  mesh->SetPoints(points);
  return mesh;
}

/// 16 samples and two more to each side.
schlieren::Lattice brickOf(const schlieren::Box& box)
{
  schlieren::Lattice brick;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    brick.spacing[axis] = (box.high[axis] - box.low[axis]) / 16;
    brick.first[axis] = box.low[axis] - 1.5 * brick.spacing[axis];
    brick.points[axis] = 20;
  }
  return brick;
}

/// Leaves of an octree, as a view needs them that looks along z at |x|, |y| < column: as fine as the cells.
void addBricks(const filters::CellTree& tree, const schlieren::Box& box, double column,
  double finest, std::vector<schlieren::Lattice>& bricks)
{
  const filters::CellTree::Content content = tree.content({ box.low, box.high });
  if (content.lowest > content.highest)
  {
    return;
  }
  const schlieren::Lattice brick = brickOf(box);
  constexpr double part = 0.5; // of a cell
  bool isInView = true, isFine = false;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    isInView = isInView && (axis == 2 || (box.low[axis] < column && box.high[axis] > -column));
    isFine = isFine || brick.spacing[axis] <= std::max(finest, part * content.cellSize[axis]);
  }
  if (isFine || !isInView)
  {
    bricks.push_back(brick);
    return;
  }
  for (int child = 0; child < 8; ++child)
  {
    schlieren::Box octant = box;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const double middle = (box.low[axis] + box.high[axis]) / 2;
      (child >> axis & 1 ? octant.low : octant.high)[axis] = middle;
    }
    addBricks(tree, octant, column, finest, bricks);
  }
}

/// Argument: threads. The tree of the cells, and the bricks that a view of the middle needs. Seconds by the
/// clock and of all processors.
void bricks(benchmark::State& state, const std::function<Mesh()>& make, double column,
  double finest, Reconstruction reconstruction)
{
  const Mesh mesh = make();
  vtkNew<vtkDoubleArray> values;
  for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
  {
    double x[3];
    mesh->GetPoint(i, x);
    values->InsertNextValue(3e-4 * std::exp(-(x[0] * x[0] + x[1] * x[1])) + 1e-6 * x[2]);
  }
  mesh->GetPointData()->Initialize();
  mesh->GetPointData()->SetScalars(values);
  std::unique_ptr<filters::CellTree> tree;
  std::vector<schlieren::Lattice> all;
  std::vector<std::size_t> found;
  const auto build = [&]
  { tree = std::make_unique<filters::CellTree>(std::vector<vtkDataSet*>{ mesh }, reconstruction); };
  const auto query = [&]
  {
    all.clear();
    addBricks(*tree, { tree->bounds().low, tree->bounds().high }, column, finest, all);
  };
  const auto sampleSome = [&](vtkIdType begin, vtkIdType end)
  {
    const filters::CellSampler sampler(*tree);
    std::vector<double> numbers;
    std::vector<unsigned char> isFound;
    for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i)
    {
      numbers.resize(static_cast<std::size_t>(all[i].size()));
      isFound.resize(numbers.size());
      sampler.sample(all[i], numbers.data(), isFound.data());
      found[i] = static_cast<std::size_t>(std::count(isFound.begin(), isFound.end(), 1));
    }
  };
  const auto sample = [&]
  {
    found.assign(all.size(), 0);
    vtkSMPTools::For(0, static_cast<vtkIdType>(all.size()), 16, sampleSome);
  };
  double built = 1e30, buildProcessors = 1e30, queried = 1e30, sampled = 1e30, processors = 1e30;
  const vtkSMPTools::Config threads(static_cast<int>(state.range(0)), "STDThread", false);
  for (auto _ : state)
  {
    vtkSMPTools::LocalScope(threads,
      [&]
      {
        built = std::min(built, secondsOf(build));
        buildProcessors = std::min(buildProcessors, processorSecondsOf(build));
        queried = std::min(queried, secondsOf(query));
        sampled = std::min(sampled, secondsOf(sample));
        processors = std::min(processors, processorSecondsOf(sample));
      });
  }
  const double points = static_cast<double>(all.size()) * 8000;
  state.counters["build/s"] = built;
  state.counters["build/s*cores"] = buildProcessors;
  state.counters["bytes/cell"] =
    static_cast<double>(tree->bytes()) / static_cast<double>(tree->size());
  state.counters["query/s"] = queried;
  state.counters["bricks"] = static_cast<double>(all.size());
  state.counters["found"] =
    static_cast<double>(std::accumulate(found.begin(), found.end(), std::size_t{ 0 })) / points;
  state.counters["sample/s"] = sampled;
  state.counters["points/s/core"] = points / processors;
}

constexpr double everywhere = 1e9;
Mesh sphere() { return aroundSphere(120, 80, 125); }
Mesh finerSphere() { return aroundSphere(240, 160, 250); }
Mesh tetrahedra60() { return tetrahedra(60); }
Mesh bentHexahedra() { return hexahedra(64, true); }
Mesh parallelepipeds() { return hexahedra(64, false); }

#define BRICKS(name, ...)                      \
  BENCHMARK_CAPTURE(bricks, name, __VA_ARGS__) \
    ->ArgName("threads")                       \
    ->Arg(1)                                   \
    ->Arg(2)                                   \
    ->Iterations(2)                            \
    ->Unit(benchmark::kMillisecond)
BRICKS(sphere_1200000, sphere, 1.2, 0.0125, Reconstruction::Linear);
BRICKS(sphere_1200000_smooth, sphere, 1.2, 0.0125, Reconstruction::Smooth);
BRICKS(sphere_9600000, finerSphere, 1.2, 0.0125, Reconstruction::Linear);
BRICKS(tetrahedra_1080000, tetrahedra60, everywhere, 1. / 256, Reconstruction::Linear);
BRICKS(tetrahedra_1080000_smooth, tetrahedra60, everywhere, 1. / 256, Reconstruction::Smooth);
BRICKS(tetrahedra_1080000_coarse, tetrahedra60, everywhere, 1. / 64, Reconstruction::Linear);
BRICKS(hexahedra_262144, bentHexahedra, everywhere, 1. / 128, Reconstruction::Linear);
BRICKS(hexahedra_262144_smooth, bentHexahedra, everywhere, 1. / 128, Reconstruction::Smooth);
BRICKS(parallelepipeds_262144, parallelepipeds, everywhere, 1. / 128, Reconstruction::Linear);

BENCHMARK(amr)->ArgName("n")->Arg(22)->Arg(44)->Iterations(2)->Unit(benchmark::kMillisecond);

} // namespace
