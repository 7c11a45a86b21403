// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSchlierenRepresentation
 * @brief   draws flow data in a render view as the image that vtkSchlierenFilter makes of them
 *
 * The image has the camera and the size of the view, behind all surfaces; see vtkSchlierenActor. An
 * update, with progress and abort, computes the refractivity. Rays are traced when the view is
 * rendered: coarsely while it is turned and, if TimeSlice is positive, progressively afterwards, by
 * vtkPVRenderView::StreamingUpdate(). It takes a server that can draw.
 */
#ifndef vtkSchlierenRepresentation_h
#define vtkSchlierenRepresentation_h

#include "vtkNew.h"
#include "vtkPVDataRepresentation.h"
#include "vtkSchlierenRepresentationModule.h" // for export macro

#include <functional> // for Guarded

class vtkPolyData;
class vtkSchlierenActor;

class VTKSCHLIERENREPRESENTATION_EXPORT vtkSchlierenRepresentation : public vtkPVDataRepresentation
{
public:
  static vtkSchlierenRepresentation* New();
  vtkTypeMacro(vtkSchlierenRepresentation, vtkPVDataRepresentation);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// Sets the vtkSchlierenFilter that makes the image; this representation sets its input, view and
  /// size. Null on clients that do not process data.
  void SetBench(vtkObject* bench);

  /// Sets the tracing time of a rendering or streaming update, seconds, not negative; 0 (the
  /// default): images are complete.
  void SetTimeSlice(double seconds);

  ///@{
  /// Set whether a legend is drawn (default: on), and its corner, one of vtkSchlierenLegend::Corners
  /// (default: lower right).
  void SetLegend(bool isShown);
  void SetLegendCorner(int corner);
  ///@}

  /// Return whether the last image is complete, and its reduction; see vtkSchlierenActor.
  bool GetFinished();
  int GetReduction();

  void SetVisibility(bool isVisible) override;

  vtkTypeBool ProcessRequest(
    vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output) override;
  int ProcessViewRequest(
    vtkInformationRequestKey* request, vtkInformation* input, vtkInformation* output) override;

protected:
  vtkSchlierenRepresentation();
  ~vtkSchlierenRepresentation() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestUpdateExtent(
    vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output) override;
  bool AddToView(vtkView* view) override;
  bool RemoveFromView(vtkView* view) override;

private:
  vtkSchlierenRepresentation(const vtkSchlierenRepresentation&) = delete;
  void operator=(const vtkSchlierenRepresentation&) = delete;

  /// Turns exceptions, which ParaView does not expect, into messages.
  int Guarded(const std::function<int()>& work);
  int RespondToView(
    vtkInformationRequestKey* request, vtkInformation* input, vtkInformation* output);
  void PassTimeToBench();
  /// Lets cameras see all of a medium that is larger than the data: of a wedge that is revolved, or of a plane.
  void IncludeMedium();
  void ShowOrHideLegend();
  /// Report once, until that changes, that another flow is shown instead, or that the server cannot
  /// draw.
  void TellIfHidden();
  void TellIfServerCannotDraw();

  vtkNew<vtkSchlierenActor> Actor;
  vtkNew<vtkPolyData>
    Nothing; // delivered data: only the image leaves this process, as part of the view
  bool IsHidden = false;
  bool HasToldOfServer = false;
  bool HasLegend = true;
  double Bounds[6];
};

#endif
