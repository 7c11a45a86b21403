// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// Meshes whose pieces are on several ranks, against the same meshes in one piece. The ranks are filters of one process.
#include "MeshHalo.h"
#include "MeshPiece.h"
#include "Pieces.h"

#include "Medium/MediumSource.h"
#include "Rays/Channel.h"

#include "vtkAppendFilter.h"
#include "vtkCellData.h"
#include "vtkCellType.h"
#include "vtkDataSetAttributes.h"
#include "vtkDataSetTriangleFilter.h"
#include "vtkExtractCells.h"
#include "vtkIdList.h"
#include "vtkImageData.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPiecewiseFunction.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkRectilinearGrid.h"
#include "vtkRefractiveIndex.h"
#include "vtkSphereSource.h"
#include "vtkStructuredGrid.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <deque>
#include <functional>
#include <limits>
#include <memory>
#include <random>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace
{

using schlieren::Box;
using schlieren::Lattice;

constexpr int edge = 20; // cells

/// A part of a curvilinear grid in [-1, 1]^3.
vtkSmartPointer<vtkStructuredGrid> gridOf(const std::array<int, 6>& extent)
{
  auto grid = vtkSmartPointer<vtkStructuredGrid>::New();
  grid->SetExtent(extent[0], extent[1], extent[2], extent[3], extent[4], extent[5]);
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (int k = extent[4]; k <= extent[5]; ++k)
  {
    for (int j = extent[2]; j <= extent[3]; ++j)
    {
      for (int i = extent[0]; i <= extent[1]; ++i)
      {
        const double x = 2. * i / edge - 1, y = 2. * j / edge - 1, z = 2. * k / edge - 1;
        const double bump = 0.1 * (1 - x * x) * (1 - y * y) * (1 - z * z);
        points->InsertNextPoint(
          x + bump * std::sin(5 * y), y + bump * std::sin(4 * z), z + bump * x);
      }
    }
  }
  grid->SetPoints(points);
  addPointArray(grid, "N", ball);
  addCellArray(grid, "N of cells", ball);
  return grid;
}

vtkSmartPointer<vtkUnstructuredGrid> wholeMesh()
{
  vtkNew<vtkAppendFilter> append;
  append->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  append->AddInputData(gridOf({ 0, edge, 0, edge, 0, edge }));
  append->Update();
  return append->GetOutput();
}

/// The cells for which `rankOf` says so.
vtkSmartPointer<vtkUnstructuredGrid> partOf(
  vtkUnstructuredGrid* mesh, int rank, const std::function<int(const Vec&)>& rankOf)
{
  vtkNew<vtkIdList> ids;
  for (vtkIdType cell = 0; cell < mesh->GetNumberOfCells(); ++cell)
  {
    double bounds[6];
    mesh->GetCellBounds(cell, bounds);
    const Vec middle{ (bounds[0] + bounds[1]) / 2, (bounds[2] + bounds[3]) / 2,
      (bounds[4] + bounds[5]) / 2 };
    if (rankOf(middle) == rank)
    {
      ids->InsertNextId(cell);
    }
  }
  vtkNew<vtkExtractCells> extract;
  extract->SetInputData(mesh);
  extract->SetCellList(ids);
  extract->Update();
  vtkUnstructuredGrid* part = extract->GetOutput();
  part->GetCellData()->RemoveArray("vtkOriginalCellIds");
  part->GetPointData()->RemoveArray("vtkOriginalPointIds");
  return part;
}

/// Planes through the ball's middle, straight and oblique.
std::vector<std::vector<Data>> cuts()
{
  const vtkSmartPointer<vtkUnstructuredGrid> mesh = wholeMesh();
  std::vector<std::vector<Data>> all;
  const auto add = [&](int ranks, const std::function<int(const Vec&)>& rankOf)
  {
    std::vector<Data> parts;
    for (int rank = 0; rank < ranks; ++rank)
    {
      parts.push_back(partOf(mesh, rank, rankOf));
    }
    all.push_back(parts);
  };
  add(2, [](const Vec& x) { return x[0] < 0 ? 0 : 1; });
  add(2, [](const Vec& x) { return x[0] + 0.7 * x[1] - 0.4 * x[2] < 0 ? 1 : 0; });
  add(4, [](const Vec& x) { return (x[0] + 0.3 * x[2] < 0 ? 0 : 1) + (x[1] < 0.02 ? 0 : 2); });
  add(6, [](const Vec& x) { return std::min(5, static_cast<int>(3 * (x[0] + x[1] + 2) / 2)); });
  return all;
}

TEST(Pieces, AreSampledAsOneMesh)
{
  for (const bool ofCells : { false, true })
  {
    const auto whole = inOnePiece(wholeMesh(), ofCells);
    for (const std::vector<Data>& parts : cuts())
    {
      SCOPED_TRACE(std::to_string(parts.size()) + (ofCells ? ", cells" : ", points"));
      Ranks ranks(parts, ofCells);
      // Pieces of a few layers of cells do not reach all that values of cells depend on.
      const auto pieces = ranks.make();
      expectSame(*whole, *pieces, ofCells ? 2e-6 : 2e-7);
      if (!ofCells)
      {
        expectSameContents(*whole, *pieces);
      }
    }
  }
}

// Of all ranks, but where they are given; curves that are not straight lines show it.
TEST(Pieces, TransferFunctionsHaveTheRangesOfAllFields)
{
  vtkNew<vtkPiecewiseFunction> curve;
  curve->AddPoint(0, 0);
  curve->AddPoint(0.5, 0.1);
  curve->AddPoint(1, 1);
  const auto withTwoFields = [](vtkDataSet* data)
  { addPointArray(data, "T", [](const Vec& x) { return 300 + 20 * x[0] + 5 * x[2]; }); };
  for (const bool hasRanges : { false, true })
  {
    const auto setUp = [&](vtkRefractiveIndex* filter)
    {
      filter->SetIndexModel(vtkRefractiveIndex::TRANSFER_FUNCTIONS);
      filter->AddField("N");
      filter->AddField("T");
      filter->AddTransferFunction(curve);
      filter->AddTransferFunction(curve);
      filter->SetRefractivityScale(1e-4);
      for (const double limit : { 1.2e-4, 1.7e-4, 290., 315. })
      {
        if (hasRanges)
        {
          filter->AddFieldRange(limit);
        }
      }
    };
    const auto mesh = wholeMesh();
    withTwoFields(mesh);
    const auto one = reader(false);
    setUp(one);
    std::string warning;
    const auto whole = one->MakeSource(mesh, nullptr, warning);
    for (const std::vector<Data>& parts : cuts())
    {
      Ranks ranks(parts);
      for (std::size_t rank = 0; rank < parts.size(); ++rank)
      {
        withTwoFields(vtkDataSet::SafeDownCast(parts[rank]));
        setUp(ranks.Filters[rank]);
      }
      expectSame(*whole, *ranks.make(), 1e-6);
    }
  }
}

// Filters of the same ranks use one source in turns, also after the one that has made it has made another.
TEST(Pieces, AreSharedByFilters)
{
  const std::vector<Data> parts = cuts()[2];
  Ranks fresh(parts), other(parts);
  const auto expected = fresh.make();
  auto ranks = std::make_unique<Ranks>(parts);
  auto source = ranks->make();
  EXPECT_TRUE(ranks->Filters[0]->UsesSource(source.get()));
  for (int turn = 0; turn < 2; ++turn)
  {
    for (const vtkSmartPointer<vtkRefractiveIndex>& filter :
      { other.Filters[0], ranks->Filters[0] })
    {
      ASSERT_TRUE(filter->UseSource(source.get()));
      EXPECT_TRUE(filter->UsesSource(source.get()));
      expectSame(*expected, *source, 1e-15);
    }
    EXPECT_FALSE(other.Filters[0]->UsesSource(source.get()));
  }
  ASSERT_TRUE(other.Filters[0]->UseSource(source.get()));
  for (std::size_t rank = 1; rank < parts.size(); ++rank)
  {
    ranks->Filters[rank]->SetPieceData(parts[rank]);
  }
  const auto another = ranks->make();
  expectSame(*expected, *source, 1e-15);
  ASSERT_TRUE(ranks->Filters[0]->UseSource(source.get()));
  EXPECT_FALSE(ranks->Filters[0]->UseSource(another.get())); // nobody has it any more
  ASSERT_TRUE(other.Filters[0]->UseSource(source.get()));
  ranks.reset();
  expectSame(*expected, *source, 1e-15);
  other.Filters[0]->ReleasePieces();
  EXPECT_FALSE(other.Filters[0]->UseSource(source.get()));
}

// What depends on the mesh alone stays on all ranks from step to step, and goes where the mesh, the gas or a body is another.
TEST(Pieces, KeepTheirMeshForTheNextStep)
{
  const auto mesh = wholeMesh();
  vtkNew<vtkSphereSource> sphere;
  sphere->SetRadius(0.3);
  sphere->Update();
  vtkDataObject* bodies = nullptr;
  std::vector<Data> parts = cuts()[2];
  Ranks ranks(parts);
  const auto forAll = [&](const auto& change)
  {
    change(vtkDataSet::SafeDownCast(mesh));
    for (const Data& part : parts)
    {
      change(vtkDataSet::SafeDownCast(part));
    }
  };
  const auto expectSameAsOne = [&](const char* words)
  {
    SCOPED_TRACE(words);
    std::size_t before = 0, after = 0;
    for (const auto& channel : ranks.Channels)
    {
      before += channel->Bytes;
    }
    const auto source = ranks.make(bodies);
    for (const auto& channel : ranks.Channels)
    {
      after += channel->Bytes;
    }
    expectSame(*inOnePiece(mesh, false, bodies), *source, 5e-7);
    Ranks fresh(parts);
    expectSame(*fresh.make(bodies), *source, 1e-15);
    return after - before;
  };
  const auto setTo = [&](double time)
  {
    forAll(
      [time](vtkDataSet* data)
      {
        addPointArray(data, "N",
          [time](const Vec& x) {
            return ball({ x[0] - 0.2 * time, x[1], x[2] }) * (1 + time);
          });
      });
  };
  const std::size_t all = expectSameAsOne("first");
  for (const double time : { 1., 2., 3. })
  {
    setTo(time);
    const std::size_t ofValues = expectSameAsOne("next");
    EXPECT_LT(ofValues, all - all / 8); // copies of cells are sent again, faces are not
  }
  bodies = sphere->GetOutput();
  EXPECT_GT(expectSameAsOne("with a body"), all);
  setTo(1);
  EXPECT_LT(expectSameAsOne("next with a body"), all);
  bodies = nullptr;
  EXPECT_GE(expectSameAsOne("without"), all);
  forAll(
    [](vtkDataSet* data)
    {
      vtkPoints* points = vtkPointSet::SafeDownCast(data)->GetPoints();
      for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i)
      {
        double x[3];
        points->GetPoint(i, x);
        points->SetPoint(i, x[0] * (1 + 0.05 * x[1]), x[1], x[2] + 0.02 * x[0] * x[0]);
      }
      points->Modified();
    });
  EXPECT_GE(expectSameAsOne("on another mesh"), all - 64);
  setTo(2);
  forAll(
    [](vtkDataSet* data)
    {
      addPointArray(
        data, "N", [](const Vec& x) { return x[0] > 0.6 && x[1] > 0.5 ? std::nan("") : ball(x); });
    });
  expectSameAsOne("with another gas");
}

