// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// The fields that tint an image of data on several ranks, against those of the same data on one.
#include "Pieces.h"
#include "SameTree.h"

#include "Medium/BrickMakers.h"

#include "vtkAppendFilter.h"
#include "vtkCellData.h"
#include "vtkImageData.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPointData.h"
#include "vtkSphereSource.h"
#include "vtkUnstructuredGrid.h"

#include <functional>
#include <limits>
#include <stdexcept>

namespace
{

using Extent = std::array<int, 6>;

constexpr Extent all{ 0, 24, 0, 20, 0, 20 };

/// Its range is not that of any part.
double warmth(const Vec& x) { return std::sin(2 * x[0]) + 0.3 * x[1] * x[2]; }

vtkSmartPointer<vtkImageData> imageOf(const Extent& extent)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetExtent(extent[0], extent[1], extent[2], extent[3], extent[4], extent[5]);
  image->SetSpacing(0.09, 0.1, 0.1);
  image->SetOrigin(-1.2, -1, -1);
  addPointArray(image, "N", ball);
  addPointArray(image, "warmth", warmth);
  addCellArray(image, "N of cells", ball);
  addCellArray(image, "warmth of cells", warmth);
  return image;
}

Data meshOf(const Extent& extent)
{
  vtkNew<vtkAppendFilter> append;
  append->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  append->AddInputData(imageOf(extent));
  append->Update();
  return append->GetOutput();
}

/// Some of several blocks.
Data blocksOf(const std::vector<Extent>& extents, std::size_t first, std::size_t count)
{
  auto blocks = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  blocks->SetNumberOfBlocks(static_cast<unsigned>(extents.size()));
  for (std::size_t n = first; n < first + count; ++n)
  {
    blocks->SetBlock(static_cast<unsigned>(n), imageOf(extents[n]));
  }
  return blocks;
}

void askForFields(vtkRefractiveIndex* filter, const std::vector<const char*>& fields)
{
  filter->ClearFields();
  for (const char* field : fields)
  {
    filter->AddField(field);
  }
}

struct Case
{
  const char* name;
  Data whole;
  std::vector<Data> parts;
  bool ofCells;
  vtkSmartPointer<vtkDataObject> bodies;
};

std::vector<Case> cases()
{
  const std::vector<Extent> extents{ { 0, 9, 0, 20, 0, 20 }, { 9, 13, 0, 20, 0, 20 },
    { 13, 24, 0, 20, 0, 20 } };
  vtkNew<vtkSphereSource> sphere;
  sphere->SetRadius(0.3);
  sphere->SetCenter(0.5, 0.2, 0);
  sphere->Update();
  std::vector<Case> found{ { "mesh", meshOf(all), {}, false, nullptr },
    { "mesh of cells", meshOf(all), {}, true, nullptr },
    { "image", imageOf(all), {}, false, sphere->GetOutput() },
    { "blocks", blocksOf(extents, 0, 3), {}, true, nullptr },
    { "scattered blocks", {}, {}, true, nullptr } };
  for (std::size_t n = 0; n < extents.size(); ++n)
  {
    found[0].parts.push_back(meshOf(extents[n]));
    found[1].parts.push_back(meshOf(extents[n]));
    found[2].parts.push_back(imageOf(extents[n]));
    found[3].parts.push_back(blocksOf(extents, n, 1));
  }
  std::array<std::vector<Extent>, 3> scattered; // of two ranks, and of both
  for (int n = 0; n < 64; ++n)
  {
    const int x = n % 4 * 6, y = n / 4 % 4 * 5, z = n / 16 * 5;
    const Extent extent{ x, x + 6, y, y + 5, z, z + 5 };
    scattered[static_cast<std::size_t>((n + n / 4 + n / 16) % 2)].push_back(extent);
    scattered[2].push_back(extent);
  }
  found[4].whole = blocksOf(scattered[2], 0, 64);
  found[4].parts = { blocksOf(scattered[0], 0, 32), blocksOf(scattered[1], 0, 32) };
  for (Case& one : found)
  {
    one.parts.insert(one.parts.begin() + 1, nullptr); // this rank has nothing
  }
  return found;
}

