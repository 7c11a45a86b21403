// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Adaptive meshes whose cells hold the values, as the codes that make them write them.
#include "BallOnLevels.h"
#include "Schlieren.h"
#include "Sources/MediumMaker.h"

#include "vtkMultiBlockDataSet.h"
#include "vtkNonOverlappingAMR.h"
#include "vtkSphereSource.h"

#include <numeric>

namespace
{

struct Differences
{
  double deflection, opticalPath;
};

/// The largest differences from the closed form, relative to its largest values, for light along z.
Differences compareWithBall(vtkSchlierenFilter* filter, const GaussianBall& ball)
{
  const GaussianColumn section{ ball.A, ball.s };
  auto* image = vtkImageData::SafeDownCast(filter->GetOutputDataObject(0));
  std::vector<double> deflection, opticalPath;
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    const double x = image->GetPoint(i)[0], y = image->GetPoint(i)[1];
    deflection.push_back(section.deflection(x) * section.opticalPath(y) / section.opticalPath(0));
    deflection.push_back(section.deflection(y) * section.opticalPath(x) / section.opticalPath(0));
    opticalPath.push_back(section.opticalPath(std::hypot(x, y)));
  }
  return { relativeDifference(valuesOf(filter, "Deflection"), deflection),
    relativeDifference(valuesOf(filter, "OpticalPathDifference"), opticalPath) };
}

} // namespace

TEST(Amr, ThreeLevelsMatchTheClosedForm)
{
  for (const int cells : { 32, 64 })
  {
    auto filter =
      bench(ballOnLevels(
              cells, { { 0, cells, true }, { cells / 2, cells, true }, { cells * 3 / 2, cells } }),
        128);
    filter->SetParallelScale(0.95);
    filter->SetMediumTolerance(1e-3);
    filter->Update();
    const Differences errors = compareWithBall(filter, GaussianBall());
    EXPECT_LT(errors.deflection, 1e-3); // 5e-3 at 32 between points' values
    EXPECT_LT(errors.opticalPath, 1e-3);
    EXPECT_EQ(largest(valuesOf(filter, "BlockedFraction")), 0);
  }
}

// What stands out at a border of levels would be a line in a schlieren image: the largest second difference there, by
// that elsewhere.
template <class IsAtBorder>
double bordersByElsewhere(vtkSchlierenFilter* filter, const IsAtBorder& isAtBorder)
{
  auto* image = vtkImageData::SafeDownCast(filter->GetOutputDataObject(0));
  const int points = image->GetDimensions()[0];
  const std::vector<double> deflection = valuesOf(filter, "Deflection");
  double atBorders = 0, elsewhere = 0;
  for (int j = 0; j < points; ++j)
  {
    for (int i = 1; i < points - 1; ++i)
    {
      const auto u = [&](int k)
      { return deflection[static_cast<std::size_t>(2 * (points * j + k))]; };
      double& most = isAtBorder(std::abs(image->GetPoint(i)[0])) ? atBorders : elsewhere;
      most = std::max(most, std::abs(u(i + 1) - 2 * u(i) + u(i - 1)));
    }
  }
  return atBorders / elsewhere;
}

// Of which no grid over all of the domain fits in memory: 512 of the finest cells along each edge.
vtkSmartPointer<vtkOverlappingAMR> deepBall(const GaussianBall& ball)
{
  return ballOnLevels(
    32, { { 0, 32, true }, { 16, 32, true }, { 48, 32 }, { 112, 32, true }, { 240, 32 } }, ball);
}

TEST(Amr, DeepLevelsAreShownAsFineAsTheyAre)
{
  const GaussianBall ball{ 2.7e-4, 0.05 };
  for (const double tolerance : { 1e-2, 1e-3 })
  {
    auto filter = bench(deepBall(ball), 128);
    filter->SetParallelScale(0.12);
    filter->SetMediumTolerance(tolerance);
    filter->Update();
    const Differences errors = compareWithBall(filter, ball);
    EXPECT_LT(errors.deflection, 2 * tolerance);
    // Of leaves that hardly bend light, one value stands for all: the tolerance is one of deflection.
    EXPECT_LT(errors.opticalPath, std::max(2 * tolerance, 5e-3));
    EXPECT_EQ(largest(valuesOf(filter, "BlockedFraction")), 0);
    EXPECT_LT(fieldValue(filter, "SmallestVoxel"), 2. / 32 / (tolerance < 5e-3 ? 8 : 4));
  }
}