// A piece whose boundary nobody has wanted may be of the mesh that rank 0 knows, when another rank has failed meanwhile.
TEST(Pieces, GiveTheValuesOnTheirBoundaryAlone)
{
  const auto mesh = wholeMesh();
  mesh->GetPointData()->SetActiveScalars("N");
  const auto pieceOf = [&](const std::shared_ptr<filters::PieceMesh>& kept)
  { return filters::MeshPiece({ mesh }, filters::CellTree::Reconstruction::Smooth, kept); };
  const filters::MeshPiece piece = pieceOf(nullptr);
  std::vector<char> all, values, ofNext;
  piece.putBoundary(1, all);
  pieceOf(nullptr).putBoundaryValues(values);
  ASSERT_GT(values.size(), 1000u);
  ASSERT_LT(values.size(), all.size());
  EXPECT_TRUE(std::equal(values.rbegin(), values.rend(), all.rbegin()));
  const filters::MeshPiece next = pieceOf(piece.mesh());
  EXPECT_EQ(next.mesh(), piece.mesh());
  next.putBoundaryValues(ofNext);
  EXPECT_EQ(ofNext, values);
}

TEST(Pieces, AreOfMeshesAndImagesWithVolume)
{
  using namespace filters;
  constexpr std::int32_t any = PiecesOfMeshes | PieceOfImage | PiecesOfBlocks;
  EXPECT_EQ(pieceKindsOf(nullptr), any);
  EXPECT_EQ(pieceKindsOf(vtkSmartPointer<vtkUnstructuredGrid>::New()), any);
  EXPECT_EQ(pieceKindsOf(wholeMesh()), PiecesOfMeshes);
  EXPECT_EQ(pieceKindsOf(gridOf({ 0, 2, 0, 2, 0, 2 })), PiecesOfMeshes);
  EXPECT_EQ(
    pieceKindsOf(gridOf({ 0, 2, 0, 2, 1, 1 })), NoPieces); // flat: it is extruded as a whole
  EXPECT_EQ(pieceKindsOf(cube(3)), PieceOfImage);
  vtkNew<vtkImageData> flat;
  flat->SetDimensions(3, 3, 1);
  EXPECT_EQ(pieceKindsOf(flat), NoPieces);
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, cube(3));
  EXPECT_EQ(pieceKindsOf(blocks), PiecesOfMeshes | PiecesOfBlocks);
  blocks->SetBlock(1, wholeMesh());
  EXPECT_EQ(pieceKindsOf(blocks), PiecesOfMeshes);
  blocks->SetBlock(0, flat);
  blocks->SetBlock(1, nullptr);
  EXPECT_EQ(pieceKindsOf(blocks), NoPieces);
}

