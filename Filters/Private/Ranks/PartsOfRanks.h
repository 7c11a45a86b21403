// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Input/DataParts.h"
#include "Ranks/Ranks.h"

#include "vtkSmartPointer.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

class vtkDataObject;
class vtkDataSet;

namespace filters
{

/// Where the datasets of an input lie: what each rank has of them. Datasets that several ranks have in full count once. All
/// ranks call all functions that are not const.
class PartsOfRanks
{
public:
  using Extent = std::array<int, 6>;

  /// Of `own`, which may be null, those arrays that are named. Throws std::runtime_error, as all functions.
  PartsOfRanks(const Ranks& ranks, vtkDataObject* own, const std::vector<std::string>& arrays);

  double cells() const;
  bool areOnRank0() const;
  /// What data that are not gathered can be, in three dimensions.
  enum class Kind
  {
    Gathered, // none of these: adaptive blocks, surfaces, planes
    Meshes,
    Image
  };
  Kind kind() const;

  /// On rank 0 all data, as few datasets as can be; null where it has all anyway, and on other ranks.
  vtkSmartPointer<vtkDataObject> gather();

  /// What one rank has of a dataset, with cells of other ranks around it, which are marked as copies (DUPLICATECELL).
  struct Piece
  {
    vtkSmartPointer<vtkDataSet> data;
    std::uint32_t dataset; ///< the same on all ranks
    Extent own, whole;     ///< of points of an image or grid: without the copies, and of all ranks
  };
  /// By vtkGhostCellsGenerator. Cells of different datasets are no neighbours.
  std::vector<Piece> withGhostCells();

private:
  struct Facts;
  static Facts factsOf(const Part& part);
  void findDatasets(const std::vector<std::vector<Facts>>& all);

  const Ranks& All;
  std::vector<Part> Own;
  /// What is the same of a dataset on all ranks.
  struct Dataset
  {
    Slot slot;
    int type = -1; ///< of VTK; -1: several
    int dimension = 0;
    int layers = 0; ///< of cells around a piece that values in it depend on
    int thinnest = std::numeric_limits<int>::max(); ///< of grids, cells along any edge of a part
    std::vector<Extent> extents{};                  ///< of the parts, in the order of ranks
    double cells = 0;
    Extent whole{};
    std::vector<std::size_t> ranks{}; ///< that have a part of it
  };
  std::vector<Dataset> Datasets;
  bool IsAmr = false;
};

} // namespace filters
