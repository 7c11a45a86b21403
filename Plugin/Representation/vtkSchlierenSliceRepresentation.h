// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSchlierenSliceRepresentation
 * @brief   draws an image of vtkSchlierenFilter with its legend
 */
#ifndef vtkSchlierenSliceRepresentation_h
#define vtkSchlierenSliceRepresentation_h

#include "vtkImageSliceRepresentation.h"
#include "vtkNew.h"
#include "vtkSchlierenRepresentationModule.h" // for export macro

class vtkSchlierenLegend;

class VTKSCHLIERENREPRESENTATION_EXPORT vtkSchlierenSliceRepresentation
  : public vtkImageSliceRepresentation
{
public:
  static vtkSchlierenSliceRepresentation* New();
  vtkTypeMacro(vtkSchlierenSliceRepresentation, vtkImageSliceRepresentation);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /// Set whether a legend is drawn (default: on), and its corner, one of vtkSchlierenLegend::Corners
  /// (default: lower right).
  void SetLegend(bool isShown);
  void SetLegendCorner(int corner);
  ///@}

  void SetVisibility(bool isVisible) override;

  int ProcessViewRequest(
    vtkInformationRequestKey* request, vtkInformation* input, vtkInformation* output) override;

protected:
  vtkSchlierenSliceRepresentation();
  ~vtkSchlierenSliceRepresentation() override;

  bool AddToView(vtkView* view) override;
  bool RemoveFromView(vtkView* view) override;

private:
  vtkSchlierenSliceRepresentation(const vtkSchlierenSliceRepresentation&) = delete;
  void operator=(const vtkSchlierenSliceRepresentation&) = delete;

  void ShowOrHideLegend();

  vtkNew<vtkSchlierenLegend> Legend;
  bool HasLegend = true;
};

#endif
