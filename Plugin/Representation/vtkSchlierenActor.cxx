// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSchlierenActor.h"

#include "SceneBehind.h"
#include "vtkSchlierenFilter.h"
#include "vtkSchlierenLegend.h"

#include "Private/Common/Guarded.h"

#include "vtkCallbackCommand.h"
#include "vtkCamera.h"
#include "vtkCellArray.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkMath.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkPropCollection.h"
#include "vtkProperty.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkTexture.h"
#include "vtkTimerLog.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cmath>

namespace
{

/// Time for an image while the camera moves; the rendering stays below 70 ms.
constexpr double previewSeconds = 0.04;
constexpr int coarsest = 16;

/// The bench's maximum; one pixel shows whether there is an image.
constexpr int reductionAtFirst = 64;

/// The bench's maximum, degrees.
constexpr double widestAngle = 169;

/// Distance of the image from the far plane, as a fraction of the view's depth.
constexpr double beforeFarPlane = 1e-4;

/// Converts intensities to bytes. `fullScale`: 1, or 2 if undisturbed light is 1.
vtkSmartPointer<vtkUnsignedCharArray> greyOf(vtkDataArray* intensity, double fullScale)
{
  vtkNew<vtkUnsignedCharArray> grey;
  const vtkIdType count = intensity->GetNumberOfTuples();
  grey->SetNumberOfComponents(3);
  grey->SetNumberOfTuples(count);
  unsigned char* to = grey->GetPointer(0);
  for (vtkIdType i = 0; i < count; ++i)
  {
    const double value = 255 * intensity->GetComponent(i, 0) / fullScale;
    to = std::fill_n(to, 3, static_cast<unsigned char>(std::clamp(value, 0., 255.) + 0.5));
  }
  return grey;
}

/// Hides the bench's progress during its lifetime: ParaView's progress bar would render the view
/// again during a rendering.
class Silent
{
public:
  explicit Silent(vtkCallbackCommand* command)
    : Command(command)
  {
    this->Command->SetAbortFlagOnExecute(1);
  }
  ~Silent() { this->Command->SetAbortFlagOnExecute(0); }
  Silent(const Silent&) = delete;
  Silent& operator=(const Silent&) = delete;

private:
  vtkCallbackCommand* Command;
};

} // namespace

vtkStandardNewMacro(vtkSchlierenActor);

vtkSchlierenActor::vtkSchlierenActor()
{
  vtkMath::UninitializeBounds(this->ViewBounds);
  vtkMath::UninitializeBounds(this->FlowBounds);
  this->UseBoundsOff();
  this->PickableOff();
  this->DragableOff();
  this->Silence->SetCallback([](vtkObject*, unsigned long, void*, void*) {});
  this->SuspendFXAA->SetClientData(this);
  this->SuspendFXAA->SetCallback(
    [](vtkObject* renderer, unsigned long, void* data, void*)
    {
      auto* self = static_cast<vtkSchlierenActor*>(data);
      self->IsWithoutFXAA =
        self->GetVisibility() && static_cast<vtkRenderer*>(renderer)->GetUseFXAA();
      if (self->IsWithoutFXAA)
      {
        static_cast<vtkRenderer*>(renderer)->UseFXAAOff();
      }
    });
  this->RestoreFXAA->SetClientData(this);
  this->RestoreFXAA->SetCallback(
    [](vtkObject* renderer, unsigned long, void* data, void*)
    {
      if (static_cast<vtkSchlierenActor*>(data)->IsWithoutFXAA)
      {
        static_cast<vtkRenderer*>(renderer)->UseFXAAOn();
      }
    });

  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(4);
  vtkNew<vtkCellArray> quads;
  const vtkIdType corners[] = { 0, 1, 2, 3 };
  quads->InsertNextCell(4, corners);
  vtkNew<vtkFloatArray> places;
  places->SetNumberOfComponents(2);
  for (const float place : { 0.f, 0.f, 1.f, 0.f, 1.f, 1.f, 0.f, 1.f })
  {
    places->InsertNextValue(place);
  }
  this->Quad->SetPoints(points);
  this->Quad->SetPolys(quads);
  this->Quad->GetPointData()->SetTCoords(places);
  this->QuadMapper->SetInputData(this->Quad);
  this->QuadMapper->ScalarVisibilityOff();
  this->SetMapper(this->QuadMapper);
  this->GetProperty()->LightingOff();
  this->GetProperty()->SetColor(1, 1, 1);
  vtkNew<vtkTexture> texture;
  texture->SetInputData(this->Pixels);
  texture->SetColorModeToDirectScalars();
  texture->RepeatOff();
  texture->EdgeClampOn();
  this->SetTexture(texture);
}

