// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef MediumSettings_h
#define MediumSettings_h

#include <array>
#include <iosfwd>
#include <string>
#include <vector>

/// An array chosen for a property.
struct ArraySelection
{
  std::string name;        ///< empty: by attribute, or none
  int attribute = -1;      ///< one of vtkDataSetAttributes::AttributeTypes; -1: by name
  bool cellsFirst = false; ///< whether arrays of cells are searched before those of points

  /// Returns whether the user has chosen an array.
  bool isChosen() const { return !this->name.empty() || this->attribute >= 0; }
  /// Returns whether an array is named, other than the entry None of a list.
  bool isNamed() const { return !this->name.empty() && this->name != "None"; }

  bool operator==(const ArraySelection& other) const
  {
    return this->name == other.name && this->attribute == other.attribute &&
      this->cellsFirst == other.cellsFirst;
  }
};

/// The points of a vtkPiecewiseFunction; empty: a straight line from 0 to 1.
struct TransferCurve
{
  std::vector<std::array<double, 4>> nodes; ///< x, value, midpoint and sharpness
  bool isClamped = true;
  bool isLogarithmic = false;

  bool operator==(const TransferCurve& other) const
  {
    return this->nodes == other.nodes && this->isClamped == other.isClamped &&
      this->isLogarithmic == other.isLogarithmic;
  }
};

/// Values of the properties of vtkFlowAlgorithm under their names; see the filter for their
/// meaning, and its setters for their ranges. Equal settings and data give the same medium.
struct MediumSettings
{
  // values: IndexModel
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

  // end

  /// Indices of Arrays; see vtkFlowAlgorithm::InputArrays.
  enum ArrayIndex
  {
    DensityArray = 0,
    IndexArray = 1,
    TemperatureArray = 2,
    PressureArray = 3,
    HumidityArray = 4,
    MaskArray = 5
  };

  /// The names of the properties that choose Arrays.
  static constexpr const char* arrayProperties[] = { "Density", "IndexArray", "Temperature",
    "Pressure", "Humidity", "Mask" };

  /// Between gas and bodies in a mask.
  static constexpr double maskThreshold = 0.5;

  std::array<ArraySelection, 6> Arrays;
  std::vector<TransferCurve> TransferFunctions;
  int Symmetry = -1;
  int SymmetryAxis = 0;
  double SymmetryOrigin[3] = { 0, 0, 0 };
  double Depth = 0;
  int Outside = 0;
  bool DoublePrecision = false;
  // members: rest
  int IndexModel = -1;
  std::string Gas = "air";
  double GladstoneDaleConstant = 0;
  double DensityScale = 0;
  std::vector<std::string> MixtureArrays;
  std::vector<std::string> MixtureGases;
  std::string BackgroundGas = "air";
  int FractionType = 0;
  double PressureScale = 0;
  double UniformPressure = 0;
  double StagnationTemperature = 0;
  double StagnationPressure = 101325;
  double RelativeHumidity = 0;
  double Wavelength = 632.8;
  std::vector<std::string> Fields;
  std::vector<double> FieldRanges;
  double RefractivityScale = 3e-4;
  // end

  /// Returns whether the gas is one of the user's own: not what is there before a choice.
  bool hasOneGas() const { return this->Gas != "air" || this->GladstoneDaleConstant != 0; }
  /// Returns whether the model needs a pressure that no array has.
  bool hasUniformPressure() const
  {
    return (this->IndexModel == CIDDOR || this->usesGasLaw()) && this->UniformPressure > 0;
  }
  /// Returns whether the density of a mixture follows from temperature and pressure; of complete settings.
  bool usesGasLaw() const
  {
    return this->IndexModel == GLADSTONE_DALE_MIXTURE && !this->Arrays[DensityArray].isChosen() &&
      this->Arrays[TemperatureArray].isChosen();
  }
  /// Returns whether the model needs a temperature that the pressure gives.
  bool isIsentropic() const
  {
    return this->IndexModel == CIDDOR && this->StagnationTemperature > 0 &&
      !this->hasUniformPressure();
  }
  bool isAxisymmetric() const { return this->Symmetry == 1; }
  bool mayBeWedge() const { return this->Symmetry != 0; } // by default as Symmetry is Auto
  std::array<double, 3> symmetryOrigin() const
  {
    return { this->SymmetryOrigin[0], this->SymmetryOrigin[1], this->SymmetryOrigin[2] };
  }

  /// Calls use(name, pointer to member) for each property.
  template <class Use>
  static void visit(const Use& use)
  {
    using S = MediumSettings;
    use("Arrays", &S::Arrays);
    use("TransferFunctions", &S::TransferFunctions);
    use("Symmetry", &S::Symmetry);
    use("SymmetryAxis", &S::SymmetryAxis);
    use("SymmetryOrigin", &S::SymmetryOrigin);
    use("Depth", &S::Depth);
    use("Outside", &S::Outside);
    use("DoublePrecision", &S::DoublePrecision);
    // visits: rest
    use("IndexModel", &S::IndexModel);
    use("Gas", &S::Gas);
    use("GladstoneDaleConstant", &S::GladstoneDaleConstant);
    use("DensityScale", &S::DensityScale);
    use("MixtureArrays", &S::MixtureArrays);
    use("MixtureGases", &S::MixtureGases);
    use("BackgroundGas", &S::BackgroundGas);
    use("FractionType", &S::FractionType);
    use("PressureScale", &S::PressureScale);
    use("UniformPressure", &S::UniformPressure);
    use("StagnationTemperature", &S::StagnationTemperature);
    use("StagnationPressure", &S::StagnationPressure);
    use("RelativeHumidity", &S::RelativeHumidity);
    use("Wavelength", &S::Wavelength);
    use("Fields", &S::Fields);
    use("FieldRanges", &S::FieldRanges);
    use("RefractivityScale", &S::RefractivityScale);
    // end
  }

  bool operator==(const MediumSettings& other) const;
  bool operator!=(const MediumSettings& other) const { return !(*this == other); }
};

/// Prints a line "name: value" for each property, after `indent` spaces.
void print(std::ostream& out, int indent, const MediumSettings& settings);

#endif
