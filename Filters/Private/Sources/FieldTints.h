// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Gas/TransferFunctions.h"
#include "Input/RefractivitySource.h"

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

class MediumMaker;

/// What vtkSchlierenFilter needs to tint an image by the Fields of its medium. A field is what its transfer function
/// makes of it, where the medium is made with these; else its place in its range. A user's mistake is thrown as
/// std::runtime_error with a message for the user.

/// A field in the form of a refractivity.
struct FieldValues
{
  filters::Source source; // leaves in the order of the medium's; NaN where a leaf lacks the field
  std::vector<vtkSmartPointer<vtkDataArray>> made; // arrays that are not the input's
};

/// The range of a field in the data of a rank.
struct RangeOfField
{
  FieldMean::Range range; // low > high: no values
  std::string lacks;      // message if no rank has the field; empty: this one has
};
/// Finds the ranges of the fields of `medium`.
std::vector<RangeOfField> rangesOfFields(const MediumSettings& medium, vtkDataObject* input);

/// The fields of `medium`, which takes `ofMedium` from `input`. `ranges`: of all parts of the data, of which this may not have
/// all fields; empty: these are all.
std::vector<FieldValues> fieldValues(const MediumSettings& medium, vtkDataObject* input,
  const filters::Source& ofMedium, const std::vector<FieldMean::Range>& ranges = {});

/// Averages point values over cells.
void bringToCells(FieldValues& field);

/// Calls take(number, image) for each field with its values, as if they were a refractivity, on the grid of
/// `refractivity`, which `maker` has made from `input`. `ranges`: of all parts of the data; empty: this is all.
void forFieldImages(MediumMaker& maker, vtkDataObject* input, vtkImageData* refractivity,
  int threads, const std::function<void(std::size_t, vtkImageData*)>& take,
  const std::vector<FieldMean::Range>& ranges = {});

/// The gradients of the fields on the grid of `refractivity`, which `maker` has made from `input`: what
/// schlieren::FieldGradients::values needs.
std::vector<float> fieldGradients(
  MediumMaker& maker, vtkDataObject* input, vtkImageData* refractivity);

/// Three `values` for each field; or, where there are none, hues of the golden section (their numbers
/// times 0.618 of the circle, from red), of which any number is well apart and none changes when a field
/// is added.
std::vector<std::array<float, 3>> fieldColors(
  const std::vector<double>& values, std::size_t fields);

} // namespace filters
