// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkSmartPointer.h"

#include <string>
#include <vector>

class vtkImageData;
class vtkSMProxy;

/// An output of a filter with some of its point arrays, wherever the filter runs, at the time that is shown. Null
/// where there is none.
vtkSmartPointer<vtkImageData> fetchedImage(
  vtkSMProxy* filter, unsigned int port, const std::vector<std::string>& arrays);
