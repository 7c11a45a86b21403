// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "HeldPiece.h"

#include <iterator>
#include <map>
#include <mutex>

namespace filters
{

namespace
{

struct Pieces
{
  std::mutex one;
  std::map<PieceName, std::weak_ptr<HeldPiece>> all;
};

/// Never deleted: when the program exits, filters may be deleted after static objects.
Pieces& pieces()
{
  static auto& ofProcess = *new Pieces;
  return ofProcess;
}

} // namespace

void addPiece(const std::shared_ptr<HeldPiece>& piece)
{
  const std::lock_guard<std::mutex> lock(pieces().one);
  auto& all = pieces().all;
  for (auto entry = all.begin(); entry != all.end();)
  {
    entry = entry->second.expired() ? all.erase(entry) : std::next(entry);
  }
  all[piece->name] = piece;
}

std::shared_ptr<HeldPiece> findPiece(const PieceName& name)
{
  const std::lock_guard<std::mutex> lock(pieces().one);
  const auto found = pieces().all.find(name);
  return found != pieces().all.end() ? found->second.lock() : nullptr;
}

} // namespace filters
