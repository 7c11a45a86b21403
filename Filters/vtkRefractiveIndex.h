// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkRefractiveIndex
 * @brief   refractivity of a gas on a regular grid, from the fields of a flow
 *
 * Converts a vtkDataSet, or a composite of them, to a vtkImageData with two point arrays:
 * - `Refractivity` (float, or double with DoublePrecision): N = n - 1 for the refractive index n;
 *   0 where the mask is 0. Single precision of N keeps the digits of a weak flow that n would lose.
 * - `vtkValidPointMask` (unsigned char): 0 in solids and outside the input, else 1;
 * and, where light passes regions without gas, a third one, `TransparentPointMask` (see Outside).
 *
 * An image keeps its own grid, oriented ones included: point arrays are not resampled, cell arrays
 * are on the grid of the cells' centres. Data in one plane across a coordinate axis, or one cell
 * thick along it, are extruded (see Depth) or revolved (see Symmetry), with a warning. Blocks of
 * images with cell arrays (AMR, overlapping or not) become a grid of the finest level's cells, on
 * which coarser blocks are interpolated from cell means, without a seam. All other input is sampled
 * on a grid (see SamplingDimensions) in the same way as by the tracer. Only cells with a volume are
 * used: surfaces in a composite are ignored, and so are blocks that lack an array. If several
 * arrays are needed, all of them belong to points or all to cells; the refractivity is computed
 * there, before resampling.
 *
 * Invalid (mask 0) are NaN and infinite values, states that no gas can have (T <= 0), hidden points
 * and cells (vtkGhostType), points whose `vtkValidPointMask` in the input is 0, and points outside
 * of cells. On images, a point is hidden if all its cells are, and so are all points of a hidden
 * cell that would otherwise vanish.
 *
 * The second input, optional, has the surfaces of bodies (vtkPolyData or composites of it): points
 * in and on closed ones, whatever the orientation of their faces, and points within 0.87 voxels of
 * open ones are masked. Bodies may overlap, enclose each other and extend beyond the data.
 *
 * IndexModel chooses how N is found. An image with a point array `Refractivity` is used unchanged
 * if IndexModel is not REFRACTIVE_INDEX and the (first) array that it needs is missing, not chosen,
 * or `Refractivity` itself: so the output of this filter can be its input.
 *
 * The field data have `SamplingDimensions`, the grid that was used.
 *
 * Each user error (missing array, empty input, no valid value, ...) is one error, with an empty
 * output. One warning names points outside of the model's range, or with fractions that exceed 1 in
 * sum.
 *
 * @sa vtkSchlierenFilter
 */

#ifndef vtkRefractiveIndex_h
#define vtkRefractiveIndex_h

#include "MediumSettings.h" // for the values of the properties
#include "vtkImageAlgorithm.h"
#include "vtkSchlierenFiltersModule.h" // for export macro
#include "vtkSmartPointer.h"           // for TransferFunctions

#include <memory> // for Maker, Guard, Ranks
#include <string> // for std::string
#include <vector> // for std::vector

class vtkPiecewiseFunction;

namespace filters
{
class InputsOfRanks;
class MediumMaker;
class RequestGuard;
} // namespace filters

