// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkFlowAlgorithm
 * @brief   base of filters that read the refractivity of a flow: which arrays, of which gas
 *
 * The input is any vtkDataSet, or a composite of them. If several arrays are needed, all of them belong to points or
 * all to cells; the refractivity is computed there. Invalid are NaN and infinite values, states that no gas can have
 * (T <= 0), hidden points and cells (vtkGhostType), and points whose `vtkValidPointMask` in the input is 0.
 *
 * IndexModel chooses how N is found. An image with a point array `Refractivity` is used unchanged
 * if IndexModel is not REFRACTIVE_INDEX and the (first) array that it needs is missing, not chosen,
 * or `Refractivity` itself.
 *
 * @sa vtkSchlierenFilter vtkRefractiveIndex
 */

#ifndef vtkFlowAlgorithm_h
#define vtkFlowAlgorithm_h

#include "MediumSettings.h" // for the values of the properties
#include "vtkDataObjectAlgorithm.h"
#include "vtkSchlierenFiltersModule.h" // for export macro
#include "vtkSmartPointer.h"           // for TransferFunctions

#include <memory> // for Maker
#include <string> // for std::string
#include <vector> // for std::vector

class vtkPiecewiseFunction;

namespace filters
{
class MediumMaker;
} // namespace filters

class VTKSCHLIERENFILTERS_EXPORT vtkFlowAlgorithm : public vtkDataObjectAlgorithm,
                                                    protected MediumSettings
{
public:
  vtkTypeMacro(vtkFlowAlgorithm, vtkDataObjectAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// The input ports. BODIES is optional, and vtkRefractiveIndex has none.
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
   * For mixtures: the species, one for each array, by names or formulas of vtkGasTable, or by
   * numbers: the Gladstone-Dale constant in m^3/kg and, for volume fractions, the molar mass in
   * kg/mol, such as "2.3e-4 0.044". Default: none.
   */
  virtual void AddMixtureGas(const char* name);
  virtual void ClearMixtureGases();
  ///@}

  ///@{
  /**
   * For mixtures: the background gas, given as those of AddMixtureGas() are. Default: "air".
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
   * Factor from the array of the pressure to Pa; 0 (the default): by the unit in the name, as for
   * DensityScale. Temperatures are in K, or in the unit in the array's name.
   */
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
   * MASKED_ABOVE where it is 0.5 or more, such as an array `solid`; with MASKED_BELOW
   * where it is less, such as `iblank` or a cell's gas fraction; with MASKED_AUTO (the default) on
   * the side that the array's name means, above for unknown names. NaN is not gas, either. These
   * regions block light, and their values are not used: points are hidden, or cells if the field
   * belongs to cells (those with a hidden point). Blocks without the array are all gas; it is an
   * error if all blocks are.
   *
   * If no array is chosen, one is that has such a name and values on both sides of 0.5;
   * GetArraysUsed() lists it. The name None chooses none.
   */
  vtkSetClampMacro(MaskedSide, int, MASKED_AUTO, MASKED_BELOW);
  vtkGetMacro(MaskedSide, int);
  ///@}

  /**
   * Counts the meshes prepared. Where the mesh is the same, as for other time steps and fields,
   * only what depends on the values is computed.
   */
  vtkTypeInt64 GetMeshBuilds();

  /// Returns all of these properties.
  VTK_WRAPEXCLUDE MediumSettings GetMediumSettings();

  /// Returns the maker of the medium, with the current settings.
  VTK_WRAPEXCLUDE virtual filters::MediumMaker& GetMaker();

  vtkMTimeType GetMTime() override;

protected:
  vtkFlowAlgorithm();
  ~vtkFlowAlgorithm() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestDataObject(
    vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output) override;

  /// Reports the completed fraction of the medium. Returns whether to continue.
  virtual bool ReportMedium(double done);

private:
  vtkFlowAlgorithm(const vtkFlowAlgorithm&) = delete;
  void operator=(const vtkFlowAlgorithm&) = delete;

  std::shared_ptr<filters::MediumMaker> Maker;
  std::string ArraysUsed;
  std::vector<vtkSmartPointer<vtkPiecewiseFunction>> Functions; // of TransferFunctions
};

#endif
