// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// How a dataset's values continue around its points; nothing is known of points of no cell.
//
// Gradients are those of the quadratic polynomial that fits the values at the neighbours best, so those of a quadratic
// field are exact. Where it does not fit well, as at a shock, they are made smaller.
//
// Values stay between those of the neighbours but at a smooth extremum, which three points in a row do not distinguish
// from the edge of a shock: both fit a parabola. There second derivatives of all neighbours have the same sign, while
// across a shock they change it and beside it they vanish (Colella and Sekora, J. Comput. Phys. 227, 7069 (2008),
// doi:10.1016/j.jcp.2008.03.034). So values may go beyond by what the smallest of these makes of the distance to the
// neighbours.
#pragma once

#include "Cells/MeshArrays.h"
#include "Cells/PointNeighbours.h"
#include "Common/WorkProgress.h"

#include <vector>

namespace filters
{

/// Returns the trend at each point. `neighbours`: of a mesh with the same points and cells.
std::vector<PointTrend> trendsOf(
  const MeshArrays& mesh, const PointNeighbours& neighbours, const WorkProgress& progress);

/// The values at the points that are right for a mesh some of whose values are means (see CellsAround): those of
/// the polynomials whose means fit these best. Beyond the values of the cells around it goes only a point where all
/// others nearby do so, too, at a smooth extremum, or where the field continues evenly, at the boundary: so there is no
/// overshoot beside a shock.
std::vector<double> valuesOfMeans(
  const MeshArrays& mesh, const PointNeighbours& neighbours, const WorkProgress& progress);

} // namespace filters
