// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <exception>
#include <functional>
#include <string>

class vtkInformation;

namespace filters
{

/// Keeps what a filter's requests throw from VTK, which does not expect it: the program would end.
class RequestGuard
{
public:
  using Fail = std::function<void(const std::string& problem)>;

  /// Does the work of a request, for ProcessRequest; returns what `work` returns, or 1 where it throws. `fail` gets what
  /// REQUEST_DATA throws. What is thrown before that waits for ThrowEarlier(): RequestData comes all the same, so that a rank
  /// which fails meets the others.
  int Process(vtkInformation* request, const std::function<int()>& work, const char* noMemory,
    const Fail& fail);

  /// In RequestData.
  void ThrowEarlier();

private:
  std::exception_ptr Earlier;
};

} // namespace filters