TEST(Pieces, MayBePolyhedra)
{
  const vtkSmartPointer<vtkUnstructuredGrid> boxes = wholeMesh();
  vtkNew<vtkUnstructuredGrid> mesh;
  mesh->SetPoints(boxes->GetPoints());
  mesh->GetPointData()->ShallowCopy(boxes->GetPointData());
  constexpr int faces[6][4] = { { 0, 4, 7, 3 }, { 1, 2, 6, 5 }, { 0, 1, 5, 4 }, { 3, 7, 6, 2 },
    { 0, 3, 2, 1 }, { 4, 5, 6, 7 } };
  vtkNew<vtkIdList> ids, stream;
  for (vtkIdType cell = 0; cell < boxes->GetNumberOfCells(); ++cell)
  {
    boxes->GetCellPoints(cell, ids);
    stream->Reset();
    stream->InsertNextId(6);
    for (const auto& face : faces)
    {
      stream->InsertNextId(4);
      for (const int corner : face)
      {
        stream->InsertNextId(ids->GetId(corner));
      }
    }
    mesh->InsertNextCell(VTK_POLYHEDRON, stream);
  }
  const auto rankOf = [](const Vec& x) { return x[0] + 0.7 * x[1] - 0.4 * x[2] < 0 ? 1 : 0; };
  const auto whole = inOnePiece(mesh);
  Ranks ranks({ partOf(mesh, 0, rankOf), partOf(mesh, 1, rankOf) });
  // Along which diagonals their faces are divided depends on the numbers of points.
  expectSame(*whole, *ranks.make(), 2e-4);
}

