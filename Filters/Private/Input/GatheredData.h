// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Data that are spread over several ranks, put together on one.
#pragma once

#include "vtkSmartPointer.h"

#include <string>
#include <vector>

class vtkDataObject;
class vtkDataSet;

namespace filters
{

/// Parts of one dataset, as few datasets as can be: parts of one image or grid, and parts of one mesh, become one again, with
/// points that are the same to the last bit merged. Cells that are copies become ordinary ones.
std::vector<vtkSmartPointer<vtkDataSet>> joined(
  const std::vector<vtkSmartPointer<vtkDataSet>>& parts);

/// The data of several ranks, of each what pack() has made of its parts. Those of one dataset are joined; different blocks
/// stay as they are. Null where there is nothing. Throws std::runtime_error where it is unreadable.
vtkSmartPointer<vtkDataObject> gatheredData(const std::vector<std::vector<char>>& ofRanks);

} // namespace filters
