// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSMSchlierenRepresentationProxy
 * @brief   announces updates of vtkSchlierenRepresentation by the proxy of the filter inside
 *
 * As any filter's proxy does: vtkSMSchlierenLockDomain waits for it.
 */
#ifndef vtkSMSchlierenRepresentationProxy_h
#define vtkSMSchlierenRepresentationProxy_h

#include "vtkSMRepresentationProxy.h"
#include "vtkSchlierenRepresentationModule.h" // for export macro

class VTKSCHLIERENREPRESENTATION_EXPORT vtkSMSchlierenRepresentationProxy
  : public vtkSMRepresentationProxy
{
public:
  static vtkSMSchlierenRepresentationProxy* New();
  vtkTypeMacro(vtkSMSchlierenRepresentationProxy, vtkSMRepresentationProxy);
  void PrintSelf(ostream& os, vtkIndent indent) override;

protected:
  vtkSMSchlierenRepresentationProxy() = default;
  ~vtkSMSchlierenRepresentationProxy() override = default;

  void PostUpdateData(bool usingCache) override;

private:
  vtkSMSchlierenRepresentationProxy(const vtkSMSchlierenRepresentationProxy&) = delete;
  void operator=(const vtkSMSchlierenRepresentationProxy&) = delete;
};

#endif
