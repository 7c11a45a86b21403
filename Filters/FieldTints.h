// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

class vtkDataObject;
class vtkImageData;
class vtkRefractiveIndex;

/// What vtkSchlierenFilter needs to tint a picture by the Fields of its medium. A user's mistake is thrown
/// as std::runtime_error with a message for the user.

/// The gradients of the fields on the grid of `refractivity`, which `medium` has made from `input`: what
/// schlieren::FieldGradients::values needs. A field is what its transfer function makes of it, where the
/// medium is made with these; else its place in its range.
std::vector<float> fieldGradients(
  vtkRefractiveIndex* medium, vtkDataObject* input, vtkImageData* refractivity, int threads);

/// Three `values` for each field; or, where there are none, hues of the golden section (their numbers
/// times 0.618 of the circle, from red), of which any number is well apart and none changes when a field
/// is added.
std::vector<std::array<float, 3>> fieldColors(
  const std::vector<double>& values, std::size_t fields);
