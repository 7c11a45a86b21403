// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "CellTree.h"

#include <string>

namespace filters
{

/// What the user should hear of cells that are inside out, where the mesh is folded or points are in a wrong order: in a
/// block, those few of a linear shape whose Jacobian determinant has another sign than that of the others. (Blocks, and
/// the shapes in one, may well be left-handed as a whole.) And of curved cells that fold over themselves. Empty where there
/// are none.
std::string warningOfInvertedCells(const CellTree& cells);

} // namespace filters
