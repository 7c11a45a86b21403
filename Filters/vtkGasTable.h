// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkGasTable
 * @brief   the gases that vtkRefractiveIndex knows by name
 *
 * Has the Gladstone-Dale constant K(wavelength), the molar mass and their source for each gas.
 * Gases are found by name ("helium") or chemical formula ("He"), spelled as in the table. For an
 * unknown gas, texts are empty and numbers are NaN.
 *
 * In Python, with the plugin's folder in PYTHONPATH:
 * @code{.py}
 * from schlieren.vtkSchlierenFilters import vtkGasTable
 * for i in range(vtkGasTable.GetNumberOfGases()):
 *     name = vtkGasTable.GetName(i)
 *     print(name, vtkGasTable.GetConstant(name, 632.8), vtkGasTable.GetSource(name))
 * @endcode
 *
 * @sa vtkRefractiveIndex
 */

#ifndef vtkGasTable_h
#define vtkGasTable_h

#include "vtkObject.h"
#include "vtkSchlierenFiltersModule.h" // for export macro

#include <string> // for std::string

class VTKSCHLIERENFILTERS_EXPORT vtkGasTable : public vtkObject
{
public:
  static vtkGasTable* New();
  vtkTypeMacro(vtkGasTable, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /// Return the number of gases, and the name of each: 0 <= index < GetNumberOfGases().
  static int GetNumberOfGases();
  static std::string GetName(int index);
  ///@}

  /// Returns whether there is a gas of this name or formula.
  static bool Has(const std::string& gas);

  /// Returns the chemical formula, such as "CO2", of a gas by its name or formula.
  static std::string GetFormula(const std::string& gas);

  /// Returns the Gladstone-Dale constant K in m^3/kg for light of this wavelength in vacuum,
  /// nanometres. It is extrapolated from the longest measured wavelength to 1700 nm, and constant
  /// beyond that and below the shortest one. NaN for a wavelength that is not positive.
  static double GetConstant(const std::string& gas, double wavelength);

  /// Returns the molar mass in kg/mol.
  static double GetMolarMass(const std::string& gas);

  ///@{
  /// Return the range of measured wavelengths, nanometres; equal if there is only one.
  static double GetShortestWavelength(const std::string& gas);
  static double GetLongestWavelength(const std::string& gas);
  ///@}

  /// Returns the source of the numbers.
  static std::string GetSource(const std::string& gas);

protected:
  vtkGasTable() = default;
  ~vtkGasTable() override = default;

private:
  vtkGasTable(const vtkGasTable&) = delete;
  void operator=(const vtkGasTable&) = delete;
};

#endif