TEST(Amr, DeepLevelsHaveTheValuesOfTheBall)
{
  const GaussianBall ball{ 2.7e-4, 0.05 };
  vtkNew<vtkRefractiveIndex> filter;
  filter->SetIndexModel(vtkRefractiveIndex::REFRACTIVITY);
  filter->SetInputArrayToProcess(
    vtkRefractiveIndex::INDEX_ARRAY, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "N");
  const auto amr = deepBall(ball);
  const auto made = filter->GetMaker().make(filter->GetMaker().choose(amr), nullptr);
  const auto source = made->Source;
  ASSERT_TRUE(source);
  EXPECT_EQ(made->Warning, "");
  EXPECT_LT(std::abs(source->ambient()), 1e-12);
  const double finest = 2. / 32 / 16;
  // In the finest level, over its border at 0.0625, and with voxels that are coarser than cells.
  for (const double spacing : { 0.7 * finest, finest, 1.9 * finest, 4 * finest })
  {
    for (const double first : { -0.03, 0.05 })
    {
      schlieren::Lattice lattice{ { first, -0.01, 0.001 }, { spacing, spacing, spacing },
        { 12, 12, 12 } };
      std::vector<double> values(static_cast<std::size_t>(lattice.size()));
      std::vector<schlieren::Place> places(values.size());
      std::vector<float> distances(values.size());
      source->sample(lattice, values.data(), places.data(), distances.data());
      double worst = 0;
      for (std::size_t n = 0; n < values.size(); ++n)
      {
        Vec x{ lattice.first[0], lattice.first[1], lattice.first[2] };
        x[0] += spacing * static_cast<double>(n % 12);
        x[1] += spacing * static_cast<double>(n / 12 % 12);
        x[2] += spacing * static_cast<double>(n / 144);
        worst = std::max(worst, std::abs(values[n] - ball(x)));
        EXPECT_EQ(places[n], schlieren::Place::Gas);
      }
      // Coarser cells hold means over more of the ball.
      EXPECT_LT(worst, (spacing < 2 * finest ? 1e-4 : 1.5e-2) * ball.A) << spacing;
    }
  }
}

// Means over cells that a plane, askew, cuts: about one cell between two values.
TEST(Amr, ShocksDoNotOvershoot)
{
  const auto amr = ballOnLevels(24, { { 0, 24, true } });
  for (unsigned int i = 0; i < 8; ++i)
  {
    addCellArray(blockOf(amr, 0, i), "N",
      [](const Vec& x)
      { return 1e-4 + 1e-4 * std::clamp(0.5 + 12 * (x[0] + 0.3 * x[1] - 0.1 * x[2]), 0., 1.); });
  }
  vtkNew<vtkRefractiveIndex> filter;
  filter->SetIndexModel(vtkRefractiveIndex::REFRACTIVITY);
  filter->SetInputArrayToProcess(
    vtkRefractiveIndex::INDEX_ARRAY, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "N");
  const auto source = filter->GetMaker().make(filter->GetMaker().choose(amr), nullptr)->Source;
  const schlieren::Lattice lattice{ { -0.4, -0.4, -0.4 }, { 0.013, 0.013, 0.013 }, { 61, 61, 61 } };
  std::vector<double> values(static_cast<std::size_t>(lattice.size()));
  std::vector<schlieren::Place> places(values.size());
  source->sample(lattice, values.data(), places.data(), nullptr);
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  EXPECT_GT(*least, 1e-4 - 1e-6);
  EXPECT_LT(*most, 2e-4 + 1e-6);
}

TEST(Amr, BordersOfDeepLevelsDoNotShow)
{
  auto filter = bench(deepBall({ 2.7e-4, 0.1 }), 255);
  filter->SetParallelScale(0.3);
  filter->SetMediumTolerance(1e-3);
  filter->Update();
  EXPECT_LT(bordersByElsewhere(filter,
              [](double x) {
                return std::abs(x - 0.0625) < 0.01 || std::abs(x - 0.125) < 0.01 ||
                  std::abs(x - 0.25) < 0.01;
              }),
    1);
}

TEST(Amr, BodiesInDeepLevelsCastSharpShadows)
{
  auto filter = bench(deepBall({ 2.7e-4, 0.05 }), 200);
  vtkNew<vtkSphereSource> body;
  body->SetRadius(0.05);
  body->SetThetaResolution(64);
  body->SetPhiResolution(64);
  filter->SetInputConnection(1, body->GetOutputPort());
  filter->SetParallelScale(0.1);
  filter->Update();
  const std::vector<double> blocked = valuesOf(filter, "BlockedFraction");
  const double pixel = 0.2 / 200;
  const double area = std::accumulate(blocked.begin(), blocked.end(), 0.) * pixel * pixel;
  EXPECT_NEAR(area / (pi * 0.05 * 0.05), 1, 0.01);
}

