// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

class vtkDataArray;
class vtkDataObject;
class vtkDataSet;
class vtkImageData;
class vtkRefractiveIndex;

/// The stages of vtkRefractiveIndex. A user's mistake is thrown as std::runtime_error, with a message
/// that says the problem, why it is one and what to do.
namespace refractivity
{

// The point arrays of the output, which are also understood where an input has them.
constexpr const char* arrayName = "Refractivity";
constexpr const char* maskName = "vtkValidPointMask"; // as vtkResampleToImage calls it

/// N as a linear function of what the array holds.
struct Model
{
  double scale = 1;
  double offset = 0;
};

/// A dataset within the input that has the chosen array.
struct Leaf
{
  vtkDataSet* data;
  vtkDataArray* array; // one component, one value for each point or cell
  bool ofCells;
};

/// What to read from an input.
struct Source
{
  std::vector<Leaf> leaves;      // at least one
  vtkImageData* image = nullptr; // the data of the only leaf, where it keeps its own grid
  Model model;
  std::string label; // the array's name, for messages
};

Source chooseSource(vtkRefractiveIndex* self, vtkDataObject* input);

/// Whether the values of an image will belong to its cells: as the user asked, unless its data, where
/// they are there already, say otherwise.
bool willReadCells(vtkRefractiveIndex* self, vtkDataObject* image);

} // namespace refractivity
