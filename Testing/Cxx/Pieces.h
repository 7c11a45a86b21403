// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Data whose pieces are on several ranks, which are filters of one process.
#pragma once

#include "Fixtures.h"

#include "Medium/MediumSource.h"
#include "Rays/Channel.h"

#include "vtkDataObject.h"
#include "vtkRefractiveIndex.h"
#include "vtkSmartPointer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <deque>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

using Data = vtkSmartPointer<vtkDataObject>;

inline double ball(const Vec& x) { return 1e-4 * (1 + std::exp(-dot(x, x) / 0.16)); }

inline vtkSmartPointer<vtkRefractiveIndex> reader(bool ofCells)
{
  auto filter = vtkSmartPointer<vtkRefractiveIndex>::New();
  filter->SetIndexModel(vtkRefractiveIndex::REFRACTIVITY);
  filter->SetInputArrayToProcess(vtkRefractiveIndex::INDEX_ARRAY, 0, 0,
    ofCells ? vtkDataObject::FIELD_ASSOCIATION_CELLS : vtkDataObject::FIELD_ASSOCIATION_POINTS,
    ofCells ? "N of cells" : "N");
  filter->SetNumberOfThreads(2);
  return filter;
}

/// To a rank in this process.
class LocalChannel : public schlieren::Channel
{
public:
  explicit LocalChannel(vtkRefractiveIndex* rank)
    : Rank(rank)
  {
  }
  void send(std::vector<char> message) override
  {
    this->Bytes += message.size();
    this->Messages.push_back({ 'r', 'a', 'y', 's' }); // that nobody waits for any more
    this->Messages.push_back(this->Rank->RespondForPiece(message));
    this->Bytes += this->Messages.back().size();
    this->IsOpen = this->AnswersLeft-- > 1;
    if (!this->IsOpen)
    {
      this->Messages.clear();
    }
  }
  bool hasMessage() override { return !this->Messages.empty(); }
  std::vector<char> receive() override
  {
    std::vector<char> message = std::move(this->Messages.front());
    this->Messages.pop_front();
    return message;
  }
  bool isOpen() const override { return this->IsOpen; }

  std::size_t Bytes = 0;
  int AnswersLeft = 1 << 30;

private:
  vtkRefractiveIndex* Rank;
  std::deque<std::vector<char>> Messages;
  bool IsOpen = true;
};

/// Filters as ranks, each with its part of the data; null: none.
struct Ranks
{
  explicit Ranks(const std::vector<Data>& parts, bool ofCells = false)
    : Parts(parts)
  {
    std::vector<schlieren::Channel*> channels;
    for (std::size_t rank = 0; rank < parts.size(); ++rank)
    {
      this->Filters.push_back(reader(ofCells));
      if (rank > 0)
      {
        this->Filters[rank]->SetPieceData(parts[rank]);
        this->Channels.push_back(std::make_unique<LocalChannel>(this->Filters[rank]));
        channels.push_back(this->Channels.back().get());
      }
    }
    this->Filters[0]->SetPieceChannels(channels);
  }
  std::shared_ptr<const schlieren::MediumSource> make(vtkDataObject* bodies = nullptr,
    vtkRefractiveIndex::SourceContents contents = vtkRefractiveIndex::REFRACTIVITY_ALONE)
  {
    return this->Filters[0]->MakeSourceOfPieces(this->Parts[0], bodies, this->Warning, contents);
  }

  std::vector<Data> Parts;
  std::vector<vtkSmartPointer<vtkRefractiveIndex>> Filters;
  std::vector<std::unique_ptr<LocalChannel>> Channels;
  std::string Warning;
};

inline std::shared_ptr<const schlieren::MediumSource> inOnePiece(
  vtkDataObject* data, bool ofCells = false, vtkDataObject* bodies = nullptr)
{
  std::string warning;
  // It keeps what it needs of the filter.
  return reader(ofCells)->MakeSource(data, bodies, warning);
}

/// Numbers of single precision count from a value that each piece has for itself.
constexpr double roundingOfPieces = 1e-11;

