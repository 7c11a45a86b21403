// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Input/TimeExposure.h"
#include "Ranks/InputsOfRanks.h"

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
  /// `maker`: see InputsOfRanks::setOwn(). `ranks`: which have begun. `maxCells`: see InputsOfRanks::gather().
  ExposureSteps(vtkAlgorithm* filter, MediumMaker& maker, InputsOfRanks& ranks,
    vtkInformationVector** inputs, vtkInformationVector* outputs, const TimeExposure& exposure,
    double maxCells);
  ~ExposureSteps();
  ExposureSteps(const ExposureSteps&) = delete;
  ExposureSteps& operator=(const ExposureSteps&) = delete;

  /// Updates the inputs for the next step, for which the ranks begin anew. False where there is none.
  bool Resume();
  /// Whether they have begun: no rank lacks the step.
  bool IsThere() const { return this->Problem.empty(); }

  /// On rank 0: keeps the data of the step, of data that stay on their ranks its own piece. Throws std::runtime_error with a
  /// message for the user, as the next one.
  void Keep();
  /// On other ranks: keeps their pieces.
  void KeepPiece();

  /// The data of an input at an instant, for which the step must be there.
  bool IsBefore(const TimeExposure::Instant& instant) const { return this->Step < instant.later; }
  vtkSmartPointer<vtkDataObject> GetData(int port, const TimeExposure::Instant& instant) const;

private:
  static constexpr int Ports = 2;

  void SetOwn();
  void Keep(int port, vtkDataObject* data);

  vtkAlgorithm* Filter;
  MediumMaker& Maker;
  InputsOfRanks& Ranks;
  vtkInformationVector** Inputs;
  vtkInformationVector* Outputs;
  const TimeExposure& Exposure;
  const double MaxCells;
  std::size_t Step = 0;
  std::string Problem;                                         // of Step
  vtkSmartPointer<vtkDataObject> Earlier[Ports], Later[Ports]; // Later: of Step
};

} // namespace filters
