// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSMSchlierenBenchProxy
 * @brief   the proxy of the filter inside of a representation, on servers only
 *
 * ParaView creates such a proxy's object on the client, too. There the filter has no input, but
 * would answer for information properties.
 */
#ifndef vtkSMSchlierenBenchProxy_h
#define vtkSMSchlierenBenchProxy_h

#include "vtkSMSourceProxy.h"
#include "vtkSchlierenServerManagerModule.h" // for export macro

class VTKSCHLIERENSERVERMANAGER_EXPORT vtkSMSchlierenBenchProxy : public vtkSMSourceProxy
{
public:
  static vtkSMSchlierenBenchProxy* New();
  vtkTypeMacro(vtkSMSchlierenBenchProxy, vtkSMSourceProxy);
  void PrintSelf(ostream& os, vtkIndent indent) override;

protected:
  vtkSMSchlierenBenchProxy() = default;
  ~vtkSMSchlierenBenchProxy() override = default;

  /// Creates objects, from then on without the client.
  void CreateVTKObjects() override;

private:
  vtkSMSchlierenBenchProxy(const vtkSMSchlierenBenchProxy&) = delete;
  void operator=(const vtkSMSchlierenBenchProxy&) = delete;
};

#endif
