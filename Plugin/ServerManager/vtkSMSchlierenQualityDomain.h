// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSMSchlierenQualityDomain
 * @brief   makes Quality of the proxy of vtkSchlierenFilter set the properties that it stands for
 *
 * Its property is Quality, its required properties are those that vtkSchlierenFilter::GetQualitySetting()
 * names. Whoever sets Quality to a preset sets them, too; whoever sets one of them sets Quality to the
 * preset whose values they then have, or to Custom. The same holds for the unchecked values, those that
 * a properties panel shows before they are applied.
 *
 * So Quality is but a name for the others' values, and only these are sent to the server. A state file,
 * too, brings back their values, even if the presets have changed since it was written.
 *
 * It is a domain because every proxy has its domains, however it is made.
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

  /// Does nothing: what is allowed never changes.
  void Update(vtkSMProperty* requestingProperty) override;

protected:
  vtkSMSchlierenQualityDomain() = default;
  ~vtkSMSchlierenQualityDomain() override = default;

  int ReadXMLAttributes(vtkSMProperty* property, vtkPVXMLElement* element) override;

private:
  vtkSMSchlierenQualityDomain(const vtkSMSchlierenQualityDomain&) = delete;
  void operator=(const vtkSMSchlierenQualityDomain&) = delete;

  void OnModified(vtkObject* property, unsigned long event, void* data);

  /// Makes the other properties follow the one that was modified, by way of `Helper`.
  template <class Helper>
  void Follow(vtkSMProperty* modified);

  bool Following = false;
};

#endif
