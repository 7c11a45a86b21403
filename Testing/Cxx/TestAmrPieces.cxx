// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// Blocks of adaptive meshes on several ranks, against the same blocks on one.
#include "AmrOwners.h"
#include "BallOnLevels.h"
#include "Pieces.h"

#include "vtkMultiBlockDataSet.h"
#include "vtkSphereSource.h"

#include <algorithm>
#include <cstdlib>
#include <functional>
#include <stdexcept>

namespace
{

/// Half of the range from one cell to the next: what cells far away change shows.
double rough(const Vec& x)
{
  return ball(x) + 3e-5 * std::sin(70 * x[0]) * std::cos(50 * x[1] - 60 * x[2]);
}

/// Blocks of 8 x 8 x 8 cells in the cube from -1 to 1 where `isRefined` says so of their middles: level 0 has 2 x 2 x 2 of
/// them. `ratio`: of each level to the one before.
std::vector<vtkSmartPointer<vtkImageData>> blocksOn(int levels, const std::array<int, 3>& ratio,
  const std::function<bool(int level, const Vec& middle)>& isThere)
{
  constexpr int cells = 8;
  std::vector<vtkSmartPointer<vtkImageData>> blocks;
  std::array<int, 3> count{ 2, 2, 2 };
  for (int level = 0; level < levels; ++level)
  {
    for (int i = 0; i < count[0] * count[1] * count[2]; ++i)
    {
      const std::array<int, 3> at{ i % count[0], i / count[0] % count[1], i / count[0] / count[1] };
      Vec origin, middle, spacing;
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        spacing[axis] = 2. / cells / count[axis];
        origin[axis] = -1 + at[axis] * cells * spacing[axis];
        middle[axis] = origin[axis] + cells * spacing[axis] / 2;
      }
      if (!isThere(level, middle))
      {
        continue;
      }
      auto block = vtkSmartPointer<vtkImageData>::New();
      block->SetDimensions(cells + 1, cells + 1, cells + 1);
      block->SetOrigin(origin.data());
      block->SetSpacing(spacing.data());
      addCellArray(block, "N of cells", rough);
      blocks.push_back(block);
    }
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      count[axis] *= ratio[axis];
    }
  }
  return blocks;
}

/// Finer towards a corner of the cube, in steps.
bool isNearCorner(int level, const Vec& middle)
{
  return level == 0 || std::max({ middle[0], middle[1], middle[2] }) < 0.7 - 0.55 * level;
}

Data together(const std::vector<vtkSmartPointer<vtkImageData>>& blocks)
{
  auto data = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  for (std::size_t n = 0; n < blocks.size(); ++n)
  {
    data->SetBlock(static_cast<unsigned>(n), blocks[n]);
  }
  return data;
}

enum class Order
{
  InTurn,   // block by block to the next rank
  InARow,   // the first blocks to the first rank
  ByLevels, // the levels to ranks
};

/// The blocks of each rank; the second has none.
std::vector<Data> dealt(
  const std::vector<vtkSmartPointer<vtkImageData>>& blocks, std::size_t ranks, Order order)
{
  const std::vector<vtkSmartPointer<vtkImageData>> none(blocks.size());
  std::vector<std::vector<vtkSmartPointer<vtkImageData>>> ofRanks(ranks, none);
  for (std::size_t n = 0; n < blocks.size(); ++n)
  {
    std::size_t rank = n % ranks;
    if (order == Order::InARow)
    {
      rank = n * ranks / blocks.size();
    }
    else if (order == Order::ByLevels)
    {
      rank = static_cast<std::size_t>(std::lround(1 / blocks[n]->GetSpacing()[0])) % ranks;
    }
    ofRanks[rank][n] = blocks[n];
  }
  std::vector<Data> parts{ together(ofRanks[0]), nullptr };
  for (std::size_t rank = 1; rank < ranks; ++rank)
  {
    parts.push_back(together(ofRanks[rank]));
  }
  return parts;
}

/// The sums of cells' values have another order.
constexpr double rounding = 1e-14;

void expectSameOnRanks(
  const std::vector<vtkSmartPointer<vtkImageData>>& blocks, vtkDataObject* bodies = nullptr)
{
  const auto whole = inOnePiece(together(blocks), true, bodies);
  for (const std::size_t ranks : { 2, 3, 5 })
  {
    for (const Order order : { Order::InTurn, Order::InARow, Order::ByLevels })
    {
      SCOPED_TRACE(std::to_string(ranks) + " ranks, " + std::to_string(static_cast<int>(order)));
      Ranks of(dealt(blocks, ranks, order), true);
      const auto pieces = of.make(bodies);
      expectSame(*whole, *pieces, rounding);
      expectSameContents(*whole, *pieces);
    }
  }
}

} // namespace

TEST(AmrPieces, AreSampledAsAllBlocks)
{
  expectSameOnRanks(blocksOn(1, { 2, 2, 2 }, isNearCorner));
  expectSameOnRanks(blocksOn(3, { 2, 2, 2 }, isNearCorner));
}

