// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSchlierenActor
 * @brief   an image of vtkSchlierenFilter that fills a view, behind everything else
 *
 * The image is traced while it is drawn, because only then are the camera and the size those of the rendering, on
 * servers and in screenshots of another size, too; where the bench is in another process, by that one. It lies just
 * before the far plane of the camera, so all surfaces hide it; with the background pattern SCENE at the back of the flow,
 * and hides what is behind, which is seen through the flow instead. With a perspective camera each pixel has its own direction,
 * as for surfaces.
 */
#ifndef vtkSchlierenActor_h
#define vtkSchlierenActor_h

#include "vtkNew.h"
#include "vtkOpenGLActor.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <array>
#include <functional>

class vtkCallbackCommand;
class vtkCamera;
class vtkImageData;
class vtkPolyData;
class vtkPolyDataMapper;
class vtkSchlierenFilter;

class vtkSchlierenActor : public vtkOpenGLActor
{
public:
  static vtkSchlierenActor* New();
  vtkTypeMacro(vtkSchlierenActor, vtkOpenGLActor);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  void SetBench(vtkSchlierenFilter* bench);
  vtkSchlierenFilter* GetBench() const { return this->Bench; }

  /// What an image depends on besides the data and the bench's own properties.
  struct View
  {
    std::array<double, 3> Direction{}, Up{}, FocalPoint{};
    double ParallelScale = 0;
    double ViewAngle = 0; // degrees; 0: parallel
    std::array<int, 2> Size{};
    bool operator==(const View& other) const;
  };

  enum Occasions
  {
    TURNED,
    STILL,
    SCREENSHOT
  };

  /**
   * Whether another one comes first in the renderer, which is drawn then: light does not pass through both.
   */
  bool IsHidden(vtkRenderer* renderer);

  /**
   * Traces an image for a rendering on such an occasion: its bytes, and where it lies in the plane of the view. Null
   * where there is none. ImageForElsewhere() is for a rendering by another process; it also does what Refine() does.
   */
  vtkImageData* Image(const View& view, int occasion);
  vtkImageData* ImageForElsewhere(const View& view, int occasion);

  /**
   * Where the bench is in another process: what has that one trace an image. Unset: the bench is in this one.
   */
  using Tracer = std::function<vtkSmartPointer<vtkImageData>(const View& view, int occasion)>;
  void SetTracerElsewhere(Tracer tracer) { this->TracerElsewhere = std::move(tracer); }

  /**
   * Of the flow. With the background pattern SCENE light comes through it from what the view shows behind its back.
   */
  void SetFlowBounds(const double bounds[6]) { std::copy_n(bounds, 6, this->FlowBounds); }

  /**
   * While it is in a renderer and visible, the smoothing of edges (FXAA) is left out, which would blur what the image
   * resolves.
   */
  void AddTo(vtkRenderer* renderer);
  void RemoveFrom(vtkRenderer* renderer);

  /**
   * Seconds that a rendering and a call of Refine() may trace for; 0 (the default): each image is complete.
   */
  void SetTimeSlice(double seconds) { this->TimeSlice = this->HasOtherRanks ? 0 : seconds; }

  /**
   * Whether several ranks trace one image: then TimeSlice is of no effect.
   */
  void SetHasOtherRanks(bool hasOtherRanks) { this->HasOtherRanks = hasOtherRanks; }

  /**
   * Whether the next rendering is for a screenshot: these are complete, whatever TimeSlice is.
   */
  void SetIsForScreenshot(bool isForScreenshot) { this->IsForScreenshot = isForScreenshot; }

  /**
   * Brings the image up to date after a change of the data or of the bench's properties, besides drawing: progress
   * can be reported and computations aborted here. Before the first rendering the image is a coarse one, for which the
   * refractivity is found. Where this fails, nothing is drawn until the next call or another change of the bench's
   * properties.
   */
  void UpdateImage(vtkRenderer* renderer);

  /**
   * Whether the bench's properties have changed since the image was made.
   */
  bool IsChanged() const;

  /**
   * Traces for TimeSlice. Whether there is more to see now.
   */
  bool Refine();

  /**
   * Whether the image is complete.
   */
  bool GetFinished() const { return this->Finished || !this->HasData || this->HasFailed(); }

  /**
   * How many pixels along each axis one of the image stands for.
   */
  int GetReduction() const { return this->Reduction; }

  /**
   * Gives the actor bounds that hold all of the view, or none. With several ranks IceT leaves out what is outside of the
   * bounds; but cameras are placed by the bounds of what is visible.
   */
  void SetFillsView(vtkRenderer* renderer);
  void ClearBounds() { this->UseBoundsOff(); }
  double* GetBounds() override { return this->UseBounds ? this->ViewBounds : nullptr; }

  int RenderOpaqueGeometry(vtkViewport* viewport) override;
  int RenderTranslucentPolygonalGeometry(vtkViewport*) override { return 0; }
  vtkTypeBool HasTranslucentPolygonalGeometry() override { return 0; }

protected:
  vtkSchlierenActor();
  ~vtkSchlierenActor() override;

private:
  /// RenderOpaqueGeometry(), which no exception leaves.
  int DrawImage(vtkViewport* viewport);
  vtkSchlierenActor(const vtkSchlierenActor&) = delete;
  void operator=(const vtkSchlierenActor&) = delete;

  static View ViewOf(vtkRenderer* renderer);
  /// Makes the bench look as the renderer does. Whether that is another view than before.
  bool LookThrough(const View& view);
  void Trace(int occasion, bool isMoved);
  void TracePreview();
  void TraceUpTo(double seconds);
  void NoteTimes();
  /// An image that could not be made for one view cannot for another: one error message is enough.
  bool HasFailed() const;
  void UpdatePixels();
  /// Whether what the view shows behind the flow is seen through it.
  bool HasScene() const;
  void UpdateScene(vtkRenderer* renderer, const View& view);
  void UseGreyScene(); ///< until the first rendering
  double DepthOfImage(vtkCamera* camera) const;
  void PlaceQuad(vtkRenderer* renderer);

  vtkSmartPointer<vtkSchlierenFilter> Bench;
  Tracer TracerElsewhere;
  bool IsDrawnElsewhere = false;
  vtkNew<vtkCallbackCommand> Silence; // of the bench's progress while drawing
  vtkNew<vtkCallbackCommand> SuspendFXAA;
  vtkNew<vtkCallbackCommand> RestoreFXAA;
  bool IsWithoutFXAA = false;
  vtkNew<vtkPolyData> Quad;
  vtkNew<vtkPolyDataMapper> QuadMapper;
  vtkNew<vtkImageData> Pixels;
  vtkMTimeType PixelsTime = 0;
  vtkMTimeType KnownTime = 0;  // of the bench, when this has last used it
  vtkMTimeType FailedTime = 0; // of the bench, where there was no image; 0: there was one
  View Seen;
  bool HasSeen = false; // a rendering
  bool HasDrawnScene = false;
  bool HasData = false;
  bool Finished = true;
  bool IsForScreenshot = false;
  bool HasOtherRanks = false;
  double TimeSlice = 0;
  double SecondsPerPixel = 2e-7; // as previews have taken; to begin with, a guess
  int Reduction = 1;
  double ViewBounds[6];
  double FlowBounds[6];
};

#endif