/// `tolerance`: of N, of its range: mean error.
inline void expectSame(const schlieren::MediumSource& whole, const schlieren::MediumSource& pieces,
  double tolerance = 2e-7)
{
  ASSERT_TRUE(pieces.isRemote());
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    EXPECT_DOUBLE_EQ(whole.bounds().low[axis], pieces.bounds().low[axis]);
    EXPECT_DOUBLE_EQ(whole.bounds().high[axis], pieces.bounds().high[axis]);
    EXPECT_NEAR(whole.voxelShape()[axis], pieces.voxelShape()[axis], 1e-12);
  }
  EXPECT_NEAR(whole.ambient(), pieces.ambient(), roundingOfPieces);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> place(-1.2, 1);
  std::vector<schlieren::Box> boxes{ { { -0.3, -0.3, -0.3 }, { 0.3, 0.3, 0.3 } } };
  std::vector<schlieren::Lattice> lattices{ { { -0.3, -0.3, -0.3 }, { 0.03, 0.03, 0.03 },
    { 20, 20, 20 } } };
  for (int i = 0; i < 40; ++i)
  {
    const Vec low = { place(random), place(random), place(random) };
    const double size = 0.02 * (1 + i);
    boxes.push_back({ low, { low[0] + size, low[1] + size, low[2] + size } });
    lattices.push_back({ low, { size / 8, size / 8, size / 8 }, { 9, 9, 9 } });
  }
  double worst = 0, squares = 0;
  int count = 0;
  for (const schlieren::MediumSource* one : { &whole, &pieces })
  {
    one->prepareContents(boxes);
    one->prepareSamples(lattices);
  }
  for (std::size_t n = 0; n < boxes.size(); ++n)
  {
    const auto a = whole.contentOf(boxes[n]), b = pieces.contentOf(boxes[n]);
    EXPECT_EQ(a.hasGas, b.hasGas);
    EXPECT_EQ(a.hasWall, b.hasWall);
    EXPECT_EQ(a.hasWindow, b.hasWindow);
    const auto points = static_cast<std::size_t>(lattices[n].size());
    std::array<std::vector<double>, 2> values;
    std::array<std::vector<schlieren::Place>, 2> places;
    std::array<std::vector<float>, 2> distances;
    for (std::size_t k = 0; k < 2; ++k)
    {
      values[k].resize(points);
      places[k].resize(points);
      distances[k].resize(points);
      (k == 0 ? whole : pieces)
        .sample(lattices[n], values[k].data(), places[k].data(), distances[k].data());
    }
    EXPECT_EQ(places[0], places[1]);
    for (std::size_t i = 0; i < points; ++i)
    {
      ASSERT_NEAR(distances[0][i], distances[1][i], 1e-5);
      if (places[0][i] == schlieren::Place::Gas)
      {
        const double difference = std::abs(values[0][i] - values[1][i]) / 1e-4;
        worst = std::max(worst, difference);
        squares += difference * difference;
        ++count;
        // A spline may be beyond its points' values.
        EXPECT_LE(b.lowest, std::max(values[1][i], a.lowest) + roundingOfPieces);
        EXPECT_GE(b.highest, std::min(values[1][i], a.highest) - roundingOfPieces);
      }
    }
  }
  EXPECT_GT(count, 1000);
  // Of the cells beside a point on a face another one may count, whose value differs by the error of reconstruction.
  EXPECT_LT(worst, 1e2 * tolerance);
  EXPECT_LT(std::sqrt(squares / count), tolerance);
}

/// The ranges of values in boxes, to the last bit: so trees are divided in the same way.
inline void expectSameContents(
  const schlieren::MediumSource& whole, const schlieren::MediumSource& pieces)
{
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(-1, 0.8);
  std::vector<schlieren::Box> boxes;
  for (int i = 0; i < 60; ++i)
  {
    const Vec low{ place(random), place(random), place(random) };
    const double size = 0.01 * (1 + i);
    boxes.push_back({ low, { low[0] + size, low[1] + size, low[2] + size } });
  }
  pieces.prepareContents(boxes);
  for (const schlieren::Box& box : boxes)
  {
    const auto a = whole.contentOf(box), b = pieces.contentOf(box);
    if (a.hasGas)
    {
      EXPECT_NEAR(a.lowest, b.lowest, roundingOfPieces);
      EXPECT_NEAR(a.highest, b.highest, roundingOfPieces);
      EXPECT_EQ(a.cellSize, b.cellSize);
    }
  }
}