/// The largest difference of a field anywhere; of its range, which is 0 to 1.
void expectSameFields(
  const schlieren::MediumSource& whole, const schlieren::MediumSource& pieces, double tolerance)
{
  ASSERT_EQ(whole.fields(), pieces.fields());
  const auto fields = static_cast<std::size_t>(whole.fields());
  std::mt19937 random(5);
  std::uniform_real_distribution<double> place(-1.3, 1);
  for (int i = 0; i < 30; ++i)
  {
    const double h = 0.011 * (1 + i % 8);
    const schlieren::Lattice lattice{ { place(random), place(random), place(random) }, { h, h, h },
      { 7, 8, 9 } };
    const schlieren::Box box{ lattice.first,
      { lattice.first[0] + 6 * h, lattice.first[1] + 7 * h, lattice.first[2] + 8 * h } };
    pieces.prepareContents({ box });
    pieces.prepareSamples({ lattice });
    const auto size = static_cast<std::size_t>(lattice.size());
    std::array<std::vector<double>, 2> nu, values;
    std::array<std::vector<schlieren::Place>, 2> places;
    for (std::size_t k = 0; k < 2; ++k)
    {
      nu[k].resize(size);
      places[k].resize(size);
      values[k].resize(fields * size);
      (k == 0 ? whole : pieces)
        .sampleWithFields(lattice, nu[k].data(), places[k].data(), nullptr, values[k].data());
    }
    ASSERT_EQ(places[0], places[1]);
    for (std::size_t n = 0; n < values[0].size(); ++n)
    {
      if (places[0][n % size] == schlieren::Place::Gas)
      {
        ASSERT_EQ(std::isnan(values[0][n]), std::isnan(values[1][n])) << n / size;
        if (!std::isnan(values[0][n]))
        {
          ASSERT_NEAR(values[0][n], values[1][n], tolerance) << n / size;
        }
      }
    }
    for (std::size_t field = 0; field < fields; ++field)
    {
      const auto a = whole.rangeOfField(static_cast<int>(field), box);
      const auto b = pieces.rangeOfField(static_cast<int>(field), box);
      ASSERT_EQ(a.lowest > a.highest, b.lowest > b.highest);
      for (std::size_t n = 0; n < size; ++n)
      {
        // Of groups of cells that are near more may count; a spline may be beyond its points' values.
        const double value = values[1][field * size + n];
        if (places[1][n] == schlieren::Place::Gas && !std::isnan(value))
        {
          ASSERT_LE(b.lowest, std::max(value, a.lowest) + 1e-12);
          ASSERT_GE(b.highest, std::min(value, a.highest) - 1e-12);
        }
      }
    }
  }
}

/// Data in pieces whose bricks rank 0 makes alone.
class WithoutMakers : public schlieren::MediumSource
{
public:
  explicit WithoutMakers(std::shared_ptr<const schlieren::MediumSource> pieces)
    : Pieces(std::move(pieces))
  {
  }
  schlieren::Box bounds() const override { return this->Pieces->bounds(); }
  double ambient() const override { return this->Pieces->ambient(); }
  std::array<double, 3> voxelShape() const override { return this->Pieces->voxelShape(); }
  Content contentOf(const schlieren::Box& box) const override
  {
    return this->Pieces->contentOf(box);
  }
  void sample(const schlieren::Lattice& lattice, double* refractivity, schlieren::Place* places,
    float* distances) const override
  {
    this->Pieces->sample(lattice, refractivity, places, distances);
  }
  bool isRemote() const override { return true; }
  void prepareContents(const std::vector<schlieren::Box>& boxes) const override
  {
    this->Pieces->prepareContents(boxes);
  }
  void prepareSamples(const std::vector<schlieren::Lattice>& lattices) const override
  {
    this->Pieces->prepareSamples(lattices);
  }
  int fields() const override { return this->Pieces->fields(); }
  FieldRange rangeOfField(int field, const schlieren::Box& box) const override
  {
    return this->Pieces->rangeOfField(field, box);
  }
  void sampleWithFields(const schlieren::Lattice& lattice, double* refractivity,
    schlieren::Place* places, float* distances, double* values) const override
  {
    this->Pieces->sampleWithFields(lattice, refractivity, places, distances, values);
  }

private:
  std::shared_ptr<const schlieren::MediumSource> Pieces;
};

template <class Real>
schlieren::MediumTree<Real> treeOf(std::shared_ptr<const schlieren::MediumSource> source)
{
  const double ambient = source->ambient();
  schlieren::TreeSettings settings;
  settings.tolerance = 3e-3;
  settings.threads = 2;
  schlieren::MediumTree<Real> tree(std::move(source), ambient, settings);
  tree.refine({ { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0 }, { 2, 2 }, 0.02 });
  return tree;
}

} // namespace

