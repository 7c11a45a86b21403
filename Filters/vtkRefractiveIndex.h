// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkRefractiveIndex
 * @brief   appends the refractivity of a gas to the data of its flow
 *
 * The output is the input with one more array, `Refractivity`: N = n - 1 for the refractive index n, at the points or in
 * the cells to which the arrays that it is made of belong; NaN where there is no gas: where values are not finite or no
 * state of a gas, and where Mask says so. It is a double array where the first of these arrays is one, else a float array. Single precision of
 * N keeps the digits of a weak flow that n would lose. In a composite, all datasets get it that have the arrays.
 *
 * Of axisymmetric data (see Symmetry) the output is an image of the body of revolution instead, on a grid of cubes: with
 * the point arrays `Refractivity`, 0 where there is no gas, `vtkValidPointMask`, 1 in gas, and `TransparentPointMask`, 1
 * where light passes without gas.
 *
 * Each user error (missing array, empty input, no valid value, ...) is one error, with an empty output. One warning names
 * values outside of the model's range, or fractions that exceed 1 in sum.
 *
 * @sa vtkSchlierenFilter
 */

#ifndef vtkRefractiveIndex_h
#define vtkRefractiveIndex_h

#include "vtkFlowAlgorithm.h"
#include "vtkNew.h"                    // for Grid
#include "vtkSchlierenFiltersModule.h" // for export macro

#include <utility> // for std::pair

class vtkImageData;

class VTKSCHLIERENFILTERS_EXPORT vtkRefractiveIndex : public vtkFlowAlgorithm
{
public:
  static vtkRefractiveIndex* New();
  vtkTypeMacro(vtkRefractiveIndex, vtkFlowAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

protected:
  vtkRefractiveIndex();
  ~vtkRefractiveIndex() override;

  int RequestDataObject(
    vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output) override;
  int RequestInformation(
    vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output) override;
  int RequestUpdateExtent(
    vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output) override;

private:
  vtkRefractiveIndex(const vtkRefractiveIndex&) = delete;
  void operator=(const vtkRefractiveIndex&) = delete;

  /// Appends the array to a copy of the input.
  void Append(vtkDataObject* input, vtkDataObject* output);
  /// Makes the image of a body of revolution, on rank 0.
  void Revolve(vtkDataObject* input, vtkImageData* output);

  vtkNew<vtkImageData> Grid;                // the structure of the last image
  std::pair<vtkMTimeType, double> FailedAt; // newest time of this and upstream, and time step
};

#endif
