// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Gas/TransferFunctions.h"
#include "Input/Flow.h"

#include "vtkSmartPointer.h"

#include <array>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

class vtkDataArray;
class vtkDataObject;
class vtkImageData;

namespace filters
{

/// Computes the Fields of a medium that tint images. A field is its transfer function's value, if
/// the medium is made with these; else it is relative to its range. User errors are thrown as
/// std::runtime_error with a message for the user.

/// The range of a field in the data of a rank.
struct RangeOfField
{
  FieldMean::Range range; // low > high: no values
  std::string lacks;      // message if no rank has the field; empty: this one has
};
/// Finds the ranges of the fields of `medium`.
std::vector<RangeOfField> rangesOfFields(const MediumSettings& medium, vtkDataObject* input);

/// Returns the fields of `medium` in the form of refractivities, with the leaves of `ofMedium`, by
/// which the medium is made from `input`; NaN where a leaf lacks the field. `ranges`: those of all
/// ranks, as a piece may lack fields; empty: there is one rank.
std::vector<Flow> fieldFlows(const MediumSettings& medium, vtkDataObject* input,
  const Flow& ofMedium, const std::vector<FieldMean::Range>& ranges = {});

/// Averages point values over cells.
void bringToCells(Flow& field);

/// Calls take(number, image) for each field of `medium` in the form of a refractivity, on the grid of
/// `refractivity`, which has been made of `input`. `ranges`: those of all ranks; empty: there is one.
void forFieldImages(const MediumSettings& medium, vtkDataObject* input, vtkImageData* refractivity,
  const std::function<void(std::size_t, vtkImageData*)>& take,
  const std::vector<FieldMean::Range>& ranges = {});

/// Returns the gradients of the fields of `medium` on the grid of `refractivity`, which has been made
/// of `input`, for schlieren::FieldGradients::values.
std::vector<float> fieldGradients(
  const MediumSettings& medium, vtkDataObject* input, vtkImageData* refractivity, int threads);

/// Returns three `values` for each field or, without any, hues of the golden section (numbers times
/// 0.618 of the circle, from red), which are distinct for any number of fields, and stay when
/// fields are added.
std::vector<std::array<float, 3>> fieldColors(
  const std::vector<double>& values, std::size_t fields);

} // namespace filters
