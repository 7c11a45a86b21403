// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Time steps on the same mesh use again what depends on the mesh alone. The truth is what a filter makes that has seen
// no step before: the last bit of every number.
#include "CellMeshes.h"
#include "CutMesh.h"
#include "Sources/MediumMaker.h"
#include "Surfaces.h"
#include "WatchedProgress.h"

#include "Input/InputDescription.h"
#include "Schlieren.h"

#include "vtkCellArray.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPolyData.h"
#include "vtkRectilinearGrid.h"
#include "vtkStructuredGrid.h"
#include "vtkWeakPointer.h"

#include <random>

namespace
{

using Source = std::shared_ptr<const schlieren::MediumSource>;

double field(const Vec& x, double time)
{
  return 1e-4 * (1 + time * std::sin(3 * x[0] + time) * std::cos(2 * x[1]) * x[2]);
}

void setTime(vtkDataSet* mesh, double time)
{
  mesh->GetPointData()->Initialize();
  addPointArray(mesh, "N", [time](const Vec& x) { return field(x, time); });
}

vtkSmartPointer<vtkStructuredGrid> curvilinear()
{
  auto grid = vtkSmartPointer<vtkStructuredGrid>::New();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  const auto image = cube(7, 0.5);
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    Vec x;
    image->GetPoint(i, x.data());
    x = moved({ x[0] + 0.5, x[1] + 0.5, x[2] + 0.5 }, 0.2);
    points->InsertNextPoint(x.data());
  }
  grid->SetDimensions(7, 7, 7);
  grid->SetPoints(points);
  return grid;
}

vtkSmartPointer<vtkUnsignedCharArray> ghostsOf(vtkDataSet* mesh, bool ofCells)
{
  auto ghosts = vtkSmartPointer<vtkUnsignedCharArray>::New();
  ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
  ghosts->SetNumberOfValues(ofCells ? mesh->GetNumberOfCells() : mesh->GetNumberOfPoints());
  ghosts->FillValue(0);
  mesh->GetAttributes(ofCells ? vtkDataObject::CELL : vtkDataObject::POINT)->AddArray(ghosts);
  return ghosts;
}

/// Each has another kind of cells or another reason for places without gas. New objects with each call.
std::vector<std::pair<std::string, std::function<vtkSmartPointer<vtkDataObject>(double)>>> kinds()
{
  std::vector<std::pair<std::string, std::function<vtkSmartPointer<vtkDataObject>(double)>>> all;
  for (const CellKind& kind : linearKinds())
  {
    all.emplace_back(kind.name,
      [kind](double time)
      {
        const Mesh mesh = meshOf(kind.type, 4, kind.cells, 0.2, false);
        setTime(mesh, time);
        return mesh;
      });
  }
  all.emplace_back("Curved",
    [](double time)
    {
      const Mesh mesh =
        meshOf(VTK_QUADRATIC_HEXAHEDRON, 3, { unitCell(VTK_QUADRATIC_HEXAHEDRON, 20) }, 0.1, false);
      setTime(mesh, time);
      return mesh;
    });
  all.emplace_back("Structured",
    [](double time)
    {
      const auto grid = curvilinear();
      setTime(grid, time);
      ghostsOf(grid, true)->SetValue(100, vtkDataSetAttributes::HIDDENCELL);
      ghostsOf(grid, false)->SetValue(20, vtkDataSetAttributes::HIDDENPOINT);
      return grid;
    });
  all.emplace_back("Blocks",
    [](double time)
    {
      auto blocks = vtkSmartPointer<vtkMultiBlockDataSet>::New();
      const auto kind = linearKinds()[0];
      for (unsigned i = 0; i < 2; ++i)
      {
        const Mesh mesh = meshOf(kind.type, 3, kind.cells, 0, false);
        for (vtkIdType point = 0; i > 0 && point < mesh->GetNumberOfPoints(); ++point)
        {
          Vec x;
          mesh->GetPoint(point, x.data());
          mesh->GetPoints()->SetPoint(point, x[0] + 1, x[1], x[2]);
        }
        setTime(mesh, time);
        blocks->SetBlock(i, mesh);
      }
      return blocks;
    });
  return all;
}