// The levels need not be known as such, nor lie over each other.
TEST(Amr, BlocksOfAnyCompositeAreTheSame)
{
  auto amr = ballOnLevels(16, { { 0, 16, true }, { 8, 16, true } });
  auto expected = bench(amr);
  expected->Update();
  vtkNew<vtkNonOverlappingAMR> leaves;
  initialize(leaves, { 8, 8 });
  vtkNew<vtkMultiBlockDataSet> blocks;
  for (unsigned int i = 0; i < 16; ++i)
  {
    auto* grid = blockOf(amr, i / 8, i % 8);
    leaves->SetDataSet(i / 8, i % 8, grid);
    blocks->SetBlock(15 - i, grid);
  }
  for (vtkDataObject* input :
    { static_cast<vtkDataObject*>(leaves), static_cast<vtkDataObject*>(blocks) })
  {
    auto filter = bench(input);
    filter->Update();
    EXPECT_EQ(valuesOf(filter, "Deflection"), valuesOf(expected, "Deflection"));
  }
}

// Bodies: hidden cells and NaN, on both levels. The gas around them is uniform and stays so.
TEST(Amr, SolidsBlockLightAndBendNone)
{
  auto amr = ballOnLevels(16, { { 0, 16, true }, { 8, 16 } });
  for (unsigned int level = 0; level < 2; ++level)
  {
    for (unsigned int i = 0; i < blocksOf(amr, level); ++i)
    {
      addCellArray(blockOf(amr, level, i), "N", [](const Vec&) { return 3e-4; });
    }
  }
  blockOf(amr, 0, 0)->GetCellData()->GetArray("N")->SetComponent(0, 0, std::nan(""));
  blockOf(amr, 1, 0)->BlankCell(0);
  auto filter = bench(amr);
  filter->SetAmbientRefractivity(-1);
  filter->Update();
  EXPECT_EQ(largest(valuesOf(filter, "Deflection")), 0);
  auto* image = vtkImageData::SafeDownCast(filter->GetOutputDataObject(0));
  const auto isBlocked = [&](double x, double y)
  {
    const double at[3] = { x, y, 0 };
    return arrayOf(filter, "BlockedFraction")
             ->GetComponent(image->FindPoint(const_cast<double*>(at)), 0) > 0.5;
  };
  EXPECT_TRUE(isBlocked(-0.94, -0.94));
  EXPECT_TRUE(isBlocked(-0.47, -0.47));
  EXPECT_FALSE(isBlocked(-0.75, -0.75));
  EXPECT_FALSE(isBlocked(-0.3, -0.3));
  EXPECT_FALSE(isBlocked(0.3, 0.3));
}

double blockedArea(vtkSchlierenFilter* filter)
{
  const std::vector<double> blocked = valuesOf(filter, "BlockedFraction");
  const double* pixel = vtkImageData::SafeDownCast(filter->GetOutputDataObject(0))->GetSpacing();
  return std::accumulate(blocked.begin(), blocked.end(), 0.) * pixel[0] * pixel[1];
}

// Cells without a number, on the levels that have them: a cube of edge 1, finer than elsewhere for x < 0.
TEST(Amr, SolidCellsHaveTheirOwnEdges)
{
  auto amr = ballOnLevels(16, { { 0, 16, true }, { 0, 16, true }, { 8, 16 } });
  for (unsigned int level = 0; level < 3; ++level)
  {
    for (unsigned int i = 0; i < blocksOf(amr, level); ++i)
    {
      vtkImageData* block = blockOf(amr, level, i);
      vtkDataArray* values = block->GetCellData()->GetArray("N");
      for (vtkIdType cell = 0; cell < block->GetNumberOfCells(); ++cell)
      {
        double bounds[6];
        block->GetCellBounds(cell, bounds);
        const double size = bounds[1] - bounds[0];
        const bool isIn =
          std::all_of(bounds, bounds + 6, [&](double x) { return std::abs(x) <= 0.5 + size / 8; });
        values->SetComponent(cell, 0, isIn ? std::nan("") : 3e-4);
      }
    }
  }
  for (const double along : { 0., 1. })
  {
    auto filter = bench(amr, 200);
    filter->SetViewDirection(along, 0, -1);
    filter->SetAmbientRefractivity(-1);
    filter->Update();
    const double seen = along > 0 ? std::sqrt(2.) : 1;
    // Light that cuts a corner by less than a voxel may miss it.
    EXPECT_NEAR(blockedArea(filter) / seen, 1, along > 0 ? 0.025 : 0.003);
    EXPECT_EQ(largest(valuesOf(filter, "Deflection")), 0); // the gas is uniform up to the walls
  }
}

