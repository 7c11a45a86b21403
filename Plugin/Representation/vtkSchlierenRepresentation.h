// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSchlierenRepresentation
 * @brief   draws flow data in a render view as the image that vtkSchlierenFilter makes of them
 *
 * The image has the camera and the size of the view. It lies behind all surfaces of the view; see vtkSchlierenActor.
 *
 * An update, which can be aborted and reports progress, finds the refractivity. Rays are traced when the view is
 * rendered: coarsely while it is turned, and whenever TimeSlice is positive, progressively afterwards, in calls of
 * vtkPVRenderView::StreamingUpdate().
 *
 * Where the server cannot draw, it traces the image as well; the client's representation requests it when it draws.
 */
#ifndef vtkSchlierenRepresentation_h
#define vtkSchlierenRepresentation_h

#include "vtkImageData.h" // for GetTracedImage
#include "vtkNew.h"
#include "vtkPVDataRepresentation.h"
#include "vtkSchlierenRepresentationModule.h" // for export macro
#include "vtkSmartPointer.h"                  // for TracedImage

#include <functional> // for SetRequest, Guarded

class vtkPolyData;
class vtkSchlierenActor;

class VTKSCHLIERENREPRESENTATION_EXPORT vtkSchlierenRepresentation : public vtkPVDataRepresentation
{
public:
  static vtkSchlierenRepresentation* New();
  vtkTypeMacro(vtkSchlierenRepresentation, vtkPVDataRepresentation);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * The vtkSchlierenFilter that makes the image; its input, view and size are set by this representation. Null on
   * clients that do not process data.
   */
  void SetBench(vtkObject* bench);

  /**
   * Seconds that a rendering, and a streaming update, may trace for, so that whoever requests streaming updates sees
   * the image improve; 0 (the default): each image is complete. Not negative.
   */
  void SetTimeSlice(double seconds);

  /**
   * Whether the image that was drawn last is complete, and how many pixels along each axis one of it stands for.
   */
  bool GetFinished();
  int GetReduction();

  ///@{
  /**
   * Of a server that cannot draw: traces an image for its client, which has the camera and the size and fetches
   * GetTracedImage() (null: there is none). `request`: direction, up, focal point, parallel scale, columns and rows,
   * and one of vtkSchlierenActor::Occasions.
   */
  void TraceForClient(const double request[14]);
  VTK_WRAPEXCLUDE vtkImageData* GetTracedImage() const { return this->TracedImage; }
  ///@}

  /**
   * Of a client: what requests that of its server, and returns the image.
   */
  using Request = std::function<vtkSmartPointer<vtkImageData>(const double request[14])>;
  VTK_WRAPEXCLUDE void SetRequest(Request request);

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

  /// Does what ParaView requests, which no exception may reach: it becomes a message.
  int Guarded(const std::function<int()>& work);
  int RespondToView(
    vtkInformationRequestKey* request, vtkInformation* input, vtkInformation* output);
  void PassTimeToBench();
  void UseRequest();
  /// A message where another flow is shown instead; one, until that has changed.
  void TellIfHidden();

  vtkNew<vtkSchlierenActor> Actor;
  Request RequestOfServer;
  vtkSmartPointer<vtkImageData> TracedImage;
  vtkNew<vtkPolyData>
    Nothing; // to be delivered: only the image leaves this process, as part of the view
  bool IsHidden = false;
  double Bounds[6];
};

#endif