vtkSmartPointer<vtkRefractiveIndex> reader()
{
  auto filter = vtkSmartPointer<vtkRefractiveIndex>::New();
  filter->SetIndexModel(vtkRefractiveIndex::REFRACTIVITY);
  filter->SetInputArrayToProcess(
    vtkRefractiveIndex::INDEX_ARRAY, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "N");
  return filter;
}

Source sourceOf(vtkRefractiveIndex* filter, vtkDataObject* input, vtkDataObject* bodies = nullptr)
{
  filters::MediumMaker& maker = filter->GetMaker();
  maker.numberOfThreads = 2;
  return maker.make(maker.choose(input), bodies)->Source;
}

void expectSame(const schlieren::MediumSource& one, const schlieren::MediumSource& other)
{
  EXPECT_EQ(one.bounds().low, other.bounds().low);
  EXPECT_EQ(one.bounds().high, other.bounds().high);
  EXPECT_EQ(one.ambient(), other.ambient());
  EXPECT_EQ(one.voxelShape(), other.voxelShape());
  std::mt19937 random(1);
  std::uniform_real_distribution<double> place(-0.1, 1.5);
  for (int i = 0; i < 20; ++i)
  {
    const std::array<double, 3> low = { place(random), place(random), place(random) };
    const double size = 0.05 * (1 + i);
    const schlieren::Box box{ low, { low[0] + size, low[1] + size, low[2] + size } };
    const auto a = one.contentOf(box), b = other.contentOf(box);
    EXPECT_EQ(a.lowest, b.lowest);
    EXPECT_EQ(a.highest, b.highest);
    EXPECT_EQ(a.cellSize, b.cellSize);
    EXPECT_EQ(a.hasGas, b.hasGas);
    EXPECT_EQ(a.hasWall, b.hasWall);
    EXPECT_EQ(a.hasWindow, b.hasWindow);
    const schlieren::Lattice lattice{ low, { size / 8, size / 8, size / 8 }, { 9, 9, 9 } };
    const auto points = static_cast<std::size_t>(lattice.size());
    std::array<std::vector<double>, 2> values;
    std::array<std::vector<schlieren::Place>, 2> places;
    std::array<std::vector<float>, 2> distances;
    for (std::size_t n = 0; n < 2; ++n)
    {
      values[n].resize(points);
      places[n].resize(points);
      distances[n].resize(points);
      (n == 0 ? one : other)
        .sample(lattice, values[n].data(), places[n].data(), distances[n].data());
    }
    EXPECT_EQ(values[0], values[1]);
    EXPECT_EQ(places[0], places[1]);
    EXPECT_EQ(distances[0], distances[1]);
  }
}

} // namespace

TEST(MeshSteps, NewValuesOnTheMeshAreThoseOfANewMesh)
{
  for (const auto& [name, make] : kinds())
  {
    SCOPED_TRACE(name);
    auto filter = reader();
    for (double time = 1; time < 4; ++time)
    {
      const Source again = sourceOf(filter, make(time));
      expectSame(*again, *sourceOf(reader(), make(time)));
    }
    EXPECT_EQ(filter->GetMeshBuilds(), 1);
  }
}

