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
 * Each user error (missing array, empty input, no valid value, ...) is one error, with an empty output. One warning names
 * values outside of the model's range, or fractions that exceed 1 in sum.
 *
 * @sa vtkSchlierenFilter
 */

#ifndef vtkRefractiveIndex_h
#define vtkRefractiveIndex_h

#include "vtkFlowAlgorithm.h"
#include "vtkSchlierenFiltersModule.h" // for export macro

#include <utility> // for std::pair

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
  int RequestData(
    vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output) override;

private:
  vtkRefractiveIndex(const vtkRefractiveIndex&) = delete;
  void operator=(const vtkRefractiveIndex&) = delete;

  /// Appends the array to a copy of the input.
  void Append(vtkDataObject* input, vtkDataObject* output);

  std::pair<vtkMTimeType, double> FailedAt; // newest time of this and upstream, and time step
};

#endif