// Each rank makes some, in three steps on the same mesh; every other with fields.
TEST(BricksOfPieces, AreTheSameWhoeverMakesThem)
{
  bool hasFields = false;
  for (const Case& data : cases())
  {
    SCOPED_TRACE(data.name);
    hasFields = !hasFields;
    Ranks ranks(data.parts, data.ofCells);
    for (vtkRefractiveIndex* filter : ranks.Filters)
    {
      askForFields(filter, { data.ofCells ? "warmth of cells" : "warmth" });
    }
    const auto make = [&]
    {
      return ranks.make(data.bodies,
        hasFields ? vtkRefractiveIndex::WITH_FIELDS : vtkRefractiveIndex::REFRACTIVITY_ALONE);
    };
    const auto single = treeOf<float>(std::make_shared<WithoutMakers>(make()));
    EXPECT_GT(single.leaves().size(), 30u);
    for (int step = 0; step < 3; ++step)
    {
      std::vector<std::size_t> before;
      for (const auto& channel : ranks.Channels)
      {
        before.push_back(channel->Bytes);
      }
      const auto source = make();
      ASSERT_NE(source->makers(), nullptr);
      expectIdentical(treeOf<float>(source), single);
      for (std::size_t rank = 0; rank < before.size(); ++rank)
      {
        // The rank that has no data makes bricks, too.
        EXPECT_GT(ranks.Channels[rank]->Bytes, before[rank] + 100000) << rank;
      }
    }
    const auto source = make();
    expectIdentical(
      treeOf<double>(source), treeOf<double>(std::make_shared<WithoutMakers>(source)));
  }
}

// Rank 0 has all of the data. With walls, a front, which needs more samples, and fields.
TEST(BricksOfOneRank, AreTheSameWhoeverMakesThem)
{
  std::vector<Case> wholes = cases();
  wholes.push_back({ "front", meshOf({ 0, 40, 0, 40, 0, 40 }), {}, false, wholes[2].bodies });
  addPointArray(vtkDataSet::SafeDownCast(wholes.back().whole), "N",
    [](const Vec& x) { return ball(x) + (x[0] + 0.8 * x[1] + 0.6 * x[2] > 1.5 ? 1e-4 : 0); });
  bool hasFields = true;
  for (const Case& data : wholes)
  {
    hasFields = !hasFields;
    SCOPED_TRACE(data.name);
    Ranks ranks({ data.whole, nullptr, nullptr }, data.ofCells);
    vtkRefractiveIndex* const first = ranks.Filters[0];
    askForFields(first, { data.ofCells ? "warmth of cells" : "warmth" });
    const auto make = [&]
    {
      std::string warning;
      return first->MakeSource(data.whole, data.bodies, warning,
        hasFields ? vtkRefractiveIndex::WITH_FIELDS : vtkRefractiveIndex::REFRACTIVITY_ALONE);
    };
    const auto source = make();
    ASSERT_EQ(source->makers(), nullptr);
    const auto alone = treeOf<float>(source);
    const auto aloneInDouble = treeOf<double>(source);
    first->SetHelp(true);
    ASSERT_NE(source->makers(), nullptr);
    expectIdentical(treeOf<float>(source), alone);
    expectIdentical(treeOf<double>(source), aloneInDouble);
    for (const auto& channel : ranks.Channels)
    {
      EXPECT_GT(channel->Bytes, 100000u);
    }
    for (int step = 0; step < 3; ++step) // each rank keeps what it knows of lattices
    {
      expectIdentical(treeOf<float>(make()), alone);
    }
    // Where a rank is not there, rank 0 works alone.
    ranks.Channels[1]->AnswersLeft = 1;
    expectIdentical(treeOf<float>(source), alone);
    EXPECT_FALSE(ranks.Channels[1]->isOpen());
    EXPECT_EQ(source->makers(), nullptr);
    expectIdentical(treeOf<float>(source), alone);
  }
}

TEST(BricksOfPieces, ARankThatLeavesIsAMistake)
{
  const Case data = cases()[0];
  int answers = 0;
  for (bool isMade = false; !isMade && answers < 200; answers += 1 + answers / 4)
  {
    Ranks ranks(data.parts);
    ranks.Channels[1]->AnswersLeft = answers;
    try
    {
      treeOf<float>(ranks.make());
      isMade = true;
    }
    catch (const std::runtime_error& problem)
    {
      EXPECT_NE(std::string(problem.what()).find("Rank 2 does not answer"), std::string::npos)
        << problem.what();
    }
  }
  EXPECT_GT(answers, 10);
  EXPECT_LT(answers, 200);
}