vtkSchlierenActor::~vtkSchlierenActor() { this->SetBench(nullptr); }

void vtkSchlierenActor::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Bench: " << this->Bench << "\n";
  os << indent << "TimeSlice: " << this->TimeSlice << "\n";
  os << indent << "Finished: " << this->GetFinished() << "\n";
  os << indent << "Reduction: " << this->Reduction << "\n";
}

void vtkSchlierenActor::SetBench(vtkSchlierenFilter* bench)
{
  if (this->Bench == bench)
  {
    return;
  }
  if (this->Bench)
  {
    this->Bench->RemoveObserver(this->Silence);
  }
  this->Bench = bench;
  this->HasData = this->HasSeen = this->HasDrawnScene = false;
  this->FailedTime = 0;
  if (bench)
  {
    bench->FaceFlatDataOff(); // the camera has priority
    constexpr float beforeAllOthers = 100;
    for (const unsigned long event :
      { vtkCommand::StartEvent, vtkCommand::ProgressEvent, vtkCommand::EndEvent })
    {
      bench->AddObserver(event, this->Silence, beforeAllOthers);
    }
  }
}

bool vtkSchlierenActor::View::operator==(const View& other) const
{
  return this->Direction == other.Direction && this->Up == other.Up &&
    this->FocalPoint == other.FocalPoint && this->ParallelScale == other.ParallelScale &&
    this->ViewAngle == other.ViewAngle && this->Size == other.Size && this->Pupil == other.Pupil &&
    this->FocusDistance == other.FocusDistance;
}

vtkSchlierenActor::View vtkSchlierenActor::ViewOf(vtkRenderer* renderer)
{
  View view;
  vtkCamera* camera = renderer->GetActiveCamera();
  camera->GetDirectionOfProjection(view.Direction.data());
  camera->GetViewUp(view.Up.data());
  camera->GetFocalPoint(view.FocalPoint.data());
  // Undoes tiling: vtkWindowToImageFilter draws tiles with a camera each; the whole is traced.
  const double tiles = renderer->GetRenderWindow()->GetTileScale()[1];
  const double half = std::min(0.5 * vtkMath::RadiansFromDegrees(widestAngle),
    std::asin(
      std::min(1., tiles * std::sin(0.5 * vtkMath::RadiansFromDegrees(camera->GetViewAngle())))));
  view.ParallelScale = tiles * camera->GetParallelScale();
  if (!camera->GetParallelProjection())
  {
    view.ParallelScale = camera->GetDistance() * std::tan(half);
    view.ViewAngle = 2 * vtkMath::DegreesFromRadians(half);
    // By default a camera has a disc, but no distance.
    if (camera->GetFocalDistance() > 0 && camera->GetFocalDisk() > 0)
    {
      view.Pupil = camera->GetFocalDisk();
      view.FocusDistance = camera->GetFocalDistance();
    }
  }
  // Uses the window's size, that of all tiles; the renderer's is outdated in captured layouts.
  const int* size = renderer->GetRenderWindow()->GetSize();
  const double* port = renderer->GetViewport();
  for (std::size_t axis = 0; axis < 2; ++axis)
  {
    view.Size[axis] =
      std::max(1, static_cast<int>(std::lround((port[axis + 2] - port[axis]) * size[axis])));
  }
  return view;
}

bool vtkSchlierenActor::LookThrough(const View& view)
{
  const bool isMoved = !this->HasSeen || !(view == this->Seen);
  this->Seen = view;
  this->HasSeen = true;
  this->Bench->SetViewDirection(view.Direction.data());
  this->Bench->SetViewUp(view.Up.data());
  this->Bench->SetFocalPoint(view.FocalPoint.data());
  this->Bench->SetParallelScale(view.ParallelScale);
  this->Bench->SetViewAngle(view.ViewAngle);
  this->Bench->SetSensorWidth(0); // the camera has its own angle
  this->Bench->SetPupil(view.Pupil, view.FocusDistance);
  this->Bench->SetImageSize(view.Size.data());
  return isMoved;
}

