// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSMSchlierenQualityDomain
 * @brief   makes Quality of the proxy of vtkSchlierenFilter set the properties of its presets
 *
 * Its property is Quality; its required properties are those of
 * vtkSchlierenFilter::GetQualitySetting(). Setting Quality to a preset sets them, and setting one
 * of them sets Quality to the preset with these values, or to Custom. The same applies to unchecked
 * values, shown in panels before Apply. Only the other properties are sent to the server, and state
 * files restore their values, even if presets have changed. It is a domain because every proxy has
 * its domains, however it is made.
 */
#ifndef vtkSMSchlierenQualityDomain_h
#define vtkSMSchlierenQualityDomain_h

#include "vtkSMDomain.h"
#include "vtkSchlierenServerManagerModule.h" // for export macro

class VTKSCHLIERENSERVERMANAGER_EXPORT vtkSMSchlierenQualityDomain : public vtkSMDomain
{
public:
  static vtkSMSchlierenQualityDomain* New();
  vtkTypeMacro(vtkSMSchlierenQualityDomain, vtkSMDomain);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// Does nothing: allowed values never change.
  void Update(vtkSMProperty* requestingProperty) override;

protected:
  vtkSMSchlierenQualityDomain() = default;
  ~vtkSMSchlierenQualityDomain() override = default;

  int ReadXMLAttributes(vtkSMProperty* property, vtkPVXMLElement* element) override;

private:
  vtkSMSchlierenQualityDomain(const vtkSMSchlierenQualityDomain&) = delete;
  void operator=(const vtkSMSchlierenQualityDomain&) = delete;

  void OnModified(vtkObject* property, unsigned long event, void* data);

  /// Makes the other properties follow a modified one, through `Helper`.
  template <class Helper>
  void Follow(vtkSMProperty* modified);

  bool Following = false;
};

#endif
