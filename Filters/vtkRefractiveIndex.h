// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkRefractiveIndex
 * @brief   refractivity of a gas on a regular grid, from the fields of a flow
 *
 * Takes any vtkDataSet or composite of them and produces a vtkImageData with two point arrays:
 * - `Refractivity` (float, or double with DoublePrecision): N = n - 1 for the refractive index n;
 *   0 where the mask is 0. N is stored and not n, because in single precision the 1 would cost all
 *   digits of a weak flow.
 * - `vtkValidPointMask` (unsigned char): 0 in solids and outside the input, else 1.
 *
 * An image keeps its own grid, oriented ones included: point arrays are taken as they stand, cell
 * arrays on the grid of the cells' centres, so that nothing is smoothed. All other input is
 * resampled to a grid (see SamplingDimensions) with vtkResampleToImage, cell arrays after
 * vtkCellDataToPointData. Only cells with a volume count: surfaces in a composite are left out, and
 * so are blocks that lack the array.
 *
 * Invalid (mask 0) are NaN and infinite values, hidden points and cells (vtkGhostType), points whose
 * `vtkValidPointMask` in the input is 0, and places that no cell covers. On images, a point is
 * hidden if all its cells are, and so are all points of a hidden cell that would otherwise vanish.
 *
 * IndexModel chooses how N is found. An image that already holds a point array `Refractivity` is
 * used as it stands where IndexModel is REFRACTIVITY or GLADSTONE_DALE and the selected array is
 * missing, not chosen, or `Refractivity` itself: so the output of this filter can be handed on.
 *
 * The field data hold `SamplingDimensions`, the grid that was used.
 *
 * Mistakes (no such array, empty input, no valid value, ...) end in one error and an empty output.
 *
 * @sa vtkSchlierenFilter
 */

#ifndef vtkRefractiveIndex_h
#define vtkRefractiveIndex_h

#include "vtkImageAlgorithm.h"
#include "vtkSchlierenFiltersModule.h" // for export macro

class VTKSCHLIERENFILTERS_EXPORT vtkRefractiveIndex : public vtkImageAlgorithm
{
public:
  static vtkRefractiveIndex* New();
  vtkTypeMacro(vtkRefractiveIndex, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// How the refractivity N is found. The numbers are part of the interface.
  enum IndexModels
  {
    GLADSTONE_DALE = 0,   ///< N = K rho (Gladstone & Dale 1863); array 0 is the density rho
    REFRACTIVE_INDEX = 1, ///< N = n - 1; array 1 is n
    REFRACTIVITY = 2      ///< array 1 is N
  };

  /// The arrays that SetInputArrayToProcess can choose.
  enum InputArrays
  {
    DENSITY = 0,
    INDEX_ARRAY = 1
  };

  ///@{
  /**
   * How the refractivity is found from the arrays, one of IndexModels. Default: GLADSTONE_DALE.
   * The arrays are chosen with SetInputArrayToProcess (0: density, 1: index or refractivity); a name
   * that is not found with the association given is looked for with the other one.
   */
  vtkSetClampMacro(IndexModel, int, GLADSTONE_DALE, REFRACTIVITY);
  vtkGetMacro(IndexModel, int);
  ///@}

  ///@{
  /**
   * Gladstone-Dale constant K in m^3/kg. Default: 2.26e-4 (air, visible light).
   * Gladstone & Dale 1863, Phil. Trans. R. Soc. 153, 317.
   */
  vtkSetMacro(GladstoneDaleConstant, double);
  vtkGetMacro(GladstoneDaleConstant, double);
  ///@}

  ///@{
  /**
   * Factor that turns the density array into kg/m^3. Default: 1.
   */
  vtkSetMacro(DensityScale, double);
  vtkGetMacro(DensityScale, double);
  ///@}

  ///@{
  /**
   * Points along x, y and z of the grid to which other input than images is resampled. An axis that
   * is 0 is chosen: voxels as nearly cubic as the other axes allow; with all three 0 (the default)
   * as many as the mesh has points, 64^3 to 256^3 in all, at least 2 along each axis.
   */
  vtkSetVector3Macro(SamplingDimensions, int);
  vtkGetVector3Macro(SamplingDimensions, int);
  ///@}

  ///@{
  /**
   * Whether `Refractivity` is a double array. Default: false (float).
   */
  vtkSetMacro(DoublePrecision, bool);
  vtkGetMacro(DoublePrecision, bool);
  vtkBooleanMacro(DoublePrecision, bool);
  ///@}

  ///@{
  /**
   * Threads for conversion and resampling; 0 (the default): VTK_SMP_MAX_THREADS where that is set,
   * else all cores. The result does not depend on it, but for rounding in points that several cells
   * of a mesh share; so setting it does not call Modified().
   */
  void SetNumberOfThreads(int threads) { this->NumberOfThreads = threads < 0 ? 0 : threads; }
  vtkGetMacro(NumberOfThreads, int);
  ///@}

  /**
   * Makes `structure` the grid (extent, origin, spacing, direction; no arrays) that Convert() would
   * fill for `input`. Throws std::runtime_error where there is none.
   */
  VTK_WRAPEXCLUDE void ComputeGrid(vtkDataObject* input, vtkImageData* structure);

  /**
   * What the filter does, without a pipeline: fills `output` from `input`. Throws
   * std::runtime_error with a message for the user, and std::bad_alloc; `output` is then undefined.
   * If AbortExecute is set on the way, it returns early with an empty output.
   */
  VTK_WRAPEXCLUDE void Convert(vtkDataObject* input, vtkImageData* output);

protected:
  vtkRefractiveIndex();
  ~vtkRefractiveIndex() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(
    vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output) override;
  int RequestUpdateExtent(
    vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output) override;

private:
  vtkRefractiveIndex(const vtkRefractiveIndex&) = delete;
  void operator=(const vtkRefractiveIndex&) = delete;

  int IndexModel = GLADSTONE_DALE;
  double GladstoneDaleConstant = 2.26e-4;
  double DensityScale = 1;
  int SamplingDimensions[3] = { 0, 0, 0 };
  bool DoublePrecision = false;
  int NumberOfThreads = 0;
};

#endif
