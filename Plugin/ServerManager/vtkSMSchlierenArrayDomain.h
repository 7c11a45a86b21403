// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSMSchlierenArrayDomain
 * @brief   the arrays of the input, of which one is chosen by itself only where it is known
 *
 * ParaView chooses the active scalars, or else the first array, whatever these are. Here it is the array that
 * flowDefaults() chooses for the property (Density, IndexArray, Temperature, Pressure or Humidity), or none: the filter then
 * decides when it has the data, or says what there is.
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

  /// Chooses again where the input has become another one that has not the array that was chosen here.
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
