// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// The fields that tint an image of data on several ranks, against those of the same data on one.
#include "PieceCases.h"

#include "vtkMultiBlockDataSet.h"

#include <functional>
#include <limits>
#include <stdexcept>

namespace
{

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

} // namespace

TEST(FieldsOfPieces, AreThoseOfOnePiece)
{
  for (const PieceCase& data : cases())
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
  const PieceCase data = cases()[3];
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
    PieceCase data = cases()[kind];
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
  for (const PieceCase& data : cases())
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
