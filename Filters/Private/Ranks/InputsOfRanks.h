// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Ranks/Ranks.h"
#include "Ranks/SourceOverRanks.h"
#include "Sources/MeshCache.h"

#include "vtkSmartPointer.h"

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

class vtkAlgorithm;
class vtkDataObject;
class vtkInformationVector;

namespace schlieren
{
class MediumSource;
}

namespace filters
{

class MediumMaker;

/// The inputs of a filter on several ranks. Unless noted otherwise, rank 0 calls functions between
/// begin() and end() of its ranks; the others follow by answer().
class InputsOfRanks
{
public:
  FilterRanks& ranks() { return this->All; }

  /// Marks a rank without input after an error upstream, before begin().
  void lackInput() { this->LacksInput = true; }
  /// Calls FilterRanks::begin() on all ranks, in RequestData, with the inputs of this one. Throws
  /// errors upstream of any rank.
  bool begin(vtkAlgorithm* filter, vtkInformationVector** inputs, bool isWanted);

  /// Sets, on all ranks after begin(), this rank's inputs and maker of a medium.
  void setOwn(MediumMaker& maker, vtkDataObject* data, vtkDataObject* bodies);
  /// Clears what setOwn() has set, on all ranks before end().
  void forgetOwn();

  /// Sends the arrays of all ranks to all, so that all choose the same.
  void shareArrays();

  /// All inputs. Data of more than `maxCells` cells (images: 160 times as many) on several ranks
  /// stay there: `data` is then rank 0's piece.
  struct Inputs
  {
    vtkDataObject* data = nullptr;
    vtkDataObject* bodies = nullptr;
  };
  Inputs gather(double maxCells);
  /// Returns whether the data have stayed on several ranks.
  bool areInPieces() const { return this->InPieces; }
  /// Returns all of an input, of which rank 0 has `own`, after it has been gathered. At any time.
  vtkDataObject* gatheredOf(int port, vtkDataObject* own) const;

  /// Makes the source of data that stay on their ranks. `warning`: for the user.
  /// Throws std::runtime_error.
  std::shared_ptr<const schlieren::MediumSource> make(vtkDataObject* bodies, std::string& warning);
  /// Makes the ranks of this filter answer for a source, perhaps another filter's. Returns false if
  /// they cannot, and a new source is needed. Succeeds for sources that need no ranks.
  bool use(const schlieren::MediumSource* source);
  /// Drops the source on all ranks.
  void release();

  /// Answers a request on other ranks.
  std::vector<char> answer(const std::vector<char>& request);

private:
  void requestOfAll(const std::vector<char>& message);

  MediumMaker* Maker = nullptr; // between setOwn() and forgetOwn()
  FilterRanks All;
  bool LacksInput = false;
  std::array<vtkSmartPointer<vtkDataObject>, 2> Own;
  struct Located
  {
    double cells = 0;
    int kind = 0;
    bool isOnRank0 = true;
  };
  std::array<Located, 2> Places;                          // when the ranks last compared them
  std::array<vtkSmartPointer<vtkDataObject>, 2> Gathered; // null: rank 0 has all of it
  bool InPieces = false;
  double GatheredVersion = -1, GatheredMost = -1; // of the gathered data
  std::vector<std::string> GatheredArrays;
  MeshCache Cache;
  MadeOverRanks Made;
  std::shared_ptr<const SamplesOverRanks> Held; // on all ranks
};

} // namespace filters
