// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSMSchlierenDensityDomain
 * @brief   the arrays of the input, of which a temperature is not chosen by itself as the density
 *
 * ParaView chooses the active scalars, or else the first array. Where that is a temperature by its name, unit or
 * values, an array that is a density by its name is chosen instead, or none: the filter then says what is missing.
 */
#ifndef vtkSMSchlierenDensityDomain_h
#define vtkSMSchlierenDensityDomain_h

#include "vtkSMArrayListDomain.h"
#include "vtkSchlierenServerManagerModule.h" // for export macro

class VTKSCHLIERENSERVERMANAGER_EXPORT vtkSMSchlierenDensityDomain : public vtkSMArrayListDomain
{
public:
  static vtkSMSchlierenDensityDomain* New();
  vtkTypeMacro(vtkSMSchlierenDensityDomain, vtkSMArrayListDomain);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  int SetDefaultValues(vtkSMProperty* property, bool useUnchecked) override;

protected:
  vtkSMSchlierenDensityDomain() = default;
  ~vtkSMSchlierenDensityDomain() override = default;

private:
  vtkSMSchlierenDensityDomain(const vtkSMSchlierenDensityDomain&) = delete;
  void operator=(const vtkSMSchlierenDensityDomain&) = delete;
};

#endif