// What is coarser or finer beside a block may be some levels away, or on the same level along an axis.
TEST(AmrPieces, AnyRatioOfLevelsIsTheSame)
{
  const auto steep = [](int level, const Vec& middle)
  { return level != 1 && (level == 0 || isNearCorner(1, middle)); };
  expectSameOnRanks(blocksOn(3, { 2, 2, 2 }, steep));
  expectSameOnRanks(blocksOn(2, { 4, 4, 4 }, isNearCorner));
  expectSameOnRanks(blocksOn(3, { 2, 1, 2 }, isNearCorner));
}

// Walls where ranks and levels meet, blocks that are not there, and a body across them.
TEST(AmrPieces, WallsAndBodiesContinue)
{
  const auto isThere = [](int level, const Vec& middle)
  { return isNearCorner(level, middle) && !(middle[0] > 0 && middle[1] > 0 && middle[2] < 0); };
  const auto blocks = blocksOn(3, { 2, 2, 2 }, isThere);
  for (vtkImageData* block : blocks)
  {
    vtkDataArray* values = block->GetCellData()->GetArray("N of cells");
    for (vtkIdType cell = 0; cell < block->GetNumberOfCells(); ++cell)
    {
      double bounds[6];
      block->GetCellBounds(cell, bounds);
      if (bounds[0] > -0.2 && bounds[1] < 0.6 && bounds[2] > -0.6 && bounds[3] < 0.3)
      {
        values->SetComponent(cell, 0, std::nan(""));
      }
    }
  }
  vtkNew<vtkSphereSource> sphere;
  sphere->SetRadius(0.3);
  sphere->SetCenter(-0.5, -0.1, -0.4);
  sphere->SetThetaResolution(40);
  sphere->SetPhiResolution(40);
  sphere->Update();
  expectSameOnRanks(blocks);
  expectSameOnRanks(blocks, sphere->GetOutput());
}

// Copies of others' cells around the own ones, as codes write them.
TEST(AmrPieces, CopiesInBlocksAreLeftOut)
{
  const auto blocks = blocksOn(1, { 2, 2, 2 }, isNearCorner);
  std::vector<vtkSmartPointer<vtkImageData>> wider;
  for (vtkImageData* block : blocks)
  {
    auto more = vtkSmartPointer<vtkImageData>::New();
    const bool isLeft = block->GetOrigin()[0] < -0.5;
    more->SetDimensions(11, 9, 9); // two layers
    more->SetSpacing(block->GetSpacing());
    more->SetOrigin(block->GetOrigin()[0] - (isLeft ? 0 : 2 * block->GetSpacing()[0]),
      block->GetOrigin()[1], block->GetOrigin()[2]);
    addCellArray(more, "N of cells", rough);
    more->AllocateCellGhostArray();
    for (vtkIdType cell = 0; cell < more->GetNumberOfCells(); ++cell)
    {
      const bool isCopy = isLeft ? cell % 10 >= 8 : cell % 10 < 2;
      more->GetCellGhostArray()->SetValue(
        cell, isCopy ? static_cast<unsigned char>(vtkDataSetAttributes::DUPLICATECELL) : 0);
      if (isCopy)
      {
        more->GetCellData()->GetArray("N of cells")->SetComponent(cell, 0, 1); // nobody reads it
      }
    }
    wider.push_back(more);
  }
  const auto whole = inOnePiece(together(blocks), true);
  Ranks ranks(dealt(wider, 3, Order::InTurn), true);
  expectSame(*whole, *ranks.make(), rounding);
}

// Blocks with values at points, or not on one lattice, are meshes.
TEST(AmrPieces, OtherBlocksAreMeshes)
{
  auto blocks = blocksOn(1, { 2, 2, 2 }, isNearCorner);
  blocks[7]->SetOrigin(0.03, 0, 0); // a gap
  for (vtkImageData* block : blocks)
  {
    addPointArray(block, "N", ball);
    addCellArray(block, "N of cells", ball);
  }
  const auto whole = inOnePiece(together(blocks));
  Ranks ranks(dealt(blocks, 3, Order::InTurn));
  // A rank does not know the cells beside a block that others have; one process does.
  expectSame(*whole, *ranks.make(), 1e-2);

  const auto wholeOfCells = inOnePiece(together(blocks), true);
  Ranks ranksOfCells(dealt(blocks, 3, Order::InTurn), true);
  expectSame(*wholeOfCells, *ranksOfCells.make(), 1e-2);
}

TEST(AmrPieces, ARankWithoutTheArrayHasNoBlocks)
{
  auto blocks = blocksOn(1, { 2, 2, 2 }, isNearCorner);
  std::vector<Data> parts = dealt(blocks, 2, Order::InARow);
  const auto whole = inOnePiece(parts[0], true);
  for (std::size_t n = 4; n < 8; ++n)
  {
    blocks[n]->GetCellData()->Initialize();
    blocks[n]->GetPointData()->Initialize();
  }
  Ranks ranks(parts, true);
  expectSame(*whole, *ranks.make(), rounding);
}

