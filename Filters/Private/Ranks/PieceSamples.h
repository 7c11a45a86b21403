// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Common/Message.h"
#include "Sources/DataPiece.h"

#include "Schlieren.h"

#include <cstddef>
#include <vector>

namespace filters
{

/// N at the points of a lattice that a rank's piece holds. `found`: empty if it holds no point.
struct PieceSamples
{
  std::vector<unsigned char> found;
  std::vector<double> values;

  static PieceSamples Of(const DataPiece& piece, const schlieren::Lattice& lattice);

  /// Adds the samples of another piece; of points in both, these have priority.
  void Add(PieceSamples other);

  void Put(std::vector<char>& message) const;
  /// Reads what Put() has written for so many points; else throws std::runtime_error.
  static PieceSamples Get(Reader& message, std::size_t points);
};

} // namespace filters
