// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Lines of sight through the box of a medium.
#pragma once

#include "Medium/Tree/BrickRays.h"
#include "Types.h"

namespace schlieren
{

/// A ray x = start + s direction, in index coordinates, s from `entry` to `exit` in data units.
struct StraightRay
{
  double start[3], direction[3];
  double entry, exit;
};

StraightRay rayAt(const Grid& grid, const Column& column, double u, double v);

/// Where something with such a product with u or v is seen in the image, where the column is so wide.
double imageCoordinate(const Column& column, int side, double coordinate, double width);

struct ImageRange
{
  double low, high;
};

/// The range of the products of a vector with the points of a box.
struct Products
{
  double middle, half;
};
Products productsWith(const Vec3<double>& vector, const Box& box);

/// Whether any of a box is seen in a part of the image.
bool isSeenIn(const Column& column, const Column::Part& part, const Box& box);

/// Finds which of the image's coordinates along u or v the grid covers.
ImageRange rangeOfBox(const Grid& grid, const Column& column, int side);

} // namespace schlieren