void vtkSchlierenActor::SetFillsView(vtkRenderer* renderer)
{
  vtkCamera* camera = renderer->GetActiveCamera();
  const double radius = 2 * (camera->GetClippingRange()[1] + camera->GetParallelScale());
  for (int i = 0; i < 6; ++i)
  {
    this->ViewBounds[i] = camera->GetPosition()[i / 2] + (i % 2 == 0 ? -radius : radius);
  }
  this->UseBoundsOn();
}

void vtkSchlierenActor::AddTo(vtkRenderer* renderer)
{
  renderer->AddActor(this);
  renderer->AddViewProp(this->Legend);
  // Suspends FXAA around the compositing between processes, which also restores it.
  constexpr float beforeAllOthers = 100, afterAllOthers = -100;
  renderer->AddObserver(vtkCommand::StartEvent, this->SuspendFXAA, beforeAllOthers);
  renderer->AddObserver(vtkCommand::EndEvent, this->RestoreFXAA, afterAllOthers);
}

void vtkSchlierenActor::RemoveFrom(vtkRenderer* renderer)
{
  renderer->RemoveActor(this);
  renderer->RemoveViewProp(this->Legend);
  renderer->RemoveObserver(this->SuspendFXAA);
  renderer->RemoveObserver(this->RestoreFXAA);
}

bool vtkSchlierenActor::IsHidden(vtkRenderer* renderer)
{
  vtkPropCollection* props = renderer->GetViewProps();
  for (int i = 0; i < props->GetNumberOfItems(); ++i)
  {
    auto* actor = vtkSchlierenActor::SafeDownCast(props->GetItemAsObject(i));
    if (actor && actor->GetVisibility())
    {
      return actor != this;
    }
  }
  return false;
}

void vtkSchlierenActor::UpdateImage(vtkRenderer* renderer)
{
  this->UseGreyScene();
  if (!this->HasSeen)
  {
    this->Reduction = reductionAtFirst;
    this->Bench->SetPreviewReduction(reductionAtFirst);
    this->Bench->SetTimeLimit(0);
    this->Bench->Update();
    this->Finished = false;
  }
  else
  {
    this->LookThrough(ViewOf(renderer));
    this->TraceUpTo(this->TimeSlice);
  }
  this->HasData = true;
  this->NoteTimes();
}

void vtkSchlierenActor::NoteTimes()
{
  this->KnownTime = this->Bench->GetMTime();
  this->FailedTime = this->Bench->GetHasImage() ? 0 : this->KnownTime;
  this->HasMore = false;
}

bool vtkSchlierenActor::IsChanged() const
{
  return this->Bench && this->Bench->GetMTime() != this->KnownTime;
}

bool vtkSchlierenActor::HasFailed() const
{
  return this->FailedTime != 0 && this->FailedTime == this->Bench->GetMTime();
}

bool vtkSchlierenActor::GetFinished() const
{
  return this->Finished || !this->HasData || this->HasFailed() || this->Bench->GetStopped();
}

void vtkSchlierenActor::TraceUpTo(double seconds)
{
  this->Reduction = 1;
  this->Bench->SetPreviewReduction(1);
  this->Bench->SetTimeLimit(seconds);
  if (!(seconds > 0) && !this->Bench->GetStopped())
  {
    this->Bench->Refine(); // resumes what began with a limit
  }
  this->Bench->Update();
  this->Finished = this->Bench->GetFinished();
}

void vtkSchlierenActor::TracePreview()
{
  const double pixels = static_cast<double>(this->Seen.Size[0]) * this->Seen.Size[1];
  const double wanted = std::sqrt(pixels * this->SecondsPerPixel / previewSeconds);
  // A preview has one ray per pixel; at full size it would be all of the image.
  const bool isOneRay =
    this->Bench->GetSamplesPerPixel() <= 1 && this->Bench->GetTargetError() == 0;
  this->Reduction = std::clamp(static_cast<int>(std::ceil(wanted)), isOneRay ? 1 : 2, coarsest);
  this->Bench->SetPreviewReduction(this->Reduction);
  this->Bench->SetTimeLimit(0);
  const vtkTypeInt64 before = this->Bench->GetPictureCount();
  const double begin = vtkTimerLog::GetUniversalTime();
  this->Bench->Update();
  // Ignores measured times with several ranks, which must make the same image.
  if (!this->HasOtherRanks && this->Bench->GetPictureCount() != before)
  {
    const double seconds = vtkTimerLog::GetUniversalTime() - begin;
    const double measured = seconds * this->Reduction * this->Reduction / pixels;
    // Damps single delays.
    this->SecondsPerPixel =
      std::min(0.5 * (this->SecondsPerPixel + measured), 20 * this->SecondsPerPixel);
  }
  this->Finished = false;
}

