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

/// Returns the exposure of `length` and so many instants for a request of the output; none for data
/// that do not change with time.
TimeExposure exposureFor(vtkInformation* input, vtkInformation* output, double length, int samples);

/// Requests data of another time than the output's from all inputs.
void requestTime(vtkAlgorithm* filter, vtkInformationVector** inputs, double time);

/// Updates upstream filters for the steps of an exposure (or for one step without exposure), on all
/// ranks, in the RequestData of a filter that has the data of the first one, and keeps two of them.
/// VTK's CONTINUE_EXECUTING would not end if a step cannot be read. The destructor leads the other
/// ranks through all steps even after an error, sets the image's time on the outputs, and requests
/// the first step again.
class ExposureSteps
{
public:
  /// `maker`: see InputsOfRanks::setOwn(). `ranks`: begun. `maxCells`: see InputsOfRanks::gather().
  ExposureSteps(vtkAlgorithm* filter, MediumMaker& maker, InputsOfRanks& ranks,
    vtkInformationVector** inputs, vtkInformationVector* outputs, const TimeExposure& exposure,
    double maxCells);
  ~ExposureSteps();
  ExposureSteps(const ExposureSteps&) = delete;
  ExposureSteps& operator=(const ExposureSteps&) = delete;

  /// Updates the inputs for the next step; the ranks begin again. Returns false without one.
  bool Resume();
  /// Returns whether all ranks have the step.
  bool IsThere() const { return this->Problem.empty(); }

  /// Keeps the data of the step on rank 0, or its piece of data that stay on their ranks. Throws
  /// std::runtime_error with a message for the user, as KeepPiece() does.
  void Keep();
  /// Keeps the pieces of other ranks.
  void KeepPiece();

  /// Return whether an instant needs a later step, and the data of an input at an instant.
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