// 27 blocks of one level, of which one is missing: a step at a corner, or a cavity in the middle.
TEST(Amr, MissingBlocksAreBodies)
{
  for (const int missing : { 0, 13 })
  {
    vtkNew<vtkMultiBlockDataSet> blocks;
    for (int i = 0; i < 27; ++i)
    {
      const int first[3] = { i % 3 * 8, i / 3 % 3 * 8, i / 9 * 8 };
      const auto block = amrBlock(first, 8, 1. / 12);
      addCellArray(block.Get(), "N", [](const Vec& x) { return 3e-4 * (1 + 0.1 * x[0]); });
      blocks->SetBlock(static_cast<unsigned>(i), i == missing ? nullptr : block.Get());
    }
    for (const int outside : { vtkRefractiveIndex::OUTSIDE_AUTO, vtkRefractiveIndex::OUTSIDE_BLOCKS,
           vtkRefractiveIndex::OUTSIDE_PASSES })
    {
      auto filter = bench(blocks, 120);
      filter->SetParallelScale(0.95);
      filter->SetOutside(outside);
      filter->Update();
      const bool isBody = outside != vtkRefractiveIndex::OUTSIDE_PASSES;
      const double edge = missing == 0 ? 0.95 - 1. / 3 : 2. / 3; // of what is seen
      EXPECT_NEAR(blockedArea(filter), isBody ? edge * edge : 0, 0.025) << missing << outside;
      // Light is bent by as much as it passes gas.
      auto* image = vtkImageData::SafeDownCast(filter->GetOutputDataObject(0));
      const auto bentAt = [&](double x)
      {
        const double at[3] = { x, x, 0 };
        return arrayOf(filter, "Deflection")
                 ->GetComponent(image->FindPoint(const_cast<double*>(at)), 0) /
          (2 * 3e-5);
      };
      EXPECT_NEAR(bentAt(0.7), 1, 0.01);
      if (!isBody)
      {
        EXPECT_NEAR(bentAt(missing == 0 ? -0.7 : 0), 2. / 3, 0.02);
      }
    }
  }
}

// Two blocks so far from the origin that they have no extent: an error, and nothing that divides by it.
TEST(Amr, BlocksWithoutExtentAreAnError)
{
  vtkNew<vtkMultiBlockDataSet> blocks;
  for (unsigned number = 0; number < 2; ++number)
  {
    vtkNew<vtkImageData> block;
    block->SetDimensions(5, 5, 5);
    block->SetOrigin(1e18, 1e18, 1e18);
    addCellArray(block, "N", [](const Vec& x) { return 1e-4 * x[0]; });
    blocks->SetBlock(number, block);
  }
  auto filter = bench(blocks);
  auto complaints = vtkSmartPointer<Complaints>::Take(new Complaints(filter));
  filter->Update();
  EXPECT_FALSE(complaints->Errors.empty());
  EXPECT_TRUE(isEmpty(filter));
}

// VTK's own source: 5 x 5 x 5 cells of edge 0.5, in part refined once. It gives values at the cells'
// centres, not means, which is the same only in a field of little curvature.
TEST(Amr, PulseOfVtkMatchesTheClosedForm)
{
  const std::array<double, 3> centre{ -300, -250, 1.25 };
  const double width = 1000;
  auto filter = benchOfPulse(centre, width, 33);
  filter->SetPrecision(vtkSchlierenFilter::DOUBLE);
  filter->Update();
  auto* image = vtkImageData::SafeDownCast(filter->GetOutputDataObject(0));
  const double depth = 2.5;
  const double along = std::sqrt(pi) * width * std::erf(depth / 2 / width);
  std::vector<double> deflection, opticalPath;
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    const double x = image->GetPoint(i)[0] - centre[0], y = image->GetPoint(i)[1] - centre[1];
    opticalPath.push_back(1e-4 * along * std::exp(-(x * x + y * y) / (width * width)));
    deflection.push_back(-2 * x / (width * width) * opticalPath.back());
    deflection.push_back(-2 * y / (width * width) * opticalPath.back());
  }
  EXPECT_LT(relativeDifference(valuesOf(filter, "Deflection"), deflection), 1e-3);
  EXPECT_LT(relativeDifference(valuesOf(filter, "OpticalPathDifference"), opticalPath), 1e-3);
}
