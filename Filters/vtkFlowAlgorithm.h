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

  // setters: rest
  /// Values of IndexModel.
  enum IndexModels
  {
    AUTO = -1,
    GLADSTONE_DALE = 0,
    REFRACTIVE_INDEX = 1,
    REFRACTIVITY = 2,
    GLADSTONE_DALE_MIXTURE = 3,
    CIDDOR = 4,
    TRANSFER_FUNCTIONS = 5,
    WATER = 6,
    ELECTRON_DENSITY = 7
  };

  /// How the refractivity N = n - 1 is found. Default: Auto.
  vtkSetClampMacro(IndexModel, int, AUTO, ELECTRON_DENSITY);
  vtkGetMacro(IndexModel, int);

  /// The gas whose Gladstone-Dale constant at Wavelength is used, by name or, in scripts, by
  /// formula (He). Default: air.
  vtkSetStdStringFromCharMacro(Gas);
  vtkGetCharFromStdStringMacro(Gas);

  /// K in N = K times density, in m^3/kg (Gladstone and Dale 1863), of a gas that is not in the
  /// list of Gas; 0: that of Gas. Default: 0.
  vtkSetMacro(GladstoneDaleConstant, double);
  vtkGetMacro(GladstoneDaleConstant, double);

  /// Factor that turns the density array into kg/m^3; 0: that of the unit in the array's name, such
  /// as Density [g/cm3] or rho_gcc, or 1 where there is none. Default: 0.
  vtkSetMacro(DensityScale, double);
  vtkGetMacro(DensityScale, double);

  /// The names of the arrays with the fractions of the species, for points or cells like the
  /// density. Default: none.
  void AddMixtureArray(const char* text)
  {
    this->MixtureArrays.emplace_back(text ? text : "");
    this->Modified();
  }
  void ClearMixtureArrays()
  {
    this->MixtureArrays.clear();
    this->Modified();
  }

  /// What the species are, in the order of Mixture Arrays: names or formulas as for Gas, or
  /// numbers: the Gladstone-Dale constant in m^3/kg and, for volume fractions, a space and the
  /// molar mass in kg/mol, such as 2.3e-4 0.044. Default: none.
  void AddMixtureGas(const char* text)
  {
    this->MixtureGases.emplace_back(text ? text : "");
    this->Modified();
  }
  void ClearMixtureGases()
  {
    this->MixtureGases.clear();
    this->Modified();
  }

  /// The gas that makes up the rest of a mixture: a name, a formula or numbers as in Mixture Gases.
  /// Default: air.
  vtkSetStdStringFromCharMacro(BackgroundGas);
  vtkGetCharFromStdStringMacro(BackgroundGas);

  /// Values of FractionType.
  enum FractionTypes
  {
    MASS = 0,
    VOLUME = 1
  };

  /// What the arrays are fractions of: Mass, or Volume, that is moles, which also uses the gases'
  /// molar masses. Default: Mass.
  vtkSetClampMacro(FractionType, int, MASS, VOLUME);
  vtkGetMacro(FractionType, int);

  /// Factor that turns the pressure array into Pa; 0: that of the unit in the array's name, such as
  /// p_hPa, or 1 where there is none. Default: 0.
  vtkSetMacro(PressureScale, double);
  vtkGetMacro(PressureScale, double);

  /// Pressure of air or of a mixture that is the same everywhere, in Pa, as around a heater or a
  /// fire in a room (101325); then a temperature is enough, and no array of the pressure is read.
  /// 0: the pressure is an array. Default: 0.
  vtkSetMacro(UniformPressure, double);
  vtkGetMacro(UniformPressure, double);

  /// Temperature at rest, K, of air whose pressure changes without heat, such as a flow without
  /// strong shocks (293.15 in a room); then a pressure is enough, and no array of the temperature
  /// is read: it is this times (p / Stagnation Pressure)^(2/7). 0: the temperature is an array.
  /// Default: 0.
  vtkSetMacro(StagnationTemperature, double);
  vtkGetMacro(StagnationTemperature, double);

  /// Pressure of this air at rest, Pa; more than 0. Default: 101325.
  vtkSetMacro(StagnationPressure, double);
  vtkGetMacro(StagnationPressure, double);

  /// Relative humidity, 0 to 1, where no array of it is chosen; 0 is dry air. Default: 0.
  vtkSetMacro(RelativeHumidity, double);
  vtkGetMacro(RelativeHumidity, double);

  /// Wavelength of the light in vacuum, nanometres: of gases chosen by name, of moist air (300 to
  /// 1700), of electrons, and in images of an interferogram and of waves (Light Model). 632.8 is a
  /// helium-neon laser. Default: 632.8.
  vtkSetMacro(Wavelength, double);
  vtkGetMacro(Wavelength, double);

  /// The names of the arrays to map through Transfer Functions, any number, all of points or all of
  /// cells. Default: none.
  void AddField(const char* text)
  {
    this->Fields.emplace_back(text ? text : "");
    this->Modified();
  }
  void ClearFields()
  {
    this->Fields.clear();
    this->Modified();
  }

  /// Two values for each of the Fields, which are mapped to 0 and 1; values beyond are clamped.
  /// Default: none.
  void AddFieldRange(double value)
  {
    this->FieldRanges.emplace_back(value);
    this->Modified();
  }
  void ClearFieldRanges()
  {
    this->FieldRanges.clear();
    this->Modified();
  }

  /// The refractivity where all Transfer Functions are 1: N = scale times their mean. 3e-4 is about
  /// that of air. Default: 3e-4.
  vtkSetMacro(RefractivityScale, double);
  vtkGetMacro(RefractivityScale, double);

  // end

  ///@{
  /// The functions f_i, one for each field, or none (the default): straight lines from 0 to 1, also
  /// for functions that are null or have no points. Values may be any; x is between 0 and 1. Moving
  /// a point modifies this filter.
  virtual void AddTransferFunction(vtkPiecewiseFunction* function);
  virtual void ClearTransferFunctions();
  ///@}

  /// Returns the arrays in use, with the factors of their units, and the fractions of a mixture,
  /// such as "Density: 'rho'.".
  const char* GetArraysUsed();

  /// Light in regions without cells.
  enum OutsideModes
  {
    OUTSIDE_AUTO = 0,
    OUTSIDE_BLOCKS = 1,
    OUTSIDE_PASSES = 2
  };

  ///@{
  /// Light in regions of the data's bounding box that no cell covers, one of OutsideModes:
  /// - OUTSIDE_AUTO (the default): places that hang together are treated alike. They are a body,
  ///   which stops light, if the mesh encloses them, or if they reach the sides of the mesh's box
  ///   only at sides in which the mesh has flat faces, too, such as a symmetry plane or a tunnel's
  ///   floor. Otherwise light goes straight on.
  /// - OUTSIDE_BLOCKS: all such regions stop it.
  /// - OUTSIDE_PASSES: all of them let it pass. Give the surfaces of bodies to make them solid.
  ///
  /// Unless OUTSIDE_PASSES, walls without thickness within a mesh, whose sides have coincident
  /// points of their own, stop light where the values at these differ.
  vtkSetClampMacro(Outside, int, OUTSIDE_AUTO, OUTSIDE_PASSES);
  vtkGetMacro(Outside, int);
  ///@}

  ///@{
  /// Depth of data in one plane, or one cell thick, in data units, half of it on each side of the
  /// plane. Deflection and optical path are proportional to it. 0 (the default): the thickness of
  /// the cells, or, for a plane, the length of its shorter side, or a part of it in which the flow
  /// has room. Ignored with Symmetry.
  vtkSetClampMacro(Depth, double, 0, VTK_DOUBLE_MAX);
  vtkGetMacro(Depth, double);
  ///@}

  /// Counts the meshes prepared. Where the mesh is the same, as for other time steps and fields,
  /// only what depends on the values is computed.
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
