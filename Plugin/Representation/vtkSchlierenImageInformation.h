// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSchlierenImageInformation
 * @brief   carries the image that vtkSchlierenRepresentation has traced from a server to its client
 */
#ifndef vtkSchlierenImageInformation_h
#define vtkSchlierenImageInformation_h

#include "vtkImageData.h" // for GetImage
#include "vtkPVInformation.h"
#include "vtkSchlierenRepresentationModule.h" // for export macro
#include "vtkSmartPointer.h"                  // for Image

class VTKSCHLIERENREPRESENTATION_EXPORT vtkSchlierenImageInformation : public vtkPVInformation
{
public:
  static vtkSchlierenImageInformation* New();
  vtkTypeMacro(vtkSchlierenImageInformation, vtkPVInformation);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * Returns null if there is none.
   */
  vtkImageData* GetImage() const { return this->Image; }

  void CopyFromObject(vtkObject* representation) override;
  void AddInformation(vtkPVInformation* other) override;
  void CopyToStream(vtkClientServerStream* stream) override;
  void CopyFromStream(const vtkClientServerStream* stream) override;

protected:
  vtkSchlierenImageInformation();
  ~vtkSchlierenImageInformation() override;

private:
  vtkSchlierenImageInformation(const vtkSchlierenImageInformation&) = delete;
  void operator=(const vtkSchlierenImageInformation&) = delete;

  vtkSmartPointer<vtkImageData> Image;
};

#endif
