// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Common/Message.h"

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

/// Returns false on all but one of several MPI processes: rank 0 makes outputs that exist once, the
/// others leave them empty.
bool isRank0();

bool hasOtherRanks();

/// Declares, in RequestData, outputs complete for their whole extents. Otherwise, ranks with empty
/// outputs would update upstream filters alone, which would wait for other ranks forever.
void setComplete(vtkInformationVector* outputs);

/// Requests this rank's piece of all inputs, in RequestUpdateExtent.
void requestPieces(vtkAlgorithm* filter, vtkInformationVector** inputs);
/// Requests this rank's piece of an input.
void requestPiece(vtkInformation* inInfo);

/**
 * The ranks of VTK's controller, or this process alone. All call the same functions in the same
 * order and wait for each other.
 *
 * If work throws on a rank, all ranks throw: std::runtime_error with the message of the first one,
 * or ArraysMissing if that is the only kind of error.
 */
class Ranks
{
public:
  Ranks();

  std::size_t count() const;
  std::size_t rank() const;

  using Bytes = std::vector<char>;
  /// Collects the results of all ranks on all ranks.
  std::vector<Bytes> allGather(const std::function<Bytes()>& make) const;
  /// Reads the results of all ranks, in turn, on all ranks.
  void allGather(
    const std::function<Bytes()>& make, const std::function<void(Reader&)>& read) const;
  /// Throws on all ranks if `work` throws on one.
  void agree(const std::function<void()>& work) const;
  /// Returns the data of all ranks on `root`, nothing on others. Does not fail.
  std::vector<Bytes> gather(const Bytes& own, std::size_t root) const;
  /// Copies data from rank 0 to all. Does not fail.
  void broadcast(Bytes& bytes) const;

private:
  vtkMultiProcessController* Controller; // null: no others
};

/// Convert the result or exception of `make` to bytes, and those of all ranks back.
Ranks::Bytes attempted(const std::function<Ranks::Bytes()>& make);
std::vector<Ranks::Bytes> resultsOf(std::vector<Ranks::Bytes> attempts);

/// The ranks of a filter. Rank 0 requests work of the others, from begin() to end(), which all
/// ranks call in each update.
class FilterRanks : public schlieren::Processes
{
public:
  FilterRanks();

  const Ranks& all() const { return this->All; }
  bool areSeveral() const { return this->All.count() > 1; }

  /// Begins on all ranks. `description`: of this rank's inputs; it differs after changes upstream.
  /// `problem`: why this rank cannot work; mostly empty. Throws std::runtime_error if any rank
  /// cannot. Returns false on all ranks if rank 0 does not want to.
  bool begin(
    const std::vector<double>& description, const std::string& problem = "", bool isWanted = true);
  /// Begins on all ranks with the same inputs.
  void resume() { this->IsAtWork = this->areSeveral(); }
  /// Returns a number on rank 0 that changes with any rank's description.
  double version() const { return this->Version; }

  int others() const override { return static_cast<int>(this->All.count()) - 1; }
  /// Requests work, on rank 0 between begin() and end(). Throws errors of all ranks, see Ranks.
  std::vector<std::vector<char>> request(
    const std::vector<char>& message, const std::function<void()>& meanwhile) override;

  /// Answers requests on other ranks, also for a RayWorker, until rank 0 ends with an outcome.
  struct Outcome
  {
    bool hasMore, hasImage;
  };
  using Answer = std::function<std::vector<char>(const std::vector<char>& request)>;
  Outcome serve(int threads, const Answer& answer);
  /// Ends the work, on rank 0.
  void end(const Outcome& outcome);

private:
  Ranks All;
  schlieren::RayWorker Worker;
  std::vector<Ranks::Bytes> Descriptions;
  double Version = 0;
  bool IsAtWork = false;
};

} // namespace filters