// A rank has its blocks and a few cells around them, not all.
TEST(AmrPieces, OnlyCellsBesideBlocksAreSent)
{
  const auto blocks = blocksOn(1, { 2, 2, 2 }, isNearCorner);
  Ranks ranks(dealt(blocks, 2, Order::InARow), true);
  ranks.make();
  // 4 layers of 16 x 16 cells each way, of 8 + 4 (+ 1) bytes, and the triangles of none.
  EXPECT_LT(ranks.Channels[1]->Bytes, 2 * 4 * 16 * 16 * 13 + 40000);
}

// Blocks that are dealt out one by one: each rank gets neighbouring ones, so few copies.
TEST(AmrPieces, ScatteredBlocksAreGathered)
{
  const auto blocks = blocksOn(2, { 4, 4, 4 }, [](int level, const Vec&) { return level == 1; });
  const auto whole = inOnePiece(together(blocks), true);
  Ranks ranks(dealt(blocks, 4, Order::InTurn), true);
  expectSame(*whole, *ranks.make(), rounding);
  std::size_t bytes = 0;
  for (const auto& channel : ranks.Channels)
  {
    bytes += channel->Bytes;
  }
  // Three quarters move, from a rank to the first and on. Copies on all sides of each would be 7 times the cells, twice.
  const std::size_t cells = 64 * 64 * 64;
  EXPECT_LT(bytes, 4 * cells * 13);
}

namespace
{

constexpr std::size_t imagesOfLevels = 128;

/// The first of each of so many ranks, and the number of all.
std::vector<std::uint64_t> imagesOfRanks(std::size_t ranks)
{
  std::vector<std::uint64_t> first;
  for (std::size_t rank = 0; rank <= ranks; ++rank)
  {
    first.push_back(imagesOfLevels * rank / ranks);
  }
  return first;
}

/// Two levels of blocks of 8 x 8 x 8 cells, whose images are in this order.
filters::AmrLevels levelsOf(const std::function<std::size_t(std::size_t)>& order)
{
  filters::AmrLevels levels{};
  levels.flat = -1;
  std::size_t image = 0;
  for (const int count : { 4, 8 })
  {
    filters::AmrLevel level{ { 1. / count, 1. / count, 1. / count },
      { 8 * count, 8 * count, 8 * count }, {} };
    filters::forCells({ 0, 0, 0 }, { 4, 4, 4 },
      [&](int i, int j, int k)
      {
        level.blocks.push_back(
          { order(image++), { 8 * i, 8 * j, 8 * k }, { 8, 8, 8 }, { 0, 0, 0 }, { 8, 8, 8 } });
      });
    levels.levels.push_back(std::move(level));
  }
  return levels;
}

double countOf(const std::vector<std::uint64_t>& owners, std::uint64_t rank)
{
  return static_cast<double>(std::count(owners.begin(), owners.end(), rank));
}

} // namespace

TEST(AmrOwners, AreNeighbours)
{
  constexpr std::size_t images = imagesOfLevels, ranks = 4;
  const auto scattered = levelsOf([](std::size_t image) { return image * 37 % images; });
  const auto owners = filters::betterOwners(scattered, imagesOfRanks(ranks), 4).value();
  ASSERT_EQ(owners.size(), images);
  for (std::size_t rank = 0; rank < ranks; ++rank)
  {
    EXPECT_NEAR(countOf(owners, rank), images / ranks, 1) << rank;
  }
  // Most blocks have neighbours on their own rank.
  int together = 0, pairs = 0;
  for (const filters::AmrLevel& level : scattered.levels)
  {
    for (const filters::AmrBlock& a : level.blocks)
    {
      for (const filters::AmrBlock& b : level.blocks)
      {
        const int distance = std::abs(a.first[0] - b.first[0]) + std::abs(a.first[1] - b.first[1]) +
          std::abs(a.first[2] - b.first[2]);
        pairs += distance == 8 ? 1 : 0;
        together += distance == 8 && owners[a.leaf] == owners[b.leaf] ? 1 : 0;
      }
    }
  }
  EXPECT_GT(together, 0.7 * pairs); // 0.25 where they are scattered
}

TEST(AmrOwners, StayWhereTheyAreNeighboursAlready)
{
  const auto inARow = levelsOf([](std::size_t image) { return image % 64 * 2 + image / 64; });
  EXPECT_FALSE(filters::betterOwners(inARow, imagesOfRanks(4), 4));
  EXPECT_FALSE(filters::betterOwners(inARow, imagesOfRanks(1), 4));
}

TEST(AmrOwners, ARankWithoutAnyGetsNone)
{
  const auto scattered = levelsOf([](std::size_t image) { return image * 37 % imagesOfLevels; });
  const auto owners = filters::betterOwners(scattered, { 0, 40, 40, 90, 128 }, 4).value();
  EXPECT_EQ(countOf(owners, 1), 0);
  EXPECT_NEAR(countOf(owners, 0), 43, 1);
}