TEST(Pieces, PartsOfAGridAreOneGrid)
{
  const auto whole = inOnePiece(gridOf({ 0, edge, 0, edge, 0, edge }));
  Ranks ranks({ gridOf({ 0, edge, 0, 7, 0, edge }), gridOf({ 0, 11, 7, edge, 0, edge }),
    gridOf({ 11, edge, 7, edge, 0, edge }) });
  expectSame(*whole, *ranks.make());
}

TEST(Pieces, PartsOfARectilinearGridAreOneGrid)
{
  const auto partOf = [](const std::array<int, 6>& extent)
  {
    auto grid = vtkSmartPointer<vtkRectilinearGrid>::New();
    grid->SetExtent(extent[0], extent[1], extent[2], extent[3], extent[4], extent[5]);
    std::array<vtkNew<vtkDoubleArray>, 3> coordinates;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      for (int i = extent[2 * axis]; i <= extent[2 * axis + 1]; ++i)
      {
        const double x = 2. * i / edge - 1;
        coordinates[axis]->InsertNextValue(x - 0.1 * std::sin(3 * x));
      }
    }
    grid->SetXCoordinates(coordinates[0]);
    grid->SetYCoordinates(coordinates[1]);
    grid->SetZCoordinates(coordinates[2]);
    addPointArray(grid, "N", ball);
    return grid;
  };
  const auto whole = inOnePiece(partOf({ 0, edge, 0, edge, 0, edge }));
  Ranks ranks({ partOf({ 0, edge, 0, 7, 0, edge }), partOf({ 0, 11, 7, edge, 0, edge }),
    partOf({ 11, edge, 7, edge, 0, edge }) });
  expectSame(*whole, *ranks.make());
}

