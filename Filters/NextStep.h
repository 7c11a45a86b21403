// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkSmartPointer.h"
#include "vtkType.h"

#include "Schlieren.h"

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

class vtkAlgorithm;
class vtkDataObject;
class vtkInformation;
class vtkInformationVector;
struct MadeRefractivity;

namespace filters
{

/// A time step of a filter's inputs, and what has been made of it.
struct TimeStep
{
  double time = 0;
  vtkSmartPointer<vtkDataObject> data, bodies; // of this rank, sharing arrays; bodies may be null
  std::shared_ptr<const MadeRefractivity> refractivity; // null: not made yet
  std::unique_ptr<schlieren::Bench> bench;              // that has the medium; likewise
};

/// The time step that will probably be requested next, which a filter reads while it traces the image of this one.
/// As upstream has that step then, this one is kept, too. Both are forgotten when anything upstream changes, and where
/// another part of the data is requested than before. Ranks have it alike.
class NextStep
{
public:
  /// In RequestUpdateExtent for a time, after what is requested is known: where its step is kept, requests nothing else
  /// than upstream has.
  void Request(vtkAlgorithm* filter, vtkInformationVector** inputs, double time);

  /// In RequestData for the same time: its step, which is that of the inputs unless it is kept.
  TimeStep& Arrive(vtkAlgorithm* filter, double time, vtkInformationVector** inputs);

  /// The step of the last image; null where it is not kept.
  const TimeStep* Current(vtkAlgorithm* filter) const;

  /// The time step that follows the current one as that has followed the one before; unset where there is none, where
  /// the current time is not that of a step, and where that step is there already.
  std::optional<double> Predict(vtkInformation* input) const;

  /// Updates the inputs for a time, and afterwards requests the current one again. Null where there are no data.
  const TimeStep* Read(vtkAlgorithm* filter, vtkInformationVector** inputs, double time);

  /// The step that has been read; null where there is none.
  TimeStep* GetNext() { return this->Next ? &*this->Next : nullptr; }
  /// Forgets it.
  void Drop() { this->Next.reset(); }

  /// Whether what is upstream can be read ahead: it cannot where it changes with each step.
  bool GetKeepable() const { return this->IsKeepable; }
  void SetKeepable(bool isKeepable) { this->IsKeepable = isKeepable; }

  void Release();

private:
  bool IsValid(vtkAlgorithm* filter) const;

  std::optional<TimeStep> This, Next;
  vtkMTimeType UpstreamTime = 0;
  std::vector<int> Pieces;   // that were requested of This and Next
  bool HasRequested = false; // what is requested: the inputs may be of another time
  bool IsKeepable = true;
  std::optional<double> Before; // the time of the image before
};

/// What `trace` returns, which runs in a thread of its own while `read` runs in this one. The monitor is called in this one,
/// as soon as `read` has returned. Where there is no thread for it, one follows the other.
schlieren::Image traceWhile(const std::function<void()>& read,
  const std::function<schlieren::Image(const schlieren::Monitor&)>& trace,
  const schlieren::Monitor& monitor);

} // namespace filters
