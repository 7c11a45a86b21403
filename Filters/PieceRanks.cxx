// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "PieceRanks.h"

#include "PieceWorker.h"

#include <stdexcept>
#include <string>

namespace filters
{

Reader readerOf(const std::vector<char>& answer)
{
  Reader reader(answer);
  const auto kind = reader.Get<PieceWorker::Kind>();
  const auto state = reader.Get<PieceWorker::State>();
  if (kind == PieceWorker::Answer && state == PieceWorker::Lacking)
  {
    throw ArraysMissing(reader.GetAll<std::string>());
  }
  if (kind != PieceWorker::Answer || state != PieceWorker::Done)
  {
    throw std::runtime_error(reader.GetAll<std::string>());
  }
  return reader;
}

std::deque<Reader> readersOf(const std::vector<std::vector<char>>& answers)
{
  std::deque<Reader> readers;
  for (const std::vector<char>& answer : answers)
  {
    readers.push_back(answer.empty() ? Reader(answer) : readerOf(answer));
  }
  return readers;
}

} // namespace filters
