// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <exception>
#include <functional>
#include <string>

class vtkInformation;

namespace filters
{

/// Keeps exceptions of a filter's requests from VTK, where they would end the program.
class RequestGuard
{
public:
  using Fail = std::function<void(const std::string& problem)>;

  /// Calls `work` from ProcessRequest and returns its result, or 1 where it throws. Reports what
  /// REQUEST_DATA throws to `fail`, and keeps what earlier requests throw for ThrowEarlier(), so
  /// that a failed rank still reaches RequestData and its collectives.
  int Process(vtkInformation* request, const std::function<int()>& work, const char* noMemory,
    const Fail& fail);

  /// Throws, in RequestData, what an earlier request has thrown.
  void ThrowEarlier();

private:
  std::exception_ptr Earlier;
};

} // namespace filters
