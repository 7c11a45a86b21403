// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSchlierenActor.h"

#include "Guarded.h"
#include "vtkSchlierenFilter.h"
#include "vtkSchlierenLegend.h"

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
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cmath>

namespace
{

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

} // namespace

vtkStandardNewMacro(vtkSchlierenActor);

vtkSchlierenActor::vtkSchlierenActor()
{
  vtkMath::UninitializeBounds(this->ViewBounds);
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
  this->HasData = this->HasSeen = false;
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

double vtkSchlierenActor::DepthOfImage(vtkCamera* camera)
{
  const double* range = camera->GetClippingRange();
  return range[1] - beforeFarPlane * (range[1] - range[0]);
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
