// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkSmartPointer.h"

#include <string>
#include <vector>

class vtkImageData;
class vtkSMProxy;

/// Fetches an output of a filter, with some of its point arrays, from the server at the current
/// time. Null if there is none.
vtkSmartPointer<vtkImageData> fetchedImage(
  vtkSMProxy* filter, unsigned int port, const std::vector<std::string>& arrays);
