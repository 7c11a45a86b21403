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
 * - `vtkValidPointMask` (unsigned char): 0 in solids and outside the input, else 1;
 * and, where light goes straight on at places without gas, a third one, `TransparentPointMask` (see Outside).
 *
 * An image keeps its own grid, oriented ones included: point arrays are taken as they stand, cell
 * arrays on the grid of the cells' centres, so that nothing is smoothed. Data in one plane across a
 * coordinate axis, or one cell thick along it, are extruded along it (see Depth), or revolved (see Symmetry), with a
 * warning. Blocks of images that hold
 * cell arrays (AMR, overlapping or not) become such a grid, of the finest level's cells; around finer
 * blocks coarser ones are interpolated by their cells' means, without a seam. All other input is
 * sampled on a grid (see SamplingDimensions): each of its points takes what the tracer would find there. Only cells with a volume
 * count: surfaces in a composite are left out, and so are blocks that lack an array. Where several
 * arrays are needed, all of them belong to points or all to cells; the refractivity is formed there,
 * before anything is resampled.
 *
 * Invalid (mask 0) are NaN and infinite values, states that no gas can have (T <= 0), hidden points and cells (vtkGhostType), points whose
 * `vtkValidPointMask` in the input is 0, and places that no cell covers. On images, a point is
 * hidden if all its cells are, and so are all points of a hidden cell that would otherwise vanish.
 *
 * The second input, optional, holds the surfaces of bodies (vtkPolyData or composites of it): points
 * in and on closed ones, whatever the orientation of their faces, and points within 0.87 voxels of open ones are
 * masked. Bodies may overlap, enclose each other and reach out of the data.
 *
 * IndexModel chooses how N is found. An image that already holds a point array `Refractivity` is
 * used as it stands where IndexModel is not REFRACTIVE_INDEX and the (first) array that it needs is
 * missing, not chosen, or `Refractivity` itself: so the output of this filter can be handed on.
 *
 * The field data hold `SamplingDimensions`, the grid that was used.
 *
 * Mistakes (no such array, empty input, no valid value, ...) end in one error and an empty output. One
 * warning names points where the model is outside its range, or fractions add up to more than 1.
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

  /// How the refractivity N is found. The numbers are part of the interface.
  enum IndexModels
  {
    /// What the arrays are for: with a density (chosen, or known by its name) GLADSTONE_DALE, or GLADSTONE_DALE_MIXTURE where
    /// there are fractions of known gases and Gas and GladstoneDaleConstant are as they were; else REFRACTIVITY,
    /// REFRACTIVE_INDEX or CIDDOR
    AUTO = -1,
    GLADSTONE_DALE = 0,   ///< N = K rho (Gladstone & Dale 1863); array 0 is the density rho
    REFRACTIVE_INDEX = 1, ///< N = n - 1; array 1 is n
    REFRACTIVITY = 2,     ///< array 1 is N
    /// N = rho sum K_i Y_i: array 0 is rho, and see AddMixtureArray
    GLADSTONE_DALE_MIXTURE = 3,
    /// Moist air (Ciddor 1996): arrays 2, 3 and 4 are temperature, pressure and humidity
    CIDDOR = 4,
    /// Several fields through a curve each: N = scale mean f_i, see AddField
    TRANSFER_FUNCTIONS = 5
  };

  /// The arrays that SetInputArrayToProcess can choose.
  enum InputArrays
  {
    DENSITY = 0,
    INDEX_ARRAY = 1,
    TEMPERATURE = 2,
    PRESSURE = 3,
    HUMIDITY = 4, ///< not chosen, "" or "None": RelativeHumidity
    MASK = 5      ///< not chosen, "" or "None": there is gas in all visible cells
  };

  /// What the mixture's arrays are fractions of.
  enum FractionTypes
  {
    MASS = 0,
    VOLUME = 1 ///< or of moles
  };

  ///@{
  /**
   * How the refractivity is found from the arrays, one of IndexModels. Default: AUTO.
   * The arrays are chosen with SetInputArrayToProcess, see InputArrays; names that are not found with
   * the association given (by the first array of a model) are looked for with the other one. An array that is not
   * chosen is that whose name says that it is what the model needs, see flowDefaults(); GetArraysUsed() names it. Where
   * no name does, that is an error, which lists the arrays.
   */
  vtkSetClampMacro(IndexModel, int, AUTO, TRANSFER_FUNCTIONS);
  vtkGetMacro(IndexModel, int);
  ///@}

  ///@{
  /**
   * Gladstone-Dale constant K in m^3/kg. Default: DefaultGladstoneDaleConstant (air, visible light).
   * Gladstone & Dale 1863, Phil. Trans. R. Soc. 153, 317.
   */
  static constexpr double DefaultGladstoneDaleConstant = MediumSettings::defaultConstant;
  vtkSetMacro(GladstoneDaleConstant, double);
  vtkGetMacro(GladstoneDaleConstant, double);
  ///@}

  ///@{
  /**
   * The gas, by a name or formula of vtkGasTable: its constant at Wavelength then takes the place of
   * GladstoneDaleConstant. Default: "Custom", no gas of the table.
   */
  vtkSetStdStringFromCharMacro(Gas);
  vtkGetCharFromStdStringMacro(Gas);
  ///@}

  /**
   * The Gladstone-Dale constant that counts, m^3/kg: that of Gas at Wavelength, or else
   * GladstoneDaleConstant. NaN where there is no such gas.
   */
  double GetGladstoneDaleConstantUsed();

  ///@{
  /**
   * Factor that turns the density array into kg/m^3; 0 (the default): that of the unit in the array's name, as in
   * "Density [g/cm3]" or "rho_gcc", or 1 where it has none.
   */
  vtkSetMacro(DensityScale, double);
  vtkGetMacro(DensityScale, double);
  ///@}

  ///@{
  /**
   * For mixtures: the arrays with the fractions of the species, of the same association as the
   * density. What they leave of 1 is the background gas. Default: none.
   */
  virtual void AddMixtureArray(const char* name);
  virtual void ClearMixtureArrays();
  ///@}

  ///@{
  /**
   * For mixtures: the species' Gladstone-Dale constants in m^3/kg, one for each array, not negative.
   */
  virtual void AddMixtureConstant(double constant);
  virtual void ClearMixtureConstants();
  ///@}

  ///@{
  /**
   * For mixtures: what the species are, by names or formulas of vtkGasTable, one for each array or
   * none at all. The table then gives their constants and molar masses; those of AddMixtureConstant and
   * AddMixtureMolarMass count for species called "" or "Custom". Default: none.
   */
  virtual void AddMixtureGas(const char* name);
  virtual void ClearMixtureGases();
  ///@}

  ///@{
  /**
   * For mixtures of which volume fractions are given: the species' molar masses in kg/mol, one for
   * each array, positive.
   */
  virtual void AddMixtureMolarMass(double molarMass);
  virtual void ClearMixtureMolarMasses();
  ///@}

  ///@{
  /**
   * For mixtures: the background gas's Gladstone-Dale constant in m^3/kg (default: 2.26e-4, air) and
   * molar mass in kg/mol (default: 0.0289647, air; for volume fractions).
   */
  vtkSetMacro(BackgroundConstant, double);
  vtkGetMacro(BackgroundConstant, double);
  vtkSetMacro(BackgroundMolarMass, double);
  vtkGetMacro(BackgroundMolarMass, double);
  ///@}

  ///@{
  /**
   * For mixtures: the background gas, by a name or formula of vtkGasTable, whose constant and molar
   * mass then count. Default: "Custom", no gas of the table.
   */
  vtkSetStdStringFromCharMacro(BackgroundGas);
  vtkGetCharFromStdStringMacro(BackgroundGas);
  ///@}

  ///@{
  /**
   * What the mixture's arrays are fractions of, one of FractionTypes. Default: MASS.
   */
  vtkSetClampMacro(FractionType, int, MASS, VOLUME);
  vtkGetMacro(FractionType, int);
  ///@}

  ///@{
  /**
   * Factors that turn the arrays of temperature and pressure into K and Pa; 0 (the default): as of DensityScale.
   */
  vtkSetMacro(TemperatureScale, double);
  vtkGetMacro(TemperatureScale, double);
  vtkSetMacro(PressureScale, double);
  vtkGetMacro(PressureScale, double);
  ///@}

  ///@{
  /**
   * For moist air: the relative humidity, 0 to 1, where no array of it is chosen (default: 0), and the
   * carbon dioxide in parts per million (default: 450).
   */
  vtkSetMacro(RelativeHumidity, double);
  vtkGetMacro(RelativeHumidity, double);
  vtkSetMacro(CO2, double);
  vtkGetMacro(CO2, double);
  ///@}

  ///@{
  /**
   * Wavelength of the light in vacuum, nanometres: for moist air 300 to 1700, for gases chosen by
   * name any (one warning says where their constants were not measured). Default: 632.8.
   */
  vtkSetMacro(Wavelength, double);
  vtkGetMacro(Wavelength, double);
  ///@}

  ///@{
  /**
   * For transfer functions: the fields, all arrays of points or all of cells, any number. Where the
   * field x_i is between 0 and 1 in its range, N = RefractivityScale times the mean of f_i(x_i).
   * Default: none.
   */
  virtual void AddField(const char* name);
  virtual void ClearFields();
  ///@}

  ///@{
  /**
   * The functions f_i, one for each field, or none (the default): straight lines from 0 to 1. So is a
   * function that is null or has no points. The functions' values may be any; those of x between 0
   * and 1 are used. A point that is moved counts as a change of this filter.
   */
  virtual void AddTransferFunction(vtkPiecewiseFunction* function);
  virtual void ClearTransferFunctions();
  ///@}

  ///@{
  /**
   * The fields' ranges, two values for each: what becomes 0 and 1; values beyond are clamped. Empty
   * (the default), or two equal values: the field's own range, over all blocks that are used and all
   * values that are finite and not hidden.
   */
  virtual void AddFieldRange(double value);
  virtual void ClearFieldRanges();
  ///@}

  ///@{
  /**
   * For transfer functions: N where all of them are 1. Default: 3e-4.
   */
  vtkSetMacro(RefractivityScale, double);
  vtkGetMacro(RefractivityScale, double);
  ///@}

  /**
   * Whether an array is chosen for the humidity.
   */
  bool HasHumidityArray();

  ///@{
  /**
   * Points along x, y and z of the grid to which other input than images is resampled. An axis that
   * is 0 is chosen; with all three 0 (the default) as fine along each axis as the cells that a tenth
   * of all is smaller than. Limits: 64^3 (2-D data: 64^2) to 256^3 points in all, 32 for each point of
   * the mesh, at least 2 along each axis. Where that is too much, the tenth grows until it fits. Where
   * a limit is met all the same, or other axes are given, voxels have the proportions of those cells.
   *
   * Measured on meshes of 33 x 65 x 33 points, stretched towards a wall along y, with a Gaussian layer
   * of 6 (20) smallest cells there: largest error of the deflection, of its largest value, 0.06 (0.03)
   * at 1:10 and 0.09 (0.03) at 1:100. With cubic voxels, as many as points but at least 64^3: 0.45
   * (0.02) and 0.57 (0.96).
   */
  vtkSetVector3Macro(SamplingDimensions, int);
  vtkGetVector3Macro(SamplingDimensions, int);
  ///@}

  ///@{
  /**
   * The box that the grid covers: lowest and highest x, y and z. Along an axis whose second number is not larger than the
   * first (the default: all are 0) it covers all of the data. It is resampled to SamplingDimensions, or as fine as the
   * cells in it. An image keeps its points, those that cover the box; of AMR it is so with cells, before they are
   * resampled where dimensions are given.
   */
  vtkSetVector6Macro(SamplingBounds, double);
  vtkGetVector6Macro(SamplingBounds, double);
  ///@}

  /**
   * The grid of the last conversion in words, with how it was chosen, for example "65 x 65 x 65 points:
   * chosen from the sizes of the cells". Empty before the first and after a failed one.
   */
  const char* GetGrid() const;

  /**
   * The arrays that are used, with the factors of their units, and the fractions of a mixture: for example "Density: 'rho'.".
   */
  const char* GetArraysUsed();

  /// What becomes of light at places that no cell covers.
  enum OutsideModes
  {
    OUTSIDE_AUTO = 0,
    OUTSIDE_BLOCKS = 1,
    OUTSIDE_PASSES = 2
  };

  ///@{
  /**
   * What becomes of light at places of the data's box that no cell covers, one of OutsideModes:
   * - OUTSIDE_AUTO (the default): bodies that the mesh leaves out stop it; beyond the mesh's outer boundary it goes
   *   straight on. A body is a hole that the mesh encloses, or that reaches the box of the data only at
   *   plane sides of it that the mesh has, too, such as a symmetry plane or the floor of a tunnel.
   * - OUTSIDE_BLOCKS: all of them stop it.
   * - OUTSIDE_PASSES: it goes straight on in all of them. Give the surfaces of bodies to make them solid.
   *
   * Unless it is OUTSIDE_PASSES, walls without thickness within a mesh, whose sides have points of their own at the same
   * places, stop light where the values at these differ.
   *
   * This filter's output, a grid, has a third point array `TransparentPointMask` (unsigned char) if light goes straight on
   * somewhere, 1 there (where vtkValidPointMask stays 0), else 0. It concerns input that is sampled; an image has cells
   * everywhere, but its point array
   * `TransparentPointMask`, if there is one, is passed on.
   */
  vtkSetClampMacro(Outside, int, OUTSIDE_AUTO, OUTSIDE_PASSES);
  vtkGetMacro(Outside, int);
  ///@}

  ///@{
  /**
   * The same, as older scripts have it: 0 is OUTSIDE_PASSES, 1 is OUTSIDE_BLOCKS; less than 0 changes nothing.
   */
  void SetOutsideBlocksLight(int blocks)
  {
    if (blocks >= 0)
    {
      this->SetOutside(blocks > 0 ? OUTSIDE_BLOCKS : OUTSIDE_PASSES);
    }
  }
  bool GetOutsideBlocksLight() { return this->Outside != OUTSIDE_PASSES; }
  void OutsideBlocksLightOn() { this->SetOutsideBlocksLight(1); }
  void OutsideBlocksLightOff() { this->SetOutsideBlocksLight(0); }
  ///@}

  ///@{
  /**
   * How deep data in one plane, or one cell thick, are, in data units: half of it is on each side of the plane. Deflection and
   * optical path are in proportion to it. 0 (the default): of data that are one cell thick what their cells are, of a plane
   * what its shorter side is long. Of no effect with Symmetry.
   */
  vtkSetClampMacro(Depth, double, 0, VTK_DOUBLE_MAX);
  vtkGetMacro(Depth, double);
  ///@}

  /// What 2-D data are a section of.
  enum Symmetries
  {
    NO_SYMMETRY = 0,
    AXISYMMETRIC = 1
  };
  enum SymmetryAxes
  {
    AUTO_AXIS = 0,
    X_AXIS = 1,
    Y_AXIS = 2,
    Z_AXIS = 3
  };

  ///@{
  /**
   * What data in one plane, or in a wedge of one cell between two planes through an axis, stand for. NO_SYMMETRY (the
   * default): a flow that does not depend on the third coordinate. AXISYMMETRIC: a body of revolution; no mesh of it is made.
   * Of data on both sides of the axis those of the positive one are used. Other data are an error.
   */
  vtkSetClampMacro(Symmetry, int, NO_SYMMETRY, AXISYMMETRIC);
  vtkGetMacro(Symmetry, int);
  ///@}

  ///@{
  /**
   * The direction of the axis of symmetry, one of SymmetryAxes. AUTO_AXIS (the default): that of a wedge; of a plane the one of
   * its two coordinate axes that the data lie on one side of, touch, and continue smoothly across.
   */
  vtkSetClampMacro(SymmetryAxis, int, AUTO_AXIS, Z_AXIS);
  vtkGetMacro(SymmetryAxis, int);
  ///@}

  ///@{
  /**
   * A point of the axis of symmetry. Default: (0, 0, 0).
   */
  vtkSetVector3Macro(SymmetryOrigin, double);
  vtkGetVector3Macro(SymmetryOrigin, double);
  ///@}

  /// Which values of the array MASK say that there is no gas.
  enum MaskedSides
  {
    MASKED_ABOVE = 0,
    MASKED_BELOW = 1
  };

  ///@{
  /**
   * Where there is no gas, by an array of points or cells (SetInputArrayToProcess(MASK, ...)): with MASKED_ABOVE (the
   * default) where its values are MaskThreshold or more, as of an array `solid`; with MASKED_BELOW where they are less,
   * as of `iblank` or the fraction of a cell that is gas. NaN is no gas, either. Such places block light and
   * what values they have is not used: they are hidden points, and hidden cells if the field belongs to cells (those with a
   * hidden point). Blocks without the array have gas everywhere; it is an error if all are.
   */
  vtkSetClampMacro(MaskedSide, int, MASKED_ABOVE, MASKED_BELOW);
  vtkGetMacro(MaskedSide, int);
  bool HasMaskArray();
  ///@}

  ///@{
  /**
   * See MaskedSide. Default: 0.5.
   */
  vtkSetMacro(MaskThreshold, double);
  vtkGetMacro(MaskThreshold, double);
  ///@}

  /// What lies between the points of a mesh.
  enum Reconstructions
  {
    SMOOTH = 0,
    LINEAR_IN_CELLS = 1
  };

  ///@{
  /**
   * What lies between the points of a mesh, one of Reconstructions: SMOOTH (the default) is
   * exact for quadratic fields, by gradients at the points (least squares), and stays within the values around a
   * cell; LINEAR_IN_CELLS is the cells' own interpolation, whose gradient jumps from cell to cell, which a
   * shadowgraph shows.
   */
  vtkSetClampMacro(Reconstruction, int, SMOOTH, LINEAR_IN_CELLS);
  vtkGetMacro(Reconstruction, int);
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
   * else the cores that this process may use. The result does not depend on it; so setting it does not call Modified().
   */
  void SetNumberOfThreads(int threads) { this->NumberOfThreads = threads < 0 ? 0 : threads; }
  vtkGetMacro(NumberOfThreads, int);
  ///@}

  /**
   * How often the mesh of the data was another one than before: where it is the same, as other time steps and fields have it,
   * only what depends on the values is made.
   */
  vtkTypeInt64 GetMeshBuilds();

  /**
   * How often a grid was chosen for the input, images apart: once for each input and set of properties.
   */
  vtkTypeInt64 GetGridPlans();

  /// All of these properties.
  VTK_WRAPEXCLUDE MediumSettings GetSettings();

  /// What makes the medium, with the settings of now.
  VTK_WRAPEXCLUDE filters::MediumMaker& GetMaker();

  vtkMTimeType GetMTime() override;

  /**
   * Says that this rank has no input in the next RequestData(), because something upstream has failed; see vtkSchlierenPipeline.
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

  /// Newest time of this filter and of everything upstream when it last failed; and now.
  vtkMTimeType FailedAt = 0;
  vtkMTimeType GetTimeOfGrid();
  /// Reports a problem of the inputs and properties of a time, and leaves the output empty.
  void Fail(const std::string& problem, vtkMTimeType now, vtkInformationVector* outputs);
  double RequestedTime = 0;

  std::shared_ptr<filters::MediumMaker> Maker;
  std::shared_ptr<filters::RequestGuard> Guard;
  std::shared_ptr<filters::InputsOfRanks> Ranks;
  std::string ArraysUsed;

  std::vector<vtkSmartPointer<vtkPiecewiseFunction>> Functions; // of TransferFunctions
  int NumberOfThreads = 0;
};

/// A property that is that of `inner`, and a list of them.
#define vtkForwardPropertyMacro(inner, name, type)                      \
  virtual void Set##name(type value) { this->inner->Set##name(value); } \
  virtual type Get##name() { return this->inner->Get##name(); }
#define vtkForwardListMacro(inner, one, all, type)                    \
  virtual void Add##one(type value) { this->inner->Add##one(value); } \
  virtual void Clear##all() { this->inner->Clear##all(); }
#define vtkForwardVectorMacro(inner, name, type, count)                                \
  virtual void Set##name(const type values[count]) { this->inner->Set##name(values); } \
  virtual type* Get##name() VTK_SIZEHINT(count) { return this->inner->Get##name(); }

/// All properties that say what the refractivity is, for a filter that has a vtkRefractiveIndex, its member `inner`.
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
  vtkForwardPropertyMacro(inner, RelativeHumidity, double);                               \
  vtkForwardPropertyMacro(inner, CO2, double);                                            \
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
  vtkForwardPropertyMacro(inner, OutsideBlocksLight, int);                                \
  vtkForwardPropertyMacro(inner, Reconstruction, int);                                    \
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