/// A part of a grid around the plate -1 < x < 1 in y = 0, along its sides and away from it. Values are those of the two sides
/// of the plate, which differ by `jump`, and no others at the seam behind it.
vtkSmartPointer<vtkStructuredGrid> aroundAPlate(int first, int last, double jump)
{
  constexpr int around = 24, away = 8, layers = 6;
  constexpr double pi = 3.14159265358979323846;
  auto grid = vtkSmartPointer<vtkStructuredGrid>::New();
  grid->SetExtent(first, last, 0, away, 0, layers);
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkDoubleArray> values;
  values->SetName("N");
  for (int k = 0; k <= layers; ++k)
  {
    for (int j = 0; j <= away; ++j)
    {
      for (int i = first; i <= last; ++i)
      {
        const double u = 0.15 * j, v = 2 * pi * (i % around) / around;
        const double x[3] = { std::cosh(u) * std::cos(v), std::sinh(u) * std::sin(v),
          2. * k / layers - 1 };
        points->InsertNextPoint(x);
        values->InsertNextValue(
          ball({ x[0], x[1], x[2] }) + 1e-4 * jump * std::sin(v) * std::exp(-u));
      }
    }
  }
  grid->SetPoints(points);
  grid->GetPointData()->AddArray(values);
  return grid;
}

// Most faces on one side of the plate are another rank's than those on the other side.
TEST(Pieces, HaveSheets)
{
  const std::vector<std::array<int, 2>> ends{ { 0, 7 }, { 7, 14 }, { 14, 24 } };
  std::vector<Data> parts;
  for (const auto& [first, last] : ends)
  {
    parts.push_back(aroundAPlate(first, last, 0.3));
  }
  Ranks ranks(parts);
  const Box middle{ { -0.2, -0.01, -0.2 }, { 0.2, 0.01, 0.2 } };
  for (const double jump : { 0.3, 0., 0.2 }) // on the same mesh
  {
    for (std::size_t rank = 0; rank < ends.size(); ++rank)
    {
      parts[rank]->ShallowCopy(aroundAPlate(ends[rank][0], ends[rank][1], jump));
    }
    const auto pieces = ranks.make();
    expectSame(*inOnePiece(aroundAPlate(0, 24, jump)), *pieces);
    pieces->prepareContents({ middle });
    EXPECT_EQ(pieces->contentOf(middle).hasWall, jump > 0);
  }
}

