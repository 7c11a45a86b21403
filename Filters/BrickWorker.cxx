// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "BrickWorker.h"

#include "DataParts.h"
#include "ForEach.h"

#include <stdexcept>
#include <utility>

namespace filters
{

void BrickWorker::begin(std::uint64_t number, Reader& request)
{
  this->Number = number;
  const auto mesh = request.Get<std::uint64_t>();
  const auto rules = request.Get<schlieren::BrickRules>();
  const auto facts = request.Get<SamplesOfPieces::Facts>();
  auto ranges = request.GetAll<std::vector<schlieren::MediumSource::FieldRange>>();
  this->Makers = {};
  this->Known.reset();
  KeptOfMesh::OfBricks kept = this->Kept->bricks();
  if (mesh != 0 && mesh == kept.number)
  {
    kept.lattices = kept.lattices ? kept.lattices : std::make_shared<LatticesOfMesh>();
    kept.lattices->beginStep();
  }
  else
  {
    kept = { mesh, std::make_shared<const GasBoundary>(request), nullptr };
  }
  this->Kept->keep(kept);
  this->Known =
    std::make_unique<SamplesOfPieces>(facts, std::move(ranges), kept.boundary, kept.lattices);
  if (rules.bytesOfReal == sizeof(float))
  {
    std::get<Maker<float>>(this->Makers) =
      std::make_unique<schlieren::BrickMaker<float>>(*this->Known, rules);
  }
  else
  {
    std::get<Maker<double>>(this->Makers) =
      std::make_unique<schlieren::BrickMaker<double>>(*this->Known, rules);
  }
}

void BrickWorker::make(std::uint64_t number, Reader& request, const DataPiece* own, int threads,
  std::vector<char>& answer)
{
  if (!this->Known || number != this->Number)
  {
    throw std::runtime_error(
      "A rank does not have what it needs to make the medium any more. Update the filter again.");
  }
  this->Known->forgetBoxes();
  this->Known->forgetLattices();
  std::vector<TaskOfPieces> tasks;
  std::vector<std::vector<std::vector<char>>> ofOthers;
  while (!request.IsAtEnd())
  {
    const TaskOfPieces& task = tasks.emplace_back(request.Get<TaskOfPieces>());
    this->Known->box(task.task.box) = { task.task.content,
      request.GetAll<std::vector<schlieren::MediumSource::FieldRange>>() };
    ofOthers.emplace_back();
    for (std::uint32_t other = 0; other < task.others; ++other)
    {
      ofOthers.back().push_back(request.GetAll<std::vector<char>>());
    }
    this->Known->samples(task.task.lattice); // so that threads need not make it
  }
  std::get<Maker<float>>(this->Makers)
    ? this->makeOf<float>(tasks, ofOthers, own, threads, answer)
    : this->makeOf<double>(tasks, ofOthers, own, threads, answer);
}

template <class Real>
void BrickWorker::makeOf(const std::vector<TaskOfPieces>& tasks,
  const std::vector<std::vector<std::vector<char>>>& ofOthers, const DataPiece* own, int threads,
  std::vector<char>& answer)
{
  const schlieren::BrickMaker<Real>& maker = *std::get<Maker<Real>>(this->Makers);
  std::vector<std::vector<char>> bricks(tasks.size());
  forEach(tasks.size(), threads,
    [&](std::size_t n)
    {
      const TaskOfPieces& task = tasks[n];
      const schlieren::Lattice& lattice = task.task.lattice;
      DataPiece::Samples& samples = this->Known->samples(lattice);
      for (std::uint32_t other = 0; other <= task.others; ++other)
      {
        if (other == task.othersBefore && task.hasOwn != 0 && own)
        {
          samples.Add(own->sample(lattice));
        }
        if (other < task.others)
        {
          Reader reader(ofOthers[n][other]);
          samples.Add(DataPiece::Samples::Get(reader, static_cast<std::size_t>(lattice.size()),
            this->Known->rangesOfFields().size()));
        }
      }
      try
      {
        bricks[n] = maker.make(task.task.request.place, task.task.request.negligible).toBytes();
      }
      catch (const NotSampled&)
      {
        // Rank 0 has all of the data, and makes it.
      }
      samples = {};
    });
  for (const std::vector<char>& brick : bricks)
  {
    putAll(brick, answer);
  }
}

} // namespace filters
