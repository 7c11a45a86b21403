// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Gathers data of several ranks on one.
#pragma once

#include "vtkSmartPointer.h"

#include <string>
#include <vector>

class vtkDataObject;
class vtkDataSet;

namespace filters
{

/// Joins the pieces of each image or mesh, merging points that are equal to the last bit; those of rectilinear and
/// curvilinear grids stay blocks. Copies of cells become ordinary ones.
std::vector<vtkSmartPointer<vtkDataSet>> joined(
  const std::vector<vtkSmartPointer<vtkDataSet>>& pieces);

/// Joins the messages of several ranks, made by pack(). Blocks stay separate. Null for no data.
/// Throws std::runtime_error for unreadable messages.
vtkSmartPointer<vtkDataObject> gatheredData(const std::vector<std::vector<char>>& ofRanks);

} // namespace filters