// What a mesh is made of is looked at: nobody says Modified() here.
TEST(MeshSteps, WhatChangesTheMeshIsSeen)
{
  const CellKind kind = linearKinds()[0];
  const Mesh mesh = meshOf(kind.type, 4, kind.cells, 0.2, false);
  setTime(mesh, 1);
  const auto bodies = box({ 0.2, 0.2, 0.2 }, { 0.5, 0.5, 0.5 });
  auto filter = reader();
  const auto copy = [](vtkRefractiveIndex* from)
  {
    auto fresh = reader();
    fresh->SetOutside(from->GetOutside());
    return fresh;
  };
  sourceOf(filter, mesh, bodies);
  const auto expectSeen = [&](const std::string& what, vtkDataObject* body)
  {
    SCOPED_TRACE(what);
    const vtkTypeInt64 before = filter->GetMeshBuilds();
    const Source source = sourceOf(filter, mesh, body);
    EXPECT_EQ(filter->GetMeshBuilds(), before + 1);
    expectSame(*source, *sourceOf(copy(filter), mesh, body));
    setTime(mesh, static_cast<double>(before + 2)); // no change of the mesh
    sourceOf(filter, mesh, body);
    EXPECT_EQ(filter->GetMeshBuilds(), before + 1);
  };

  Vec x;
  mesh->GetPoint(31, x.data());
  mesh->GetPoints()->SetPoint(31, x[0] + 1e-9, x[1], x[2]);
  expectSeen("point", bodies);

  vtkNew<vtkIdList> corners;
  mesh->GetCellPoints(77, corners);
  const vtkIdType turned[4] = { corners->GetId(0), corners->GetId(2), corners->GetId(1),
    corners->GetId(3) };
  mesh->GetCells()->ReplaceCellAtId(77, 4, turned);
  expectSeen("cell", bodies);

  const auto ghosts = ghostsOf(mesh, true);
  ghosts->SetValue(50, vtkDataSetAttributes::HIDDENCELL);
  expectSeen("hidden cell", bodies);
  ghosts->SetValue(
    50, vtkDataSetAttributes::DUPLICATECELL); // no matter, but the cell is there again
  expectSeen("shown cell", bodies);

  bodies->GetPoints()->SetPoint(0, 0.41, 0.4, 0.4);
  expectSeen("body", bodies);
  expectSeen("no body", nullptr);

  filter->SetOutside(vtkRefractiveIndex::OUTSIDE_PASSES);
  expectSeen("outside", nullptr);
}

// However its numbers are stored.
TEST(MeshSteps, MeshesOfAllKindsAreLookedAt)
{
  const auto expectSeen = [](vtkDataSet* mesh, const std::function<void()>& change)
  {
    auto filter = reader();
    setTime(mesh, 1);
    sourceOf(filter, mesh);
    setTime(mesh, 2);
    sourceOf(filter, mesh);
    EXPECT_EQ(filter->GetMeshBuilds(), 1);
    change();
    const Source source = sourceOf(filter, mesh);
    EXPECT_EQ(filter->GetMeshBuilds(), 2);
    expectSame(*source, *sourceOf(reader(), mesh));
  };
  const CellKind kind = linearKinds()[1];
  const Mesh mesh = meshOf(kind.type, 4, kind.cells, 0.2, false);
  vtkNew<vtkPoints> singles; // of single precision
  singles->DeepCopy(mesh->GetPoints());
  mesh->SetPoints(singles);
  mesh->GetCells()->ConvertTo32BitStorage();
  expectSeen(mesh, [&] { singles->SetPoint(40, 0.5, 0.51, 0.52); });
  expectSeen(mesh,
    [&]
    {
      vtkNew<vtkIdList> corners;
      mesh->GetCellPoints(30, corners);
      mesh->GetCells()->ReplaceCellAtId(31, corners);
    });

  const auto grid = curvilinear();
  expectSeen(grid, [&] { grid->GetPoints()->SetPoint(100, 0.4, 0.3, 0.4); });
  vtkNew<vtkRectilinearGrid> rectilinear;
  std::array<vtkNew<vtkDoubleArray>, 3> x;
  for (auto& along : x)
  {
    for (const double at : { 0., 0.1, 0.3, 0.6, 1. })
    {
      along->InsertNextValue(at);
    }
  }
  rectilinear->SetDimensions(5, 5, 5);
  rectilinear->SetXCoordinates(x[0]);
  rectilinear->SetYCoordinates(x[1]);
  rectilinear->SetZCoordinates(x[2]);
  expectSeen(rectilinear, [&] { x[1]->SetValue(2, 0.35); });
}

