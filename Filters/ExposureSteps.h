// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Ranks.h"
#include "TimeExposure.h"

#include "vtkSmartPointer.h"

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

class vtkAlgorithm;
class vtkDataObject;
class vtkInformation;
class vtkInformationVector;

namespace filters
{

/// What an exposure of `length`, of so many instants, is in a request of that output for a time; none where the data do
/// not change with time.
TimeExposure exposureFor(vtkInformation* input, vtkInformation* output, double length, int samples);

/// Requests another time of all inputs than that of the output.
void requestTime(vtkAlgorithm* filter, vtkInformationVector** inputs, double time);

/// The data of an image, for RequestData of a filter that has those of the first step of its exposure, or of the only
/// one where there is none. What is upstream is updated for one step after the other, on all ranks, and two of them
/// are kept. (VTK's CONTINUE_EXECUTING would do the same, but never ends where the data of a step cannot be read.)
/// At its end, the other ranks have been followed through all steps, whatever happened on this one, the outputs are of
/// the time of the image, and the request is that of the first step again.
class ExposureSteps
{
public:
  /// `part`, `maxCells`: what was requested of the first step, see FilterRanks::Request(), and what Gather() is to leave where it is.
  ExposureSteps(vtkAlgorithm* filter, FilterRanks& ranks, vtkInformationVector** inputs,
    vtkInformationVector* outputs, const TimeExposure& exposure, FilterRanks::Part part,
    double maxCells);
  ~ExposureSteps();
  ExposureSteps(const ExposureSteps&) = delete;
  ExposureSteps& operator=(const ExposureSteps&) = delete;

  /// The ranks meet for the first step, with what this one has of it.
  void Meet(const FilterRanks::Inputs& own);
  FilterRanks::Meeting& GetMeeting() { return *this->Meeting; }

  /// Where pieces are too few, see FilterRanks: updates the inputs once more, all of them on rank 0, and meets again.
  void MeetWithAll();

  /// Updates the inputs for the next step, for which the ranks meet, too. False where there is none.
  bool Resume();

  /// On rank 0: keeps the data of the step, of data that stay on their ranks its own piece. Throws std::runtime_error with a
  /// message for the user, as the next ones.
  void Keep();
  /// On other ranks: keeps their pieces.
  void KeepPiece();

  /// The data of an input at an instant, for which the step must be there.
  bool IsBefore(const TimeExposure::Instant& instant) const { return this->Step < instant.later; }
  vtkSmartPointer<vtkDataObject> GetData(int port, const TimeExposure::Instant& instant) const;

  /// Says that there are no data at an instant because those before and after it differ.
  [[noreturn]] void ThrowNoneBetween(
    const TimeExposure::Instant& instant, const std::string& difference) const;

  /// On other ranks: what they have kept of the step, and of the one before; may be null.
  vtkDataObject* GetPiece() const { return this->Later[0]; }
  vtkDataObject* GetEarlierPiece() const { return this->Earlier[0]; }

private:
  static constexpr int Ports = 2;

  void MeetAgain();
  void Keep(int port, vtkDataObject* data);

  vtkAlgorithm* Filter;
  FilterRanks& Ranks;
  vtkInformationVector** Inputs;
  vtkInformationVector* Outputs;
  const TimeExposure& Exposure;
  const FilterRanks::Part Part;
  const double MaxCells;
  std::function<std::vector<std::string>()> Arrays; // see FilterRanks::Inputs
  std::optional<FilterRanks::Meeting> Meeting;
  std::size_t Step = 0;
  bool IsThere = true;                                         // the data of Step
  vtkSmartPointer<vtkDataObject> Earlier[Ports], Later[Ports]; // Later: of Step
};

} // namespace filters
