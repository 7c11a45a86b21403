// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSMSchlierenArrayDomain
 * @brief   the arrays of the input, with a default only if its name is recognized
 *
 * Instead of ParaView's default, the active scalars or the first array, it chooses the array of
 * flowDefaults() for its property (Density, IndexArray, Temperature, Pressure or Humidity), or
 * none: the filter then decides when it has the data, or reports the arrays.
 */
#ifndef vtkSMSchlierenArrayDomain_h
#define vtkSMSchlierenArrayDomain_h

#include "vtkSMArrayListDomain.h"
#include "vtkSchlierenServerManagerModule.h" // for export macro

#include <string> // for Chosen

class VTKSCHLIERENSERVERMANAGER_EXPORT vtkSMSchlierenArrayDomain : public vtkSMArrayListDomain
{
public:
  static vtkSMSchlierenArrayDomain* New();
  vtkTypeMacro(vtkSMSchlierenArrayDomain, vtkSMArrayListDomain);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  int SetDefaultValues(vtkSMProperty* property, bool useUnchecked) override;

  /// Chooses again for another input without the array that was chosen.
  void Update(vtkSMProperty* requestingProperty) override;

protected:
  vtkSMSchlierenArrayDomain() = default;
  ~vtkSMSchlierenArrayDomain() override = default;

private:
  std::string Chosen; ///< by SetDefaultValues(); empty: none

  vtkSMSchlierenArrayDomain(const vtkSMSchlierenArrayDomain&) = delete;
  void operator=(const vtkSMSchlierenArrayDomain&) = delete;
};

#endif