void vtkSchlierenActor::Trace(int occasion, bool isMoved)
{
  if (occasion == TURNED || (isMoved && this->TimeSlice > 0 && occasion != SCREENSHOT))
  {
    this->TracePreview();
  }
  else if (occasion == SCREENSHOT || !(this->TimeSlice > 0))
  {
    this->TraceUpTo(0);
  }
  else
  {
    this->Bench->Update(); // shows the result of Refine()
    this->Finished = this->Reduction == 1 && this->Bench->GetFinished();
  }
}

bool vtkSchlierenActor::Refine()
{
  if (this->GetFinished() || !this->HasSeen || !(this->TimeSlice > 0))
  {
    return false;
  }
  if (this->HasMore)
  {
    return true; // drawing takes time, too, and has a turn of its own
  }
  const Silent silent(this->Silence);
  this->Reduction = 1;
  this->Bench->SetPreviewReduction(1);
  this->Bench->SetTimeLimit(this->TimeSlice);
  const vtkTypeInt64 before = this->Bench->GetPictureCount();
  this->Bench->Refine();
  this->KnownTime = this->Bench->GetMTime();
  this->HasMore = this->Bench->GetPictureCount() != before || this->Bench->GetFinished();
  return false;
}

int vtkSchlierenActor::RenderOpaqueGeometry(vtkViewport* viewport)
{
  int drawn = 0;
  filters::guarded([&] { drawn = this->DrawImage(viewport); },
    "There is not enough memory to draw the image. Make the view smaller.",
    [this](const std::string& problem) { vtkErrorMacro(<< problem); });
  return drawn;
}

int vtkSchlierenActor::DrawImage(vtkViewport* viewport)
{
  this->Legend->SetImage(nullptr);
  auto* renderer = vtkRenderer::SafeDownCast(viewport);
  if (!renderer || this->IsHidden(renderer))
  {
    return 0;
  }
  // Recognizes interaction by ParaView's desired rate of 5 images per second instead of 0.002.
  const int occasion = this->IsForScreenshot                  ? SCREENSHOT
    : renderer->GetRenderWindow()->GetDesiredUpdateRate() > 1 ? TURNED
                                                              : STILL;
  const View view = ViewOf(renderer);
  this->UpdateScene(renderer, view);
  if (!this->MakeImage(view, occasion))
  {
    return 0;
  }
  const int* size = this->Pixels->GetDimensions();
  this->GetTexture()->SetInterpolate(size[0] != view.Size[0] || size[1] != view.Size[1]);
  this->PlaceQuad(renderer);
  this->Legend->SetImage(this->Pixels);
  return this->Superclass::RenderOpaqueGeometry(viewport);
}

bool vtkSchlierenActor::MakeImage(const View& view, int occasion)
{
  if (!this->Bench || !this->HasData || this->HasFailed())
  {
    return false;
  }
  const Silent silent(this->Silence);
  this->Trace(occasion, this->LookThrough(view));
  this->NoteTimes();
  if (this->Bench->GetOutput()->GetNumberOfPoints() == 0) // it failed, or rank 0 has it
  {
    return false;
  }
  this->UpdatePixels();
  return true;
}

void vtkSchlierenActor::UpdatePixels()
{
  vtkImageData* image = this->Bench->GetOutput();
  if (this->PixelsTime != image->GetMTime())
  {
    this->PixelsTime = image->GetMTime();
    this->Pixels->Initialize();
    this->Pixels->SetDimensions(image->GetDimensions());
    this->Pixels->SetOrigin(image->GetOrigin());
    this->Pixels->SetSpacing(image->GetSpacing());
    vtkSchlierenLegend::CopyFieldData(image, this->Pixels);
    vtkPointData* arrays = image->GetPointData();
    if (vtkDataArray* color = arrays->GetArray("Color"))
    {
      this->Pixels->GetPointData()->SetScalars(color);
    }
    else
    {
      this->Pixels->GetPointData()->SetScalars(greyOf(
        arrays->GetArray("Intensity"), vtkSchlierenFilter::CutoffWhite(this->Bench->GetCutoff())));
    }
    this->Pixels->Modified();
  }
}