TEST(BricksOfPieces, AreNotMadeOfWhatIsNotThere)
{
  const Case data = cases()[0];
  Ranks ranks(data.parts);
  EXPECT_THROW(
    {
      const auto forgotten = ranks.make();
      ranks.Filters[0]->ReleasePieces();
      treeOf<float>(forgotten);
    },
    std::runtime_error);
  const auto replaced = ranks.make();
  const auto last = ranks.make();
  EXPECT_THROW(treeOf<float>(replaced), std::runtime_error);
  expectIdentical(treeOf<float>(last), treeOf<float>(std::make_shared<WithoutMakers>(last)));
}

TEST(FieldsOfPieces, AreThoseOfOnePiece)
{
  for (const Case& data : cases())
  {
    SCOPED_TRACE(data.name);
    const std::vector<const char*> names = data.ofCells
      ? std::vector<const char*>{ "warmth of cells", "N of cells" }
      : std::vector<const char*>{ "warmth", "N" };
    const auto one = reader(data.ofCells);
    askForFields(one, names);
    std::string warning;
    const auto whole =
      one->MakeSource(data.whole, data.bodies, warning, vtkRefractiveIndex::WITH_FIELDS);
    Ranks ranks(data.parts, data.ofCells);
    for (vtkRefractiveIndex* filter : ranks.Filters)
    {
      askForFields(filter, names);
    }
    // Pieces of a few layers of cells do not reach all that values of cells depend on.
    expectSameFields(*whole, *ranks.make(data.bodies, vtkRefractiveIndex::WITH_FIELDS),
      data.ofCells ? 1e-5 : 2e-7);
    EXPECT_EQ(ranks.make(data.bodies)->fields(), 0);
  }
}

// Blocks whose fields belong to points, while N belongs to cells.
TEST(FieldsOfPieces, OfBlocksMayBelongToPoints)
{
  const Case data = cases()[3];
  const auto one = reader(true);
  askForFields(one, { "warmth" });
  std::string warning;
  const auto whole = one->MakeSource(data.whole, nullptr, warning, vtkRefractiveIndex::WITH_FIELDS);
  Ranks ranks(data.parts, true);
  for (vtkRefractiveIndex* filter : ranks.Filters)
  {
    askForFields(filter, { "warmth" });
  }
  expectSameFields(*whole, *ranks.make(nullptr, vtkRefractiveIndex::WITH_FIELDS), 1e-12);
}

TEST(FieldsOfPieces, RanksMayLackOne)
{
  for (const std::size_t kind : { 0, 3 })
  {
    Case data = cases()[kind];
    const char* name = data.ofCells ? "warmth of cells" : "warmth";
    SCOPED_TRACE(data.name);
    const auto forget = [&](vtkDataObject* part)
    {
      auto* blocks = vtkMultiBlockDataSet::SafeDownCast(part);
      auto* set = vtkDataSet::SafeDownCast(blocks ? blocks->GetBlock(2) : part);
      set->GetAttributes(data.ofCells ? vtkDataObject::CELL : vtkDataObject::POINT)
        ->RemoveArray(name);
    };
    forget(data.parts[3]);
    Ranks ranks(data.parts, data.ofCells);
    for (vtkRefractiveIndex* filter : ranks.Filters)
    {
      askForFields(filter, { name });
    }
    if (kind == 0)
    {
      // Parts of one mesh have the same arrays, or something is wrong with the data.
      EXPECT_THROW(ranks.make(nullptr, vtkRefractiveIndex::WITH_FIELDS), std::runtime_error);
      continue;
    }
    const auto one = reader(data.ofCells);
    askForFields(one, { name });
    forget(data.whole);
    std::string warning;
    const auto whole =
      one->MakeSource(data.whole, data.bodies, warning, vtkRefractiveIndex::WITH_FIELDS);
    expectSameFields(*whole, *ranks.make(nullptr, vtkRefractiveIndex::WITH_FIELDS), 1e-6);
  }
}

TEST(FieldsOfPieces, ThatNoRankHasAreAMistake)
{
  for (const Case& data : cases())
  {
    Ranks ranks(data.parts, data.ofCells);
    for (vtkRefractiveIndex* filter : ranks.Filters)
    {
      askForFields(filter, { "warmth", "cold" });
    }
    try
    {
      ranks.make(data.bodies, vtkRefractiveIndex::WITH_FIELDS);
      FAIL() << data.name;
    }
    catch (const std::runtime_error& problem)
    {
      EXPECT_NE(std::string(problem.what()).find("'cold'"), std::string::npos) << problem.what();
    }
  }
}
