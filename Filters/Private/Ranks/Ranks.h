// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Schlieren.h"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

class vtkInformation;
class vtkInformationVector;
class vtkAlgorithm;
class vtkMultiProcessController;

namespace filters
{

/// False on the other MPI processes of ParaView where there are several: rank 0 makes what there is one of, the
/// others leave it empty.
bool isRank0();

/// Whether there are other ranks.
bool hasOtherRanks();

/// In RequestData, where there are several ranks: says that the outputs are all that will be made of their whole
/// extents. Otherwise, a rank that made nothing would run again, alone, at each update, and with it what is
/// upstream: filters that wait for the other ranks would wait forever.
void setComplete(vtkInformationVector* outputs);

/// In RequestUpdateExtent: each rank requests its piece of all inputs.
void requestPieces(vtkAlgorithm* filter, vtkInformationVector** inputs);
/// The same of one input.
void requestPiece(vtkInformation* inInfo);

/**
 * The ranks of VTK's controller, or this process alone. All call the same functions in the same order, and each waits there
 * for the others, however long that takes.
 *
 * What a rank throws while it works for one of them takes the place of what it would have given, and all ranks throw it:
 * std::runtime_error with the message of the first of them, or ArraysMissing where that is what all of them say.
 */
class Ranks
{
public:
  Ranks();

  std::size_t count() const;
  std::size_t rank() const;

  using Bytes = std::vector<char>;
  /// What each rank makes, on all of them.
  std::vector<Bytes> allGather(const std::function<Bytes()>& make) const;
  /// The same without anything to be given: where one rank fails, all do.
  void agree(const std::function<void()>& work) const;
  /// On `root` what each rank gives, on others nothing. It cannot fail.
  std::vector<Bytes> gather(const Bytes& own, std::size_t root) const;
  /// From rank 0 to all. It cannot fail.
  void broadcast(Bytes& bytes) const;

private:
  vtkMultiProcessController* Controller; // null: there are no others
};

/// The result of some work, or what it has thrown, as bytes; and the results of all ranks, or what they have thrown.
Ranks::Bytes attempted(const std::function<Ranks::Bytes()>& make);
std::vector<Ranks::Bytes> resultsOf(std::vector<Ranks::Bytes> attempts);

/// The ranks of one filter. Rank 0 decides what is done, and the others do what it requests: from begin() until rank 0 calls
/// end(), both of which all ranks call in each update.
class FilterRanks : public schlieren::Processes
{
public:
  FilterRanks();

  const Ranks& all() const { return this->All; }
  bool areSeveral() const { return this->All.count() > 1; }

  /// All ranks begin. `description`: of what this rank has, where something upstream has changed another one. `problem`: why
  /// this rank cannot take part; mostly empty. Throws std::runtime_error where any rank cannot. False, on all ranks, where rank
  /// 0 does not want to.
  bool begin(
    const std::vector<double>& description, const std::string& problem = "", bool isWanted = true);
  /// All ranks begin with the inputs that they have had.
  void resume() { this->IsAtWork = this->areSeveral(); }
  /// On rank 0: a number that changes when any rank's description does.
  double version() const { return this->Version; }

  int others() const override { return static_cast<int>(this->All.count()) - 1; }
  /// On rank 0 between begin() and end(). What any rank throws is thrown here, see Ranks.
  std::vector<std::vector<char>> request(
    const std::vector<char>& message, const std::function<void()>& meanwhile) override;
  bool isAtWork() const { return this->IsAtWork; }

  /// On other ranks, until rank 0 ends it: answers its requests, those for a RayWorker itself. Returns what rank 0 says.
  struct Outcome
  {
    bool hasMore, hasImage;
  };
  using Answer = std::function<std::vector<char>(const std::vector<char>& request)>;
  Outcome serve(int threads, const Answer& answer);
  /// On rank 0.
  void end(const Outcome& outcome);

private:
  Ranks All;
  schlieren::RayWorker Worker;
  std::vector<Ranks::Bytes> Descriptions;
  double Version = 0;
  bool IsAtWork = false;
};

} // namespace filters