TEST(Pieces, FacesBetweenThemNeedNotBeTheSame)
{
  const auto halfOf = [](int first, int last)
  {
    vtkNew<vtkImageData> image;
    image->SetExtent(0, 9, 0, 9, first, last);
    image->SetSpacing(0.2, 0.2, 0.2);
    image->SetOrigin(-0.9, -0.9, -0.9);
    addPointArray(image, "N", ball);
    vtkNew<vtkDataSetTriangleFilter> divide;
    divide->SetInputData(image);
    divide->Update();
    return vtkSmartPointer<vtkUnstructuredGrid>(divide->GetOutput());
  };
  Ranks ranks({ halfOf(0, 5), halfOf(5, 9) }); // whose diagonals do not meet
  const auto pieces = ranks.make();
  const Box box{ { -0.3, -0.3, -0.3 }, { 0.3, 0.3, 0.3 } };
  const Lattice lattice{ { -0.3, -0.3, -0.3 }, { 0.03, 0.03, 0.03 }, { 21, 21, 21 } };
  pieces->prepareContents({ box });
  pieces->prepareSamples({ lattice });
  const auto content = pieces->contentOf(box);
  EXPECT_TRUE(content.hasGas);
  EXPECT_FALSE(content.hasWall);
  EXPECT_FALSE(content.hasWindow);
  std::vector<double> values(static_cast<std::size_t>(lattice.size()));
  std::vector<schlieren::Place> places(values.size());
  pieces->sample(lattice, values.data(), places.data(), nullptr);
  EXPECT_EQ(places, std::vector<schlieren::Place>(values.size(), schlieren::Place::Gas));
}

/// Layers around a sphere of radius 1, closed behind it and at its poles.
vtkSmartPointer<vtkStructuredGrid> layersOf(int first, int last)
{
  auto grid = vtkSmartPointer<vtkStructuredGrid>::New();
  grid->SetExtent(0, 24, 0, 12, first, last);
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (int k = first; k <= last; ++k)
  {
    const double r = 1 + 0.05 * k * k;
    for (int j = 0; j <= 12; ++j)
    {
      for (int i = 0; i <= 24; ++i)
      {
        const double polar = std::acos(-1.) * j / 12, around = std::acos(-1.) * i / 12;
        points->InsertNextPoint(r * std::cos(polar), r * std::sin(polar) * std::sin(around),
          r * std::sin(polar) * std::cos(around));
      }
    }
  }
  grid->SetPoints(points);
  addPointArray(
    grid, "N", [](const Vec& x) { return 1e-4 * (1 + 0.2 * x[0] + std::exp(-dot(x, x))); });
  return grid;
}

TEST(Pieces, LayersAroundABodyAreOneGrid)
{
  const auto whole = inOnePiece(layersOf(0, 8));
  Ranks ranks({ layersOf(0, 2), layersOf(2, 5), layersOf(5, 8) });
  expectSame(*whole, *ranks.make());
}

TEST(Pieces, HiddenCellsAndBodiesAreWalls)
{
  vtkNew<vtkSphereSource> sphere;
  sphere->SetRadius(0.25);
  sphere->SetCenter(0.5, 0.1, 0);
  sphere->SetThetaResolution(24);
  sphere->SetPhiResolution(24);
  sphere->Update();
  const vtkSmartPointer<vtkUnstructuredGrid> mesh = wholeMesh();
  vtkNew<vtkUnsignedCharArray> hidden; // on both sides of the cut
  hidden->SetName(vtkDataSetAttributes::GhostArrayName());
  for (vtkIdType cell = 0; cell < mesh->GetNumberOfCells(); ++cell)
  {
    double bounds[6];
    mesh->GetCellBounds(cell, bounds);
    const bool isHidden =
      std::abs(bounds[0]) < 0.3 && bounds[2] < -0.3 && std::abs(bounds[4]) < 0.4;
    hidden->InsertNextValue(isHidden ? vtkDataSetAttributes::HIDDENCELL : 0);
  }
  mesh->GetCellData()->AddArray(hidden);
  const auto whole = inOnePiece(mesh, false, sphere->GetOutput());
  const auto rankOf = [](const Vec& x) { return x[0] - 0.3 * x[1] < 0 ? 0 : 1; };
  Ranks ranks({ partOf(mesh, 0, rankOf), partOf(mesh, 1, rankOf) });
  expectSame(*whole, *ranks.make(sphere->GetOutput()));
}

