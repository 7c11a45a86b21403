// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Input/RefractivitySource.h"
#include "Input/SamplingBox.h"

#include "Schlieren.h"

#include <array>
#include <string>

/// Planes that are sections of a flow with an axis of symmetry.
namespace filters
{

/// How a plane lies about its axis of symmetry. Coordinate axes by their numbers.
struct Revolution
{
  int axis, radial, flat;       // along it, away from it in the plane, across the plane
  std::array<double, 3> origin; // a point of it
  double low, high;             // of the data, along it
  double radius;                // the largest distance of data from it
  bool isMirrored;              // the data are on one side of it
  std::string note;             // for the user

  schlieren::Box box() const;
};

/// What was chosen, or what suits the data. Throws where they are not flat, or lie on no side of an axis.
Revolution revolutionOf(const Source& source);

/// Two points along each axis of its box; or so many as the cells of the plane suggest, unless they are given: see
/// vtkRefractiveIndex::SetSamplingDimensions.
void boxOf(const Revolution& revolution, vtkImageData* structure);
void gridOf(const Revolution& revolution, const Source& source, const int samplingDimensions[3],
  const SamplingBox& box, vtkImageData* structure);

/// With what is on the other side of the axis, where data are on one side only.
Source mirrored(const Source& source, const Revolution& revolution);

} // namespace filters