bool vtkSchlierenActor::HasScene() const
{
  return this->Bench && vtkSchlierenFilter::CutoffHasBackground(this->Bench->GetCutoff()) &&
    this->Bench->GetBackgroundPattern() == vtkSchlierenFilter::SCENE;
}

void vtkSchlierenActor::UseGreyScene()
{
  if (this->HasScene() && !this->HasDrawnScene && !this->HasOtherRanks)
  {
    constexpr int grey = 128;
    vtkNew<vtkImageData> pixel;
    pixel->SetDimensions(1, 1, 1);
    pixel->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
    pixel->GetPointData()->GetScalars()->Fill(grey);
    this->Bench->SetBackgroundScene(pixel, -1);
  }
}

double vtkSchlierenActor::DepthOfImage(vtkCamera* camera) const
{
  const double* range = camera->GetClippingRange();
  const double margin = beforeFarPlane * (range[1] - range[0]);
  const bool isBehindFlow = this->HasScene() && vtkMath::AreBoundsInitialized(this->FlowBounds);
  const double wanted = isBehindFlow ? backOf(this->FlowBounds, camera) + margin : range[1];
  return std::clamp(wanted, range[0] + margin, range[1] - margin);
}

void vtkSchlierenActor::UpdateScene(vtkRenderer* renderer, const View& view)
{
  if (!this->HasScene() || this->HasOtherRanks || !vtkMath::AreBoundsInitialized(this->FlowBounds))
  {
    return;
  }
  // Uses the aspect of all tiles of a large screenshot.
  vtkCamera* camera = renderer->GetActiveCamera();
  auto whole = vtkSmartPointer<vtkCamera>::Take(renderer->MakeCamera());
  whole->DeepCopy(camera);
  whole->SetWindowCenter(0, 0);
  whole->SetParallelScale(view.ParallelScale);
  if (!camera->GetParallelProjection())
  {
    whole->SetViewAngle(view.ViewAngle);
  }
  const double depth = this->DepthOfImage(camera);
  const SceneBehind scene(renderer);
  const auto image = scene.Draw(whole, view.Size.data(), depth);
  this->Bench->SetBackgroundScene(image, scene.GetDistance(depth));
  this->HasDrawnScene = true;
}

// Places the quad by the view's coordinates: x to the right, y upwards.
void vtkSchlierenActor::PlaceQuad(vtkRenderer* renderer)
{
  const double* pixel = this->Pixels->GetSpacing();
  double centers[6];
  this->Pixels->GetBounds(centers);
  vtkCamera* camera = renderer->GetActiveCamera();
  const double* direction = this->Seen.Direction.data();
  const double* focalPoint = this->Seen.FocalPoint.data();
  double right[3], up[3];
  vtkMath::Cross(direction, this->Seen.Up.data(), right);
  vtkMath::Normalize(right);
  vtkMath::Cross(right, direction, up);
  const double depth = this->DepthOfImage(camera);
  // Scales from the focal point's depth.
  const double scale = camera->GetParallelProjection() ? 1 : depth / camera->GetDistance();
  const double middle[2] = { vtkMath::Dot(focalPoint, right), vtkMath::Dot(focalPoint, up) };
  const double* eye = camera->GetPosition();
  const double low[2] = { centers[0] - 0.5 * pixel[0], centers[2] - 0.5 * pixel[1] };
  const double high[2] = { centers[1] + 0.5 * pixel[0], centers[3] + 0.5 * pixel[1] };
  for (int corner = 0; corner < 4; ++corner)
  {
    const double x = scale * ((corner == 1 || corner == 2 ? high[0] : low[0]) - middle[0]);
    const double y = scale * ((corner >= 2 ? high[1] : low[1]) - middle[1]);
    double point[3];
    for (int i = 0; i < 3; ++i)
    {
      point[i] = eye[i] + depth * direction[i] + x * right[i] + y * up[i];
    }
    this->Quad->GetPoints()->SetPoint(corner, point);
  }
  this->Quad->GetPoints()->Modified();
  this->Quad->Modified();
}
