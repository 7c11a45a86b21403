// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Cells/CellTree.h"
#include "Common/Vectors.h"

#include "Schlieren.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace filters
{

class Reader;

/// Returns whether two boxes have a point in common.
bool meet(const schlieren::Box& a, const schlieren::Box& b);

/// A rank's piece of data, and the points that it answers for. Thread-safe.
class DataPiece
{
public:
  DataPiece() = default;
  DataPiece(const DataPiece&) = delete;
  DataPiece& operator=(const DataPiece&) = delete;
  virtual ~DataPiece() = default;

  /// Describes the whole piece.
  struct Summary
  {
    std::int64_t cells; ///< or points; 0: no gas
    schlieren::Box bounds;
    CellTree::Content content;
  };
  virtual Summary summary() const = 0;

  /// Returns a number that is equal for two pieces only if their boundaries are equal, apart from
  /// values; 0: unknown.
  virtual std::uint64_t meshKey() const { return 0; }

  /// Writes the boundary of its gas for a source of all ranks, preceded by its kind. `cellsOfAll`:
  /// number of cells of all pieces.
  enum class BoundaryKind : std::uint32_t
  {
    OfMesh, ///< see MeshPiece::putBoundary()
    OfImage ///< see ImagePiece::putBoundary()
  };
  virtual void putBoundary(std::int64_t cellsOfAll, std::vector<char>& message) const = 0;
  /// Writes the values at the boundary alone, for pieces with a meshKey().
  virtual void putBoundaryValues(std::vector<char>&) const {}

  /// Returns the content of a box; see CellTree::content().
  virtual CellTree::Content contentOf(const schlieren::Box& box) const = 0;

  /// Returns whether the piece has gas of its own at a point.
  virtual bool holds(const Point& place) const = 0;

  /// Return the number of further fields, and the range of one in a box; see MediumSource.
  virtual int fields() const { return 0; }
  virtual schlieren::MediumSource::FieldRange rangeOfField(
    int /*field*/, const schlieren::Box& /*box*/) const
  {
    return { 1, 0 };
  }

  /// N at the lattice points that the piece contains, and fields, field after field, NaN where one
  /// has no value. `found`: empty if it contains no point.
  struct Samples
  {
    std::vector<unsigned char> found;
    std::vector<double> values;
    std::vector<double> fields{};

    /// Adds the samples of another piece; of points in both, these have priority.
    void Add(Samples other);

    void Put(std::vector<char>& message) const;
    /// Reads what Put() has written for so many points and fields; else throws std::runtime_error.
    static Samples Get(Reader& message, std::size_t points, std::size_t fields);
  };
  virtual Samples sample(const schlieren::Lattice& lattice) const = 0;
};

} // namespace filters
