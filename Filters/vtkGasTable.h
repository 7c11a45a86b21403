// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkGasTable
 * @brief   the gases that vtkRefractiveIndex knows by name
 *
 * For each gas its Gladstone-Dale constant K(wavelength), molar mass and the source of both. A gas is
 * found by its name ("helium") or chemical formula ("He"), spelled as in the table. For a gas
 * that the table does not hold, texts are empty and numbers are NaN.
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

  /**
   * How many gases there are, and the name of each: 0 <= index < GetNumberOfGases().
   */
  static int GetNumberOfGases();
  static std::string GetName(int index);

  /**
   * Whether there is a gas of this name or formula.
   */
  static bool Has(const std::string& gas);

  static std::string GetFormula(const std::string& gas);

  /**
   * Gladstone-Dale constant K in m^3/kg for light of this wavelength in vacuum, nanometres. Beyond
   * the longest wavelength that was measured it is continued, to 1700 nm; further out, and below the
   * shortest, it is constant. NaN for a wavelength that is not positive.
   */
  static double GetConstant(const std::string& gas, double wavelength);

  /**
   * kg/mol.
   */
  static double GetMolarMass(const std::string& gas);

  ///@{
  /**
   * The wavelengths that were measured, nanometres; equal where there is one only.
   */
  static double GetShortestWavelength(const std::string& gas);
  static double GetLongestWavelength(const std::string& gas);
  ///@}

  /**
   * Where the numbers are from.
   */
  static std::string GetSource(const std::string& gas);

protected:
  vtkGasTable() = default;
  ~vtkGasTable() override = default;

private:
  vtkGasTable(const vtkGasTable&) = delete;
  void operator=(const vtkGasTable&) = delete;
};

#endif
