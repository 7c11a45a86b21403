// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "UpstreamFailure.h"

#include "vtkSmartPointer.h"
#include "vtkTimeStamp.h"

#include "Rays/Channel.h"

#include <array>
#include <chrono>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

class vtkAlgorithm;
class vtkDataObject;
class vtkInformation;
class vtkInformationVector;

namespace filters
{

namespace ranks
{
struct InputsOfRank;
class RankChannel;
} // namespace ranks

/// False on the other MPI processes of ParaView where there are several: rank 0 makes what there is one of, the
/// others leave it empty.
bool isRank0();

/// Whether there are other ranks.
bool hasOtherRanks();

/// On rank 0: whether there are other ranks, and cores that so many threads of rank 0 do not use: where all ranks are on one
/// machine, they would only take them from each other.
bool haveOthersCores(int threads);

/// In RequestData, where there are several ranks: says that the outputs are all that will be made of their whole
/// extents. Otherwise, a rank that made nothing would run again, alone, at each update, and with it what is
/// upstream: filters that wait for the other ranks would wait forever.
void setComplete(vtkInformationVector* outputs);

/// The ranks of a filter, which works on rank 0 with the help of the others: these send it the data that they have of
/// the inputs, and trace rays for it. Every rank calls all functions where VTK lets it. No rank waits for another for
/// long before all have met, so that nothing hangs where a rank does not run: its source has failed, or its output is
/// up to date. After that none waits but for work.
class FilterRanks
{
public:
  FilterRanks();
  ~FilterRanks();

  /// In ProcessRequest. REQUEST_DATA_OBJECT comes before anything that reads files and so can fail on one rank alone: counts
  /// the changes of properties upstream, the same on all ranks. From there until REQUEST_DATA, what fails upstream is
  /// reported to the ranks that would wait for this one.
  void Note(vtkAlgorithm* filter, vtkInformation* request);

  /// Which part of the inputs a rank requests.
  enum class Part
  {
    All, // on rank 0, and nothing on others
    Piece // of meshes and images: each rank one of as many as there are; of bodies and other data, as All
  };
  /// In RequestUpdateExtent. Whether the inputs have changed since the last request, or their time step has. In place of
  /// pieces, all is requested where no more than `maxCells` are known to have been found too few: see SetTooFew().
  bool Request(vtkAlgorithm* filter, vtkInformationVector** inputs, Part part = Part::All,
    double maxCells = 0);

  /// Requests the same of data alone.
  void RequestData(vtkInformation* inInfo, Part part, double maxCells) const;

  /// On all ranks: until the inputs change, pieces with so few cells in all that rank 0 had better have all of them.
  void SetTooFew(double maxCells) { this->TooFew = maxCells; }

  /// What the filter works with.
  struct Inputs
  {
    vtkDataObject* data = nullptr;
    vtkDataObject* bodies = nullptr; // may be null
    /// The names of those of points or cells that it needs of the data, when these are to be sent; null: none.
    std::function<std::vector<std::string>()> arrays{};
  };

  /// The ranks while rank 0 makes something, from the constructor to the destructor.
  class Meeting
  {
  public:
    /// With the inputs, in RequestData; without, where they are those of the last time.
    Meeting(FilterRanks& ranks, const std::optional<Inputs>& inputs);
    ~Meeting();
    Meeting(const Meeting&) = delete;
    Meeting& operator=(const Meeting&) = delete;

    /// On rank 0: all of the inputs, some of which other ranks may have sent. Throws std::runtime_error where rank 0
    /// cannot get them. Data of more cells than `maxCells` (of images 160 times as many) that several ranks have stay where
    /// they are: `data` is what rank 0 has of them, see AreInPieces().
    Inputs Gather(double maxCells = std::numeric_limits<double>::infinity());

    /// On rank 0: whether pieces were requested, but are not to stay where they are, see Gather(). Rank 0 had better
    /// request all: pieces that are joined differ a little from that where they meet.
    bool AreTooFew(double maxCells) const;

    /// On rank 0: the connections to those that trace rays, and those to all other ranks, null where one has not come.
    std::vector<schlieren::Channel*> GetWorkers() const;
    std::vector<schlieren::Channel*> GetChannels() const;

    /// On rank 0: what Serve() returns on the others.
    void SetOutcome(bool outcome) { this->Outcome = outcome; }
    /// Whether there is an image; on other ranks, after Serve(), unset where rank 0 has not come.
    void SetHasImage(bool hasImage) { this->HasImage = hasImage; }
    std::optional<bool> GetHasImage() const { return this->HasImage; }

    /// Answers a message; empty: it is for somebody else.
    using Responder = std::function<std::vector<char>(const std::vector<char>& message)>;
    /// On other ranks: does what rank 0 requests, until its meeting is over. False where rank 0 does not come.
    bool Serve(int threads, const Responder& respond = nullptr);

  private:
    using Time = std::chrono::steady_clock::time_point;
    void WaitForOthers(Time end);
    void WaitForRank0(Time end);
    /// Whether something upstream of that rank's filter has failed.
    bool HasFailed(const ranks::RankChannel& channel) const;
    std::optional<bool> ServeOnce(int threads, const Responder& respond);
    std::string FindAbsent() const;
    bool CanStayInPieces(double maxCells) const;
    /// On rank 0, with inputs: what each rank has of them.
    const std::vector<ranks::InputsOfRank>& InputsOfAll() const;

    FilterRanks& Of;
    const std::optional<Inputs> Own;
    bool Outcome = false;
    std::optional<bool> HasImage;
    bool HasMet = false;                            // rank 0, on another rank
    mutable std::vector<ranks::InputsOfRank> OfAll; // empty: nobody has needed it
  };

  /// On rank 0, after it has been gathered: all of an input of which this is what rank 0 has itself.
  vtkDataObject* GetInput(int input, vtkDataObject* own) const;

  /// On rank 0: whether the data have stayed on several ranks, and how often other data were gathered.
  bool AreInPieces() const { return this->InPieces; }
  int GetGatherings() const { return this->Gatherings; }

private:
  void CountChanges(vtkAlgorithm* filter);
  void WatchUpstream(vtkAlgorithm* filter);
  /// The message that this rank does not meet others with these inputs, because that has failed.
  std::vector<char> FailureOf(const std::string& name) const;

  struct Others;
  std::unique_ptr<Others> Inside; // null where there are no others
  UpstreamFailure Upstream;

  /// Of the inputs. Other ranks than 0 send what they have of each.
  struct Version
  {
    int changes = 0;
    double timeStep = 0;
  };
  friend bool operator==(const Version& a, const Version& b)
  {
    return a.changes == b.changes && a.timeStep == b.timeStep;
  }

  Version Now;
  vtkTimeStamp CountedAt;
  Version Requested;
  Part RequestedPart = Part::All;
  double TooFew = std::numeric_limits<double>::infinity();
  std::chrono::steady_clock::time_point RequestedAt{};
  Version Compared;
  double MostCells = 0;  // of Compared
  bool InPieces = false; // likewise
  int Gatherings = 0;
  std::string Problem; // of Compared
  using OfInputs = std::array<vtkSmartPointer<vtkDataObject>, 2>;
  OfInputs Gathered;               // likewise; null: rank 0 has all of it
  std::vector<std::string> Arrays; // of the data, that were gathered
};

} // namespace filters
