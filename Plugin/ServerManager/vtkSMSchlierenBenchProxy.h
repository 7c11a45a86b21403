// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSMSchlierenBenchProxy
 * @brief   the proxy of the filter inside of a representation, which the servers alone make use of
 *
 * ParaView creates proxies that are values of a representation's property wherever the representation is, the client
 * included. There the filter has no input, and would be the one that answers what information properties request.
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

  /// From then on the client is left out.
  void CreateVTKObjects() override;

private:
  vtkSMSchlierenBenchProxy(const vtkSMSchlierenBenchProxy&) = delete;
  void operator=(const vtkSMSchlierenBenchProxy&) = delete;
};

#endif
