// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

class vtkAlgorithm;
class vtkObject;

namespace filters
{

/// Finds out that something upstream of a filter has failed: VTK does not run the filter then, and calls nothing of it.
class UpstreamFailure
{
public:
  /// Gets the class of what has failed.
  using Report = std::function<void(const std::string& name)>;

  UpstreamFailure() = default;
  ~UpstreamFailure();
  UpstreamFailure(const UpstreamFailure&) = delete;
  UpstreamFailure& operator=(const UpstreamFailure&) = delete;

  /// Until the first failure or Ignore(). It fails without notice where VTK's messages are off.
  void Watch(vtkAlgorithm* filter, Report report);
  void Ignore() { this->ReportIt = nullptr; }

  /// Of an executive.
  void Notice(vtkObject* failed);

private:
  Report ReportIt;
  std::vector<vtkObject*> Watched; // executives, whose addresses are compared
};

} // namespace filters
