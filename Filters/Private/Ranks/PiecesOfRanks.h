// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Input/DatasetPieces.h"
#include "Ranks/GhostCells.h"
#include "Ranks/PieceFacts.h"
#include "Ranks/Ranks.h"

#include "vtkSmartPointer.h"

#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

class vtkDataObject;
class vtkDataSet;

namespace filters
{

/// Finds the datasets of an input on all ranks. Datasets that several ranks have completely count
/// once. All ranks call all functions that are not const.
class PiecesOfRanks
{
public:
  /// Describes the named arrays of `own`, which may be null. `ofWedge`: a point of the axis of
  /// wedges that are to be gathered. Throws std::runtime_error, as all functions do.
  PiecesOfRanks(const Ranks& ranks, vtkDataObject* own, const std::vector<std::string>& arrays,
    const std::optional<std::array<double, 3>>& ofWedge = {});

  double cells() const;
  bool areOnRank0() const;
  /// Kinds of three-dimensional data that need not be gathered.
  enum class Kind
  {
    Gathered, // others: adaptive blocks, surfaces, planes, data that are one cell thick, wedges,
              // datasets that meet others on other ranks or themselves (O-grids)
    Meshes,
    Image
  };
  Kind kind() const;

  /// Returns all data on rank 0, in as few datasets as possible; null on others, or if rank 0 has
  /// them.
  vtkSmartPointer<vtkDataObject> gather();

  /// A rank's cells of a dataset, surrounded by copies of other ranks' cells (DUPLICATECELL).
  struct Piece
  {
    vtkSmartPointer<vtkDataSet> data;
    PointExtent own, whole; ///< points of an image or grid, without copies, and on all ranks
  };
  /// Adds ghost cells. Different datasets are not neighbours.
  std::vector<Piece> withGhostCells();

private:
  void findDatasets(const std::vector<std::vector<PieceFacts>>& all);

  const Ranks& All;
  std::vector<DatasetPiece> Own;
  /// The description of a dataset, equal on all ranks.
  struct Dataset
  {
    Slot slot;
    int type = -1; ///< VTK's type; -1: several
    int dimension = 0;
    int layers = 0; ///< cells around a piece that its values depend on
    int thinnest = std::numeric_limits<int>::max(); ///< cells along any edge of a grid's pieces
    std::vector<PointExtent> extents{};             ///< pieces, in the order of ranks
    double cells = 0;
    PointExtent whole{};
    std::array<double, 6> bounds{};
    std::vector<std::size_t> ranks{}; ///< that have a piece
  };
  bool meetsOthers(const Dataset& dataset) const;
  bool meetsItself(const Dataset& dataset) const;
  vtkSmartPointer<vtkDataSet> ownOf(const Dataset& dataset) const;

  std::vector<Dataset> Datasets;
  bool IsAmr = false, IsOneLayer = false, HasSeams = false;
};

} // namespace filters
