// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "RefractivityModels.h"

#include "vtkSmartPointer.h"

#include <stdexcept>
#include <string>
#include <vector>

class vtkDataArray;
class vtkDataObject;
class vtkDataSet;
class vtkImageData;
class vtkRefractiveIndex;

/// The stages of vtkRefractiveIndex. A user's mistake is thrown as std::runtime_error, with a message
/// that says the problem, why it is one and what to do.
namespace filters
{

// The point arrays of the output, which are also understood where an input has them.
constexpr const char* arrayName = "Refractivity";
constexpr const char* maskName = "vtkValidPointMask"; // as vtkResampleToImage calls it
constexpr const char* transparentName = "TransparentPointMask";

// A value of the field data, where the first of these arrays holds N less that: see Numbers::Differences.
constexpr const char* offsetName = "RefractivityOffset";

/// What the array Refractivity holds.
enum class Numbers
{
  Singles,
  Doubles,
  Differences // in single precision, from a value near that of the surroundings: weak flows keep their digits
};

/// The arrays that a model takes its values from, in its order. Each has one component and one value for
/// each point, or each has one for each cell.
using Arrays = std::vector<vtkDataArray*>;

/// A dataset within the input that has all chosen arrays.
struct Leaf
{
  vtkDataSet* data;
  Arrays arrays;
  bool ofCells;
  vtkDataSet* input; // `data`, but for what a mask hides
};

/// What to read from an input.
struct Source
{
  std::vector<Leaf> leaves; // at least one
  std::vector<vtkSmartPointer<vtkDataSet>>
    made;                        // their data that are not the input's: masked, extruded
  vtkImageData* image = nullptr; // the data of the only leaf, where it keeps its own grid
  Model model;
  double depth = 0;            // of flat data, see depthOf(); 0: to be chosen
  bool isDepthGiven = false;   // by the user
  bool isOneCellThick = false; // what `leaves` have was: see flattenLayer()
  int axisOfWedge = -1;        // likewise: see flattenWedge(); -1: none
  std::string noteOnGases;     // what the user should know once, mostly empty
  std::string label;           // for messages: "array 'rho'" or "arrays 'T', 'p'"
  bool isComputed = false;     // the refractivity was computed before
};

/// Thrown where no dataset has the arrays that are needed; others, on other ranks, may have them.
class ArraysMissing : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/// The datasets within an input that have points.
std::vector<vtkDataSet*> dataSetsOf(vtkDataObject* input);

/// `like`: what was chosen of the same input for other arrays; data that are one layer of cells become flat only if they have
/// there. Null: if they can.
Source chooseSource(vtkRefractiveIndex* self, vtkDataObject* input, const Source* like = nullptr);

/// The names of all arrays that may be read of an input.
std::vector<std::string> arraysOf(vtkRefractiveIndex* self);

/// How each of them was chosen: equal texts mean the same choices.
std::string choicesOfArrays(vtkRefractiveIndex* self);

/// Whether the values of an image will belong to its cells: as the user chose, unless its data, where
/// they are there already, say otherwise.
bool willReadCells(vtkRefractiveIndex* self, vtkDataObject* image);

} // namespace filters
