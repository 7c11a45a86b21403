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

/// What one rank has of data that are spread over several: the places that it answers for. Its functions may be called from
/// several threads.
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

  /// A number that two pieces have in common only if their boundaries are the same, but for the values there; 0: of this one it
  /// is not known.
  virtual std::uint64_t meshKey() const { return 0; }

  /// Adds to a message where its gas ends, for a source of all ranks: what kind of boundary, and that.
  /// `cellsOfAll`: how many cells there are in all pieces.
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

  /// N at the points of a lattice that it holds, and the fields there: field after field, NaN where one has no value. `found` is
  /// empty where no point is.
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
