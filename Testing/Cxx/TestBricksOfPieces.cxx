// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// Bricks that several ranks make, against those that rank 0 makes alone.
#include "PieceCases.h"
#include "SameTree.h"

#include "Medium/BrickMakers.h"

#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace
{

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
  settings.tolerance = 1e-2;
  settings.threads = 2;
  schlieren::MediumTree<Real> tree(std::move(source), ambient, settings);
  tree.refine({ { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0 }, { 2, 2 }, 0.02 });
  return tree;
}

bool keepsMesh(const PieceCase& data) { return std::string(data.name).rfind("mesh", 0) == 0; }

} // namespace

// Each rank makes some, of meshes in three steps, for which they keep what they know of lattices; every other with fields.
TEST(BricksOfPieces, AreTheSameWhoeverMakesThem)
{
  bool hasFields = false;
  for (const PieceCase& data : cases())
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
    for (int step = 0; step < (keepsMesh(data) ? 3 : 1); ++step)
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
    if (hasFields)
    {
      const auto source = make();
      expectIdentical(
        treeOf<double>(source), treeOf<double>(std::make_shared<WithoutMakers>(source)));
    }
  }
}

// Rank 0 has all of the data. With walls, a front, which needs more samples, and fields.
TEST(BricksOfOneRank, AreTheSameWhoeverMakesThem)
{
  std::vector<PieceCase> wholes = cases();
  wholes.push_back({ "front", meshOf({ 0, 40, 0, 40, 0, 40 }), {}, false, wholes[2].bodies });
  addPointArray(vtkDataSet::SafeDownCast(wholes.back().whole), "N",
    [](const Vec& x) { return ball(x) + (x[0] + 0.8 * x[1] + 0.6 * x[2] > 1.5 ? 1e-4 : 0); });
  bool hasFields = true;
  for (const PieceCase& data : wholes)
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
    first->SetHelp(true);
    ASSERT_NE(source->makers(), nullptr);
    expectIdentical(treeOf<float>(source), alone);
    for (const auto& channel : ranks.Channels)
    {
      EXPECT_GT(channel->Bytes, 100000u);
    }
    for (int step = 0; step < (keepsMesh(data) ? 2 : 0); ++step)
    {
      expectIdentical(treeOf<float>(make()), alone);
    }
    if (hasFields)
    {
      continue;
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
  const PieceCase data = cases()[0];
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
  const PieceCase data = cases()[0];
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
