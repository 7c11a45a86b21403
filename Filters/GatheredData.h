// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Data that are spread over several ranks, put together on one.
#pragma once

#include "vtkSmartPointer.h"

#include <string>
#include <vector>

class vtkDataObject;

namespace filters
{

/// What a rank sends of its data: points, cells, what hides them, and those arrays of points and cells that are named.
/// Cells that are copies of other ranks' are left out, but in images, where they may touch. Throws std::runtime_error
/// where VTK cannot send a type of data.
std::vector<char> packedData(vtkDataObject* data, const std::vector<std::string>& arrays);

/// The data of several ranks, of each what packedData() has made of it. Parts of one image or grid, and parts of one
/// mesh, become one again, with points that are the same to the last bit merged; different blocks stay as they are.
/// Null where there is nothing. Throws std::runtime_error where it is unreadable.
vtkSmartPointer<vtkDataObject> gatheredData(const std::vector<std::vector<char>>& ofRanks);

} // namespace filters