// Of points that are hidden, and of values that are no numbers.
TEST(MeshSteps, WhereValuesEndIsPartOfTheMesh)
{
  const CellKind kind = linearKinds()[0];
  const Mesh mesh = meshOf(kind.type, 4, kind.cells, 0.2, false);
  auto filter = reader();
  int builds = 0;
  for (int step = 0; step < 4; ++step)
  {
    setTime(mesh, step + 1);
    if (step % 2 == 1)
    {
      mesh->GetPointData()->GetArray("N")->SetComponent(60 + step, 0, std::nan(""));
    }
    if (step == 2)
    {
      ghostsOf(mesh, false)->SetValue(70, vtkDataSetAttributes::HIDDENPOINT);
    }
    const Source source = sourceOf(filter, mesh);
    EXPECT_EQ(filter->GetMeshBuilds(), ++builds) << step;
    expectSame(*source, *sourceOf(reader(), mesh));
  }
}

// Walls without thickness are known by values.
TEST(MeshSteps, WallsAppearAndGo)
{
  auto filter = reader();
  int step = 0;
  for (const auto& [jump, builds] :
    { std::pair{ 0., 1 }, { 0., 1 }, { 0.2, 2 }, { 0.3, 2 }, { 0., 3 } })
  {
    const auto mesh = cutMesh(12);
    setJump(mesh, [height = jump](const Vec& x) { return std::abs(x[0]) < 0.45 ? height : 0; });
    const Source source = sourceOf(filter, mesh);
    EXPECT_EQ(filter->GetMeshBuilds(), builds) << step;
    EXPECT_EQ(source->contentOf({ { -0.2, -0.2, -0.2 }, { 0.2, 0.2, 0.2 } }).hasWall, jump > 0)
      << step;
    expectSame(*source, *sourceOf(reader(), mesh));
    ++step;
  }
}

// Memory does not grow, and who writes over an earlier step does no harm.
TEST(MeshSteps, NothingOfAnEarlierStepIsKept)
{
  for (const auto& [name, make] : kinds())
  {
    SCOPED_TRACE(name);
    auto filter = reader();
    std::vector<vtkWeakPointer<vtkPoints>> earlier;
    sourceOf(filter,
      [&]
      {
        const auto first = make(1);
        for (vtkDataObject* leaf : filters::leavesOf(first))
        {
          earlier.emplace_back(vtkPointSet::SafeDownCast(leaf)->GetPoints());
        }
        return first;
      }());
    for (vtkPoints* points : earlier)
    {
      EXPECT_EQ(points, nullptr);
    }
    const Source again = sourceOf(filter, make(2));
    EXPECT_EQ(filter->GetMeshBuilds(), 1);
    expectSame(*again, *sourceOf(reader(), make(2)));
  }
}

// Of the first step, whose mesh is new, and of the next one.
TEST(MeshSteps, StopsAndStartsAnew)
{
  const auto kind = linearKinds()[0];
  const auto atTime = [&kind](double time)
  {
    const Mesh mesh = meshOf(kind.type, 8, kind.cells, 0.2, false);
    setTime(mesh, time);
    return mesh;
  };
  auto filter = bench(nullptr, 32);
  WatchedProgress watch(filter);
  constexpr double ofSource = 0.2, ofVoxels = 0.44; // of the progress
  for (double time = 1; time < 3; ++time)
  {
    for (const double stopAt : { 0.03, 0.06, 0.09, 0.12, 0.15, 0.18, 0.3 })
    {
      SCOPED_TRACE(stopAt);
      filter->SetInputDataObject(atTime(time));
      watch.stopAt = stopAt;
      watch.seen.clear();
      filter->Update();
      EXPECT_TRUE(isEmpty(filter));
      const auto past = std::count_if(watch.seen.begin(), watch.seen.end(),
        [&](double done) { return done >= stopAt && done < 1; }); // 1: of the pipeline
      EXPECT_EQ(past, 1);
    }
    watch.stopAt = 2;
    watch.seen.clear();
    filter->Modified();
    filter->Update();
    EXPECT_TRUE(std::is_sorted(watch.seen.begin(), watch.seen.end()));
    EXPECT_TRUE(std::any_of(watch.seen.begin(), watch.seen.end(),
      [&](double done) { return done > ofSource && done < ofVoxels; }));
    auto fresh = bench(atTime(time), 32);
    fresh->Update();
    ASSERT_FALSE(isEmpty(filter));
    EXPECT_EQ(valuesOf(filter, "Intensity"), valuesOf(fresh, "Intensity"));
  }
}
