// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Ranks/Ranks.h"
#include "Ranks/SourceOverRanks.h"

#include "vtkSmartPointer.h"

#include <array>
#include <cstdint>
#include <functional>
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

/// The inputs of a filter on several ranks. Where nothing is said, functions are for rank 0 between begin() and end() of its ranks; the others follow by answer().
class InputsOfRanks
{
public:
  FilterRanks& ranks() { return this->All; }

  /// On a rank where something upstream has failed, before begin().
  void lackInput() { this->LacksInput = true; }
  /// On all ranks, in RequestData: FilterRanks::begin(), with what this rank has of the inputs. Throws what has gone wrong
  /// upstream of any rank.
  bool begin(vtkAlgorithm* filter, vtkInformationVector** inputs, bool isWanted,
    const std::string& problem = "");

  /// On all ranks, after begin(): what this one has, and what makes a medium of it. `dataAt`: what it has of the data at an instant between time steps; may be
  /// empty, and throw std::runtime_error.
  using DataAt = std::function<vtkSmartPointer<vtkDataObject>(int instant)>;
  void setOwn(MediumMaker& maker, vtkDataObject* data, vtkDataObject* bodies, DataAt dataAt = {});
  /// On all ranks, before end().
  void forgetOwn();

  /// Where an array is to be chosen: all ranks learn of all arrays, so that all choose the same.
  void shareArrays();

  /// All of the inputs; data of more cells than `maxCells` (of images 160 times as many) that several ranks have stay where they
  /// are: `data` is what rank 0 has of them.
  struct Inputs
  {
    vtkDataObject* data = nullptr;
    vtkDataObject* bodies = nullptr;
  };
  Inputs gather(double maxCells);
  /// Whether the data have stayed on several ranks.
  bool areInPieces() const { return this->InPieces; }
  /// At any time: all of an input of which this is what rank 0 has, after it has been gathered.
  vtkDataObject* gatheredOf(int port, vtkDataObject* own) const;

  /// Makes the source of data that have stayed. `instant`: see setOwn(); -1: none. `warning`: see MediumMaker::makeSource().
  /// Throws std::runtime_error.
  std::shared_ptr<const schlieren::MediumSource> make(
    vtkDataObject* bodies, bool hasFields, int instant, std::string& warning);
  /// Makes the ranks of this filter answer for a source, which may be another filter's. False where they cannot: then it has
  /// to be made anew. Sources that need no ranks always can.
  bool use(const schlieren::MediumSource* source);
  /// On all ranks: forgets what it has of a source.
  void release();

  /// On other ranks.
  std::vector<char> answer(const std::vector<char>& request);

private:
  void requestOfAll(const std::vector<char>& message);
  void answerArrays();

  MediumMaker* Maker = nullptr; // between setOwn() and forgetOwn()
  FilterRanks All;
  bool LacksInput = false;
  std::array<vtkSmartPointer<vtkDataObject>, 2> Own;
  DataAt OwnAt;
  struct Located
  {
    double cells = 0;
    int kind = 0;
    bool isOnRank0 = true;
  };
  std::array<Located, 2> Places;                          // as the ranks have found them last
  std::array<vtkSmartPointer<vtkDataObject>, 2> Gathered; // null: rank 0 has all of it
  bool InPieces = false;
  double GatheredVersion = -1, GatheredMost = -1; // of what has been gathered
  std::vector<std::string> GatheredArrays;
  KeptOverRanks Kept;
  MadeOverRanks Made;
  std::shared_ptr<const SamplesOverRanks> Held; // on all ranks
};

} // namespace filters
