// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSchlierenActor
 * @brief   an image of vtkSchlierenFilter that fills a view, behind everything else
 *
 * Traces the image during rendering, because only then camera and size are those of the rendering,
 * on servers and in larger screenshots, too. The image lies just before the far plane, so that all surfaces hide it. With a perspective camera each pixel
 * has its own direction.
 */
#ifndef vtkSchlierenActor_h
#define vtkSchlierenActor_h

#include "vtkNew.h"
#include "vtkOpenGLActor.h"
#include "vtkSmartPointer.h"

#include <array>

class vtkCallbackCommand;
class vtkCamera;
class vtkImageData;
class vtkPolyData;
class vtkPolyDataMapper;
class vtkSchlierenFilter;
class vtkSchlierenLegend;

class vtkSchlierenActor : public vtkOpenGLActor
{
public:
  static vtkSchlierenActor* New();
  vtkTypeMacro(vtkSchlierenActor, vtkOpenGLActor);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  void SetBench(vtkSchlierenFilter* bench);
  vtkSchlierenFilter* GetBench() const { return this->Bench; }

  /// What an image depends on besides the data and the bench's properties.
  struct View
  {
    std::array<double, 3> Direction{}, Up{}, FocalPoint{};
    double ParallelScale = 0;
    double ViewAngle = 0; // degrees; 0: parallel
    std::array<int, 2> Size{};
    double Pupil = 0; // diameter, data units; 0: the bench's
    double FocusDistance = 0;
    bool operator==(const View& other) const;
  };

  /// Returns how a renderer is looked through. With a perspective, its parallel scale is that at the depth of
  /// the focal point.
  static View ViewOf(vtkRenderer* renderer);

  /// Returns what is drawn over the image.
  vtkSchlierenLegend* GetLegend() const { return this->Legend; }

  /// Returns whether another actor is drawn instead: light cannot pass through both flows.
  bool IsHidden(vtkRenderer* renderer);

  /// Adds the actor, and disables FXAA, which would blur the image, while it is visible.
  void AddTo(vtkRenderer* renderer);
  void RemoveFrom(vtkRenderer* renderer);

  /// Sets the time of tracing per rendering, seconds; 0 (the default): images are complete.
  void SetTimeSlice(double seconds) { this->TimeSlice = this->HasOtherRanks ? 0 : seconds; }

  /// Sets whether several ranks trace one image, which disables TimeSlice.
  void SetHasOtherRanks(bool hasOtherRanks) { this->HasOtherRanks = hasOtherRanks; }

  /// Sets whether the next rendering is for a screenshot, which is complete, whatever TimeSlice is.
  void SetIsForScreenshot(bool isForScreenshot) { this->IsForScreenshot = isForScreenshot; }

  /// Updates the image after changes of the data or of the bench's properties, outside of rendering,
  /// with progress and abort. Before the first rendering the image is coarse, for the sake of the
  /// refractivity. After a failure nothing is drawn until the next call or another change of the
  /// bench's properties.
  void UpdateImage(vtkRenderer* renderer);

  /// Returns whether the bench's properties have changed since the last UpdateImage(), other than by the view, whatever was
  /// drawn since then.
  bool IsChanged() const;

  /// Traces for TimeSlice, or returns true where there is more to show since the last call.
  bool Refine();

  /// Returns whether the image is complete, or stopped.
  bool GetFinished() const;

  /// Returns the full image's pixels, along each axis, for each pixel of the preview.
  int GetReduction() const { return this->Reduction; }

  /// Sets bounds that contain the whole view, or none. With several ranks IceT omits what is outside
  /// of the bounds; but cameras are placed by the bounds of what is visible.
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
  /// Draws for RenderOpaqueGeometry() without throwing.
  int DrawImage(vtkViewport* viewport);
  vtkSchlierenActor(const vtkSchlierenActor&) = delete;
  void operator=(const vtkSchlierenActor&) = delete;

  enum Occasions
  {
    TURNED,
    STILL,
    SCREENSHOT
  };

  /// Traces the image for a rendering. Returns whether there is one.
  bool MakeImage(const View& view, int occasion);
  /// Gives the bench the renderer's view. Returns whether it has changed.
  bool LookThrough(const View& view);
  void Trace(int occasion, bool isMoved);
  void TracePreview();
  void TraceUpTo(double seconds);
  /// Remembers changes of the bench's properties, before the actor changes some.
  void NoteNews();
  void NoteTimes();
  /// Returns whether the image failed for any view, so that an error is reported once.
  bool HasFailed() const;
  void UpdatePixels();
  static double DepthOfImage(vtkCamera* camera);
  void PlaceQuad(vtkRenderer* renderer);

  vtkSmartPointer<vtkSchlierenFilter> Bench;
  vtkNew<vtkCallbackCommand> Silence; // ignores the bench's progress while drawing
  vtkNew<vtkCallbackCommand> SuspendFXAA;
  vtkNew<vtkCallbackCommand> RestoreFXAA;
  bool IsWithoutFXAA = false;
  vtkNew<vtkSchlierenLegend> Legend;
  vtkNew<vtkPolyData> Quad;
  vtkNew<vtkPolyDataMapper> QuadMapper;
  vtkNew<vtkImageData> Pixels;
  vtkMTimeType PixelsTime = 0;
  vtkMTimeType KnownTime = 0;  // of the bench at its last use
  bool HasNews = false;        // properties that have changed since the last update
  vtkMTimeType FailedTime = 0; // of the bench at a failure; 0: none
  View Seen;
  bool HasSeen = false; // whether there was a rendering
  bool HasData = false;
  bool Finished = true;
  bool HasMore = false; // than was drawn
  bool IsForScreenshot = false;
  bool HasOtherRanks = false;
  double TimeSlice = 0;
  double SecondsPerPixel = 2e-7; // measured by previews, at first a guess
  int Reduction = 1;
  double ViewBounds[6];
};

#endif
