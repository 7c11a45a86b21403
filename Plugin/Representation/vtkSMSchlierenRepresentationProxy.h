// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSMSchlierenRepresentationProxy
 * @brief   fetches images of vtkSchlierenRepresentation from a server that cannot draw
 *
 * The client, which alone knows camera and size, requests each image when it draws. Updates of the
 * data are announced by the proxy of the filter inside, as by any filter's.
 */
#ifndef vtkSMSchlierenRepresentationProxy_h
#define vtkSMSchlierenRepresentationProxy_h

#include "vtkSMRepresentationProxy.h"
#include "vtkSchlierenRepresentationModule.h" // for export macro
#include "vtkSmartPointer.h"                  // for Fetch

class vtkImageData;

class VTKSCHLIERENREPRESENTATION_EXPORT vtkSMSchlierenRepresentationProxy
  : public vtkSMRepresentationProxy
{
public:
  static vtkSMSchlierenRepresentationProxy* New();
  vtkTypeMacro(vtkSMSchlierenRepresentationProxy, vtkSMRepresentationProxy);
  void PrintSelf(ostream& os, vtkIndent indent) override;

protected:
  vtkSMSchlierenRepresentationProxy();
  ~vtkSMSchlierenRepresentationProxy() override;

  void CreateVTKObjects() override;
  void PostUpdateData(bool usingCache) override;

private:
  vtkSMSchlierenRepresentationProxy(const vtkSMSchlierenRepresentationProxy&) = delete;
  void operator=(const vtkSMSchlierenRepresentationProxy&) = delete;

  /// The image for a request; see vtkSchlierenRepresentation::TraceForClient().
  vtkSmartPointer<vtkImageData> Fetch(const double request[16]);
};

#endif