TEST(Pieces, RanksMayHaveNothingOrOtherBlocks)
{
  const vtkSmartPointer<vtkUnstructuredGrid> mesh = wholeMesh();
  const auto rankOf = [](const Vec& x) { return x[2] < 0.1 ? 0 : 1; };
  const auto blockOf = [&](int rank)
  {
    vtkNew<vtkMultiBlockDataSet> blocks;
    blocks->SetBlock(0, partOf(mesh, rank, rankOf));
    vtkNew<vtkUnstructuredGrid> other; // without the array, which is of no use
    other->CopyStructure(mesh);
    blocks->SetBlock(static_cast<unsigned>(1 + rank), other);
    return Data(blocks);
  };
  const auto whole = inOnePiece(mesh);
  Ranks ranks({ nullptr, blockOf(0), vtkSmartPointer<vtkUnstructuredGrid>::New(), blockOf(1) });
  expectSame(*whole, *ranks.make());
}

/// What is said of a mistake, or "".
std::string problemOf(Ranks& ranks)
{
  try
  {
    ranks.make();
  }
  catch (const std::runtime_error& problem)
  {
    return problem.what();
  }
  return "";
}

TEST(Pieces, ArraysThatOneRankLacksAreTakenFromTheOthers)
{
  const vtkSmartPointer<vtkUnstructuredGrid> mesh = wholeMesh();
  const auto rankOf = [](const Vec& x) { return x[0] < 0 ? 0 : 1; };
  const auto part = partOf(mesh, 0, rankOf), without = partOf(mesh, 1, rankOf);
  for (vtkIdType i = 0; i < without->GetNumberOfPoints(); ++i)
  {
    without->GetPoints()->SetPoint(i, without->GetPoint(i)[0] + 0.5, 0, 0); // nowhere near
  }
  without->GetPointData()->RemoveArray("N");
  addPointArray(without, "M", ball);
  // Of two blocks.
  std::vector<Data> blocks;
  for (vtkUnstructuredGrid* block : { part.Get(), without.Get() })
  {
    auto all = vtkSmartPointer<vtkMultiBlockDataSet>::New();
    all->SetNumberOfBlocks(2);
    all->SetBlock(static_cast<unsigned int>(blocks.size()), block);
    blocks.emplace_back(all);
  }
  Ranks some(blocks);
  const auto source = some.make();
  EXPECT_LT(source->bounds().high[0], 0.2);
  // Of one dataset.
  Ranks one({ part, without });
  EXPECT_NE(problemOf(one).find("have not the same arrays"), std::string::npos) << problemOf(one);
  Ranks none({ without, without });
  EXPECT_NE(
    problemOf(none).find("The input has no array 'N'. Set IndexArray to one of: point arrays M"),
    std::string::npos)
    << problemOf(none);
}

TEST(Pieces, AllValuesInvalidIsAMistake)
{
  const vtkSmartPointer<vtkUnstructuredGrid> mesh = wholeMesh();
  mesh->GetPointData()->GetArray("N")->Fill(std::nan(""));
  const auto rankOf = [](const Vec& x) { return x[0] < 0 ? 0 : 1; };
  Ranks ranks({ partOf(mesh, 0, rankOf), partOf(mesh, 1, rankOf) });
  EXPECT_NE(problemOf(ranks).find("There is no valid value"), std::string::npos)
    << problemOf(ranks);
}

