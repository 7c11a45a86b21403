// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSMSchlierenSourceProxy
 * @brief   the proxy of vtkSchlierenFilter
 *
 * After each update its property LockedK has the k that the filter has kept from an earlier image, so that state files
 * and scripts that are made of the session give the same image.
 */
#ifndef vtkSMSchlierenSourceProxy_h
#define vtkSMSchlierenSourceProxy_h

#include "vtkSMSourceProxy.h"
#include "vtkSchlierenServerManagerModule.h" // for export macro

class VTKSCHLIERENSERVERMANAGER_EXPORT vtkSMSchlierenSourceProxy : public vtkSMSourceProxy
{
public:
  static vtkSMSchlierenSourceProxy* New();
  vtkTypeMacro(vtkSMSchlierenSourceProxy, vtkSMSourceProxy);
  void PrintSelf(ostream& os, vtkIndent indent) override;

protected:
  vtkSMSchlierenSourceProxy() = default;
  ~vtkSMSchlierenSourceProxy() override = default;

  void PostUpdateData(bool usingCache) override;

private:
  vtkSMSchlierenSourceProxy(const vtkSMSchlierenSourceProxy&) = delete;
  void operator=(const vtkSMSchlierenSourceProxy&) = delete;
};

#endif
