// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSMSchlierenLockDomain
 * @brief   makes LockedK or LockedAmbient of the proxy of vtkSchlierenFilter follow the filter
 *
 * After each update its property, as LockedK, has what the filter has kept from an earlier image (the property with
 * "Information" at the end of its name), so that state files and scripts that are made of the session give the same
 * image.
 *
 * It is a domain because every proxy has its domains, however it is made; a class of proxy with a name of its own would
 * be missing in ParaView's help.
 */
#ifndef vtkSMSchlierenLockDomain_h
#define vtkSMSchlierenLockDomain_h

#include "vtkSMDomain.h"
#include "vtkSchlierenServerManagerModule.h" // for export macro

class VTKSCHLIERENSERVERMANAGER_EXPORT vtkSMSchlierenLockDomain : public vtkSMDomain
{
public:
  static vtkSMSchlierenLockDomain* New();
  vtkTypeMacro(vtkSMSchlierenLockDomain, vtkSMDomain);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// Does nothing: what is allowed never changes.
  void Update(vtkSMProperty* requestingProperty) override;

protected:
  vtkSMSchlierenLockDomain() = default;
  ~vtkSMSchlierenLockDomain() override = default;

  int ReadXMLAttributes(vtkSMProperty* property, vtkPVXMLElement* element) override;

private:
  vtkSMSchlierenLockDomain(const vtkSMSchlierenLockDomain&) = delete;
  void operator=(const vtkSMSchlierenLockDomain&) = delete;

  void OnUpdate(vtkObject* proxy, unsigned long event, void* data);
};

#endif