class VTKSCHLIERENFILTERS_EXPORT vtkRefractiveIndex : public vtkImageAlgorithm,
                                                      private MediumSettings
{
public:
  static vtkRefractiveIndex* New();
  vtkTypeMacro(vtkRefractiveIndex, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// The input ports. BODIES is optional.
  enum InputPorts
  {
    FLOW = 0,
    BODIES = 1
  };

  /// Models of the refractivity N. The numbers are part of the interface.
  enum IndexModels
  {
    /// The model that fits the arrays: with a density (chosen, or recognized by name)
    /// GLADSTONE_DALE, or GLADSTONE_DALE_MIXTURE if there are fractions of known gases and Gas and
    /// GladstoneDaleConstant are unchanged; else REFRACTIVITY, REFRACTIVE_INDEX or CIDDOR
    AUTO = -1,
    GLADSTONE_DALE = 0,   ///< N = K rho (Gladstone & Dale 1863); array 0 is the density rho
    REFRACTIVE_INDEX = 1, ///< N = n - 1; array 1 is n
    REFRACTIVITY = 2,     ///< array 1 is N
    /// N = rho sum K_i Y_i: array 0 is rho; see AddMixtureArray
    GLADSTONE_DALE_MIXTURE = 3,
    /// Moist air (Ciddor 1996): arrays 2, 3 and 4 are temperature, pressure and humidity
    CIDDOR = 4,
    /// Several fields with a curve each: N = scale mean f_i, see AddField
    TRANSFER_FUNCTIONS = 5
  };

  /// Arrays for SetInputArrayToProcess.
  enum InputArrays
  {
    DENSITY = 0,
    INDEX_ARRAY = 1,
    TEMPERATURE = 2,
    PRESSURE = 3,
    HUMIDITY = 4, ///< not chosen, "" or "None": RelativeHumidity
    MASK = 5      ///< not chosen, "" or "None": gas in all visible cells
  };

  /// Kinds of fractions.
  enum FractionTypes
  {
    MASS = 0,
    VOLUME = 1 ///< or mole fractions
  };

  ///@{
  /**
   * Model of the refractivity, one of IndexModels. Default: AUTO. SetInputArrayToProcess chooses
   * its arrays, see InputArrays. If the association (that of the model's first array) has no such
   * names, the other one is searched. Without a choice, flowDefaults() finds arrays by name, and
   * GetArraysUsed() lists them. It is an error, which lists the arrays, if there is none.
   */
  vtkSetClampMacro(IndexModel, int, AUTO, TRANSFER_FUNCTIONS);
  vtkGetMacro(IndexModel, int);
  ///@}

  ///@{
  /**
   * Gladstone-Dale constant K in m^3/kg. Default: DefaultGladstoneDaleConstant (air, visible
   * light). Gladstone & Dale 1863, Phil. Trans. R. Soc. 153, 317.
   */
  static constexpr double DefaultGladstoneDaleConstant = MediumSettings::defaultConstant;
  vtkSetMacro(GladstoneDaleConstant, double);
  vtkGetMacro(GladstoneDaleConstant, double);
  ///@}

  ///@{
  /**
   * The gas, by a name or formula of vtkGasTable, whose constant at Wavelength is used instead of
   * GladstoneDaleConstant. Default: "Custom", no gas of the table.
   */
  vtkSetStdStringFromCharMacro(Gas);
  vtkGetCharFromStdStringMacro(Gas);
  ///@}

  /**
   * Returns the Gladstone-Dale constant in use, m^3/kg: that of Gas at Wavelength, or
   * GladstoneDaleConstant. NaN for an unknown gas.
   */
  double GetGladstoneDaleConstantUsed();

  ///@{
  /**
   * Factor from the density array to kg/m^3; 0 (the default): by the unit in the array's name,
   * such as "Density [g/cm3]" or "rho_gcc", or 1 without a unit.
   */
  vtkSetMacro(DensityScale, double);
  vtkGetMacro(DensityScale, double);
  ///@}

  ///@{
  /**
   * For mixtures: the arrays of the species' fractions, of the same association as the density.
   * The rest of the sum to 1 is the background gas. Default: none.
   */
  virtual void AddMixtureArray(const char* name);
  virtual void ClearMixtureArrays();
  ///@}

  ///@{
  /**
   * For mixtures: the Gladstone-Dale constants in m^3/kg, one for each array, not negative.
   */
  virtual void AddMixtureConstant(double constant);
  virtual void ClearMixtureConstants();
  ///@}

  ///@{
  /**
   * For mixtures: the species, by names or formulas of vtkGasTable, one for each array or none at
   * all. Their constants and molar masses come from the table, or from AddMixtureConstant and
   * AddMixtureMolarMass for species called "" or "Custom". Default: none.
   */
  virtual void AddMixtureGas(const char* name);
  virtual void ClearMixtureGases();
  ///@}

  ///@{
  /**
   * For mixtures by volume: the species' molar masses in kg/mol, one for each array, positive.
   */
  virtual void AddMixtureMolarMass(double molarMass);
  virtual void ClearMixtureMolarMasses();
  ///@}

  ///@{
  /**
   * For mixtures: the background gas's Gladstone-Dale constant in m^3/kg (default: 2.26e-4, air)
   * and molar mass in kg/mol (default: 0.0289647, air; for volume fractions).
   */
  vtkSetMacro(BackgroundConstant, double);
  vtkGetMacro(BackgroundConstant, double);
  vtkSetMacro(BackgroundMolarMass, double);
  vtkGetMacro(BackgroundMolarMass, double);
  ///@}

  ///@{
  /**
   * For mixtures: the background gas, by a name or formula of vtkGasTable, whose constant and
   * molar mass are used. Default: "Custom", no gas of the table.
   */
  vtkSetStdStringFromCharMacro(BackgroundGas);
  vtkGetCharFromStdStringMacro(BackgroundGas);
  ///@}

  ///@{
  /**
   * Kind of the mixture's fractions, one of FractionTypes. Default: MASS.
   */
  vtkSetClampMacro(FractionType, int, MASS, VOLUME);
  vtkGetMacro(FractionType, int);
  ///@}

  ///@{
  /**
   * Factors from the arrays of temperature and pressure to K and Pa; 0 (the default): by the unit
   * in the name, as for DensityScale.
   */
  vtkSetMacro(TemperatureScale, double);
  vtkGetMacro(TemperatureScale, double);
  vtkSetMacro(PressureScale, double);
  vtkGetMacro(PressureScale, double);
  ///@}

  ///@{
  /// Pressure in Pa that Ciddor's air has everywhere, as in a room, instead of an array; 0 (the
  /// default): an array.
  vtkSetMacro(UniformPressure, double);
  vtkGetMacro(UniformPressure, double);
  ///@}

  ///@{
  /**
   * Of air whose pressure changes without heat, such as a flow without strong shocks: its temperature, K, and pressure, Pa,
   * at rest. The array of the pressure then gives the temperature, T0 (p / p0)^(2/7), and none of the temperature is read.
   * A temperature of 0 (the default): an array. The default of the pressure is 101325.
   */
  vtkSetMacro(StagnationTemperature, double);
  vtkGetMacro(StagnationTemperature, double);
  vtkSetMacro(StagnationPressure, double);
  vtkGetMacro(StagnationPressure, double);
  ///@}

  ///@{
  /**
   * For moist air: the relative humidity, 0 to 1, used without an array of it (default: 0). Its
   * carbon dioxide is 450 parts per million.
   */
  vtkSetMacro(RelativeHumidity, double);
  vtkGetMacro(RelativeHumidity, double);
  ///@}

  ///@{
  /**
   * Wavelength of the light in vacuum, nanometres: 300 to 1700 for moist air, any for named gases
   * (with one warning outside of the range in which their constants were measured). Default:
   * 632.8.
   */
  vtkSetMacro(Wavelength, double);
  vtkGetMacro(Wavelength, double);
  ///@}

  ///@{
  /**
   * For transfer functions: the fields, all arrays of points or all of cells, any number. With
   * x_i, the field relative to its range, 0 to 1, N is RefractivityScale times the mean of
   * f_i(x_i). Default: none.
   */
  virtual void AddField(const char* name);
  virtual void ClearFields();
  ///@}

  ///@{
  /**
   * The functions f_i, one for each field, or none (the default): straight lines from 0 to 1, also
   * for functions that are null or have no points. Values may be any; x is between 0 and 1. Moving
   * a point modifies this filter.
   */
  virtual void AddTransferFunction(vtkPiecewiseFunction* function);
  virtual void ClearTransferFunctions();
  ///@}

  ///@{
  /**
   * The fields' ranges, two values for each, which map to 0 and 1; values beyond are clamped.
   * Empty (the default), or two equal values: the range of the field's finite, visible values over
   * all blocks in use.
   */
  virtual void AddFieldRange(double value);
  virtual void ClearFieldRanges();
  ///@}

  ///@{
  /**
   * For transfer functions: N if all of them are 1. Default: 3e-4.
   */
  vtkSetMacro(RefractivityScale, double);
  vtkGetMacro(RefractivityScale, double);
  ///@}

  ///@{
  /**
   * Points along x, y and z of the grid to which input other than images is resampled. An axis
   * that is 0 is chosen; with all three 0 (the default), along each axis as fine as the cell size
   * that 10 % of the cells are smaller than. Limits: 64^3 (2-D data: 64^2) to 256^3 points in all,
   * 32 for each point of the mesh, at least 2 along each axis. The 10 % grow until these are met.
   * If they are not met, or other axes are given, voxels have the proportions of those cells.
   *
   * Measured on meshes of 33 x 65 x 33 points, stretched towards a wall along y, with a Gaussian
   * layer of 6 (20) smallest cells there: largest error of the deflection, of its largest value,
   * 0.06 (0.03) at 1:10 and 0.09 (0.03) at 1:100. With cubic voxels, as many as points but at least
   * 64^3: 0.45 (0.02) and 0.57 (0.96).
   */
  vtkSetVector3Macro(SamplingDimensions, int);
  vtkGetVector3Macro(SamplingDimensions, int);
  ///@}

  ///@{
  /**
   * The box that the grid covers: lowest and highest x, y and z. Along an axis whose second bound
   * does not exceed the first (the default: all are 0) it covers all data. It is resampled to
   * SamplingDimensions, or as fine as its cells. An image keeps the points that cover the box; AMR
   * keeps such cells, and resamples them if dimensions are given.
   */
  vtkSetVector6Macro(SamplingBounds, double);
  vtkGetVector6Macro(SamplingBounds, double);
  ///@}

  /**
   * Returns the grid of the last conversion as text, with how it was chosen, such as "65 x 65 x 65
   * points: chosen from the sizes of the cells". Empty before the first and after a failed one.
   */
  const char* GetGrid() const;

  /**
   * Returns the arrays in use, with the factors of their units, and the fractions of a mixture,
   * such as "Density: 'rho'.".
   */
  const char* GetArraysUsed();

  /// Light in regions without cells.
  enum OutsideModes
  {
    OUTSIDE_AUTO = 0,
    OUTSIDE_BLOCKS = 1,
    OUTSIDE_PASSES = 2
  };

  ///@{
  /**
   * Light in regions of the data's bounding box that no cell covers, one of OutsideModes:
   * - OUTSIDE_AUTO (the default): bodies that the mesh leaves out stop it; outside of the mesh's
   *   outer boundary it goes straight on. A body is a hole that the mesh encloses, or that reaches
   *   the bounding box only at plane sides that the mesh reaches, too, such as a symmetry plane or
   *   a tunnel's floor.
   * - OUTSIDE_BLOCKS: all such regions stop it.
   * - OUTSIDE_PASSES: all of them let it pass. Give the surfaces of bodies to make them solid.
   *
   * Unless OUTSIDE_PASSES, walls without thickness within a mesh, whose sides have coincident
   * points of their own, stop light where the values at these differ.
   *
   * If light passes such regions, the output has a third point array `TransparentPointMask`
   * (unsigned char), 1 there (where vtkValidPointMask is 0), else 0. Images have cells everywhere,
   * but their point array `TransparentPointMask`, if there is one, is passed on.
   */
  vtkSetClampMacro(Outside, int, OUTSIDE_AUTO, OUTSIDE_PASSES);
  vtkGetMacro(Outside, int);
  ///@}

  ///@{
  /**
   * Depth of data in one plane, or one cell thick, in data units, half of it on each side of the
   * plane. Deflection and optical path are proportional to it. 0 (the default): the thickness of
   * the cells, or, for a plane, the length of its shorter side. Ignored with Symmetry.
   */
  vtkSetClampMacro(Depth, double, 0, VTK_DOUBLE_MAX);
  vtkGetMacro(Depth, double);
  ///@}

  /// Three-dimensional flows that 2-D data are a section of.
  enum Symmetries
  {
    NO_SYMMETRY = 0,
    AXISYMMETRIC = 1
  };
  /// What SetSymmetryAxis() takes.
  enum SymmetryAxes
  {
    AUTO_AXIS = 0,
    X_AXIS = 1,
    Y_AXIS = 2,
    Z_AXIS = 3
  };

  ///@{
  /**
   * Symmetry of data in one plane, or in a wedge of one cell between two planes through an axis.
   * NO_SYMMETRY (the default): the flow does not depend on the third coordinate. AXISYMMETRIC: a
   * body of revolution, of which no mesh is made; of data on both sides of the axis, the positive
   * side is used. Other data are an error.
   */
  vtkSetClampMacro(Symmetry, int, NO_SYMMETRY, AXISYMMETRIC);
  vtkGetMacro(Symmetry, int);
  ///@}

  ///@{
  /**
   * Direction of the symmetry axis, one of SymmetryAxes. AUTO_AXIS (the default): that of a wedge;
   * for a plane, the one of its two coordinate axes with the data on one side, touching it, and
   * smooth across it.
   */
  vtkSetClampMacro(SymmetryAxis, int, AUTO_AXIS, Z_AXIS);
  vtkGetMacro(SymmetryAxis, int);
  ///@}

  ///@{
  /**
   * A point of the symmetry axis. Default: (0, 0, 0).
   */
  vtkSetVector3Macro(SymmetryOrigin, double);
  vtkGetVector3Macro(SymmetryOrigin, double);
  ///@}

  /// Values of the array MASK that mark regions without gas.
  enum MaskedSides
  {
    MASKED_AUTO = -1,
    MASKED_ABOVE = 0,
    MASKED_BELOW = 1
  };

  ///@{
  /**
   * Regions without gas, by an array of points or cells (SetInputArrayToProcess(MASK, ...)): with
   * MASKED_ABOVE where it is MaskThreshold or more, such as an array `solid`; with MASKED_BELOW
   * where it is less, such as `iblank` or a cell's gas fraction; with MASKED_AUTO (the default) on
   * the side that the array's name means, above for unknown names. NaN is not gas, either. These
   * regions block light, and their values are not used: points are hidden, or cells if the field
   * belongs to cells (those with a hidden point). Blocks without the array are all gas; it is an
   * error if all blocks are.
   *
   * If no array is chosen, one is that has such a name and values on both sides of MaskThreshold;
   * GetArraysUsed() lists it. The name None chooses none.
   */
  vtkSetClampMacro(MaskedSide, int, MASKED_AUTO, MASKED_BELOW);
  vtkGetMacro(MaskedSide, int);
  ///@}

  ///@{
  /**
   * Threshold of MaskedSide. Default: 0.5.
   */
  vtkSetMacro(MaskThreshold, double);
  vtkGetMacro(MaskThreshold, double);
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
   * Threads for conversion and resampling; 0 (the default): VTK_SMP_MAX_THREADS if set, else the
   * cores that this process may use. The result does not depend on it, so setting it does not call
   * Modified().
   */
  void SetNumberOfThreads(int threads) { this->NumberOfThreads = threads < 0 ? 0 : threads; }
  vtkGetMacro(NumberOfThreads, int);
  ///@}

  /**
   * Counts the meshes prepared. Where the mesh is the same, as for other time steps and fields,
   * only what depends on the values is computed.
   */
  vtkTypeInt64 GetMeshBuilds();

  /**
   * Counts the grids chosen for inputs other than images, once for each set of properties.
   */
  vtkTypeInt64 GetGridPlans();

  /// Returns all of these properties.
  VTK_WRAPEXCLUDE MediumSettings GetSettings();

  /// Returns the maker of the medium, with the current settings.
  VTK_WRAPEXCLUDE filters::MediumMaker& GetMaker();

  vtkMTimeType GetMTime() override;

  /**
   * Makes the next RequestData() treat this rank as one without input, because something upstream
   * has failed; see vtkSchlierenPipeline.
   */
  VTK_WRAPEXCLUDE void LackInput();

  vtkTypeBool ProcessRequest(
    vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output) override;

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

  /// Newest time of this filter and of everything upstream at the last failure, and now.
  vtkMTimeType FailedAt = 0;
  vtkMTimeType GetTimeOfGrid();
  /// Reports a problem of the inputs and properties at time `now`, and empties the output.
  void Fail(const std::string& problem, vtkMTimeType now, vtkInformationVector* outputs);
  double RequestedTime = 0;

  std::shared_ptr<filters::MediumMaker> Maker;
  std::shared_ptr<filters::RequestGuard> Guard;
  std::shared_ptr<filters::InputsOfRanks> Ranks;
  std::string ArraysUsed;

  std::vector<vtkSmartPointer<vtkPiecewiseFunction>> Functions; // of TransferFunctions
  int NumberOfThreads = 0;
};

/// Forwards a property, or a list of them, to `inner`.
#define vtkForwardPropertyMacro(inner, name, type)                      \
  virtual void Set##name(type value) { this->inner->Set##name(value); } \
  virtual type Get##name() { return this->inner->Get##name(); }
#define vtkForwardListMacro(inner, one, all, type)                    \
  virtual void Add##one(type value) { this->inner->Add##one(value); } \
  virtual void Clear##all() { this->inner->Clear##all(); }
#define vtkForwardVectorMacro(inner, name, type, count)                                \
  virtual void Set##name(const type values[count]) { this->inner->Set##name(values); } \
  virtual type* Get##name() VTK_SIZEHINT(count) { return this->inner->Get##name(); }

/// Forwards all properties of the refractivity to the member `inner`, a vtkRefractiveIndex.
#define vtkRefractiveIndexForwardMacro(inner)                                             \
  vtkForwardPropertyMacro(inner, IndexModel, int);                                        \
  vtkForwardPropertyMacro(inner, Gas, const char*);                                       \
  vtkForwardPropertyMacro(inner, GladstoneDaleConstant, double);                          \
  vtkForwardPropertyMacro(inner, DensityScale, double);                                   \
  vtkForwardListMacro(inner, MixtureArray, MixtureArrays, const char*);                   \
  vtkForwardListMacro(inner, MixtureGas, MixtureGases, const char*);                      \
  vtkForwardListMacro(inner, MixtureConstant, MixtureConstants, double);                  \
  vtkForwardListMacro(inner, MixtureMolarMass, MixtureMolarMasses, double);               \
  vtkForwardPropertyMacro(inner, BackgroundGas, const char*);                             \
  vtkForwardPropertyMacro(inner, BackgroundConstant, double);                             \
  vtkForwardPropertyMacro(inner, BackgroundMolarMass, double);                            \
  vtkForwardPropertyMacro(inner, FractionType, int);                                      \
  vtkForwardPropertyMacro(inner, TemperatureScale, double);                               \
  vtkForwardPropertyMacro(inner, PressureScale, double);                                  \
  vtkForwardPropertyMacro(inner, UniformPressure, double);                                \
  vtkForwardPropertyMacro(inner, StagnationTemperature, double);                          \
  vtkForwardPropertyMacro(inner, StagnationPressure, double);                             \
  vtkForwardPropertyMacro(inner, RelativeHumidity, double);                               \
  vtkForwardListMacro(inner, Field, Fields, const char*);                                 \
  vtkForwardListMacro(inner, TransferFunction, TransferFunctions, vtkPiecewiseFunction*); \
  vtkForwardListMacro(inner, FieldRange, FieldRanges, double);                            \
  vtkForwardPropertyMacro(inner, RefractivityScale, double);                              \
  vtkForwardPropertyMacro(inner, MaskThreshold, double);                                  \
  vtkForwardPropertyMacro(inner, MaskedSide, int);                                        \
  vtkForwardPropertyMacro(inner, Depth, double);                                          \
  vtkForwardPropertyMacro(inner, Symmetry, int);                                          \
  vtkForwardPropertyMacro(inner, SymmetryAxis, int);                                      \
  vtkForwardVectorMacro(inner, SymmetryOrigin, double, 3);                                \
  virtual void SetSymmetryOrigin(double x, double y, double z)                            \
  {                                                                                       \
    this->inner->SetSymmetryOrigin(x, y, z);                                              \
  }                                                                                       \
  vtkForwardPropertyMacro(inner, Outside, int);                                           \
  vtkForwardVectorMacro(inner, SamplingDimensions, int, 3);                               \
  virtual void SetSamplingDimensions(int x, int y, int z)                                 \
  {                                                                                       \
    this->inner->SetSamplingDimensions(x, y, z);                                          \
  }                                                                                       \
  vtkForwardVectorMacro(inner, SamplingBounds, double, 6);                                \
  virtual void SetSamplingBounds(                                                         \
    double xLow, double xHigh, double yLow, double yHigh, double zLow, double zHigh)      \
  {                                                                                       \
    this->inner->SetSamplingBounds(xLow, xHigh, yLow, yHigh, zLow, zHigh);                \
  }

#endif