TEST(Pieces, ARankThatLeavesIsAMistakeWheneverItDoes)
{
  const vtkSmartPointer<vtkUnstructuredGrid> mesh = wholeMesh();
  const auto rankOf = [](const Vec& x) { return x[0] < 0 ? 0 : 1; };
  const std::vector<Data> parts{ partOf(mesh, 0, rankOf), partOf(mesh, 1, rankOf) };
  int answers = 0;
  for (; answers < 10; ++answers)
  {
    Ranks ranks(parts);
    ranks.Channels[0]->AnswersLeft = answers;
    const std::string problem = problemOf(ranks);
    if (problem.empty())
    {
      break;
    }
    EXPECT_NE(problem.find("Rank 1 does not answer"), std::string::npos) << problem;
  }
  EXPECT_GT(answers, 3);
  EXPECT_LT(answers, 10);
}

TEST(Pieces, APieceThatWasReplacedIsNotMistakenForAnother)
{
  const auto parts = cuts()[0];
  Ranks ranks(parts);
  const auto first = ranks.make();
  const auto second = ranks.make();
  const Box box{ { -0.5, -0.5, -0.5 }, { 0.5, 0.5, 0.5 } };
  EXPECT_THROW(first->prepareContents({ box }), std::runtime_error);
  second->prepareContents({ box });
  EXPECT_TRUE(second->contentOf(box).hasGas);
  ranks.Filters[0]->ReleasePieces();
  EXPECT_THROW(second->prepareContents({ box }), std::runtime_error);
}

} // namespace

// What ranks send of their samples is less than these: most points of lattices are not theirs.
TEST(Pieces, SendTheSamplesThatTheyHave)
{
  constexpr std::size_t points = 1003, fields = 2;
  filters::DataPiece::Samples samples;
  samples.found.resize(points);
  samples.values.resize(points);
  samples.fields.assign(fields * points, std::numeric_limits<double>::quiet_NaN());
  for (std::size_t i = 0; i < points; i += i % 7 + 1)
  {
    samples.found[i] = 1;
    samples.values[i] = std::sin(static_cast<double>(i));
    samples.fields[i] = static_cast<double>(i) / 3;
    samples.fields[points + i] = 1e300 * static_cast<double>(i);
  }
  std::vector<char> message;
  filters::put(42, message);
  samples.Put(message);
  filters::put(43, message);
  const auto found =
    static_cast<std::size_t>(std::count(samples.found.begin(), samples.found.end(), 1));
  EXPECT_LT(message.size(), points / 8 + 24 * found + 40);

  filters::Reader reader(message);
  EXPECT_EQ(reader.Get<int>(), 42);
  const auto read = filters::DataPiece::Samples::Get(reader, points, fields);
  EXPECT_EQ(reader.Get<int>(), 43);
  EXPECT_EQ(read.found, samples.found);
  EXPECT_EQ(read.values, samples.values);
  ASSERT_EQ(read.fields.size(), samples.fields.size());
  for (std::size_t i = 0; i < read.fields.size(); ++i)
  {
    EXPECT_TRUE(read.fields[i] == samples.fields[i] ||
      (std::isnan(read.fields[i]) && std::isnan(samples.fields[i])));
  }

  const auto readAs = [&](std::size_t ofPoints, std::size_t ofFields, std::size_t bytes)
  {
    const std::vector<char> some(message.begin() + sizeof(int),
      message.begin() + static_cast<std::ptrdiff_t>(sizeof(int) + bytes));
    filters::Reader again(some);
    return filters::DataPiece::Samples::Get(again, ofPoints, ofFields);
  };
  const std::size_t all = message.size() - 2 * sizeof(int);
  EXPECT_NO_THROW(readAs(points, fields, all));
  EXPECT_THROW(readAs(points + 1, fields, all), std::runtime_error);
  EXPECT_THROW(readAs(points, fields - 1, all), std::runtime_error);
  for (std::size_t bytes = 0; bytes < all; bytes += 97)
  {
    EXPECT_THROW(readAs(points, fields, bytes), std::runtime_error) << bytes;
  }

  std::vector<char> nothing;
  filters::DataPiece::Samples().Put(nothing);
  filters::Reader ofNothing(nothing);
  EXPECT_TRUE(filters::DataPiece::Samples::Get(ofNothing, points, fields).found.empty());
}
