// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSMSchlierenLockDomain
 * @brief   makes LockedK or LockedAmbient of the proxy of vtkSchlierenFilter follow the filter
 *
 * After each update it copies the value that the filter has kept from an earlier image, the
 * information property whose name ends in "Information", to its property, so that state files and
 * scripts of the session give the same image. It is a domain because every proxy has its domains,
 * however it is made, while a class of proxies of its own would be missing in ParaView's help.
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

  /// Does nothing: allowed values never change.
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
