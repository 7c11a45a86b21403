// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

class vtkAlgorithm;
class vtkObject;

namespace filters
{

/// Finds out that something upstream of a filter has failed: VTK does not run the filter then.
class UpstreamFailure
{
public:
  UpstreamFailure() = default;
  ~UpstreamFailure();
  UpstreamFailure(const UpstreamFailure&) = delete;
  UpstreamFailure& operator=(const UpstreamFailure&) = delete;

  /// In ProcessRequest, from REQUEST_DATA_OBJECT on. It fails without notice where VTK's messages are off.
  void watch(vtkAlgorithm* filter);

  /// The class of what has failed since then; mostly empty.
  const std::string& failed() const { return this->Failed; }

  /// Of an executive.
  void notice(vtkObject* failed);

private:
  std::string Failed;
  std::vector<vtkObject*> Watched; // executives, whose addresses are compared
};

} // namespace filters
