// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// How the bench traces what a view looks at: at once, time-sliced, or as a preview.
#include "vtkSchlierenActor.h"

#include "vtkSchlierenFilter.h"

#include "vtkCallbackCommand.h"
#include "vtkCamera.h"
#include "vtkImageData.h"
#include "vtkMath.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkTimerLog.h"

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

void vtkSchlierenActor::UpdateImage(vtkRenderer* renderer)
{
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
  this->HasNews = false;
  this->NoteTimes();
}

void vtkSchlierenActor::NoteNews() { this->HasNews = this->IsChanged(); }

void vtkSchlierenActor::NoteTimes()
{
  this->KnownTime = this->Bench->GetMTime();
  this->FailedTime = this->Bench->GetHasImage() ? 0 : this->KnownTime;
  this->HasMore = false;
}

bool vtkSchlierenActor::IsChanged() const
{
  return this->Bench && (this->HasNews || this->Bench->GetMTime() != this->KnownTime);
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
  const vtkTypeInt64 before = this->Bench->GetImageCount();
  const double begin = vtkTimerLog::GetUniversalTime();
  this->Bench->Update();
  // Ignores measured times with several ranks, which must make the same image.
  if (!this->HasOtherRanks && this->Bench->GetImageCount() != before)
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
  this->NoteNews();
  this->Reduction = 1;
  this->Bench->SetPreviewReduction(1);
  this->Bench->SetTimeLimit(this->TimeSlice);
  const vtkTypeInt64 before = this->Bench->GetImageCount();
  this->Bench->Refine();
  this->KnownTime = this->Bench->GetMTime();
  this->HasMore = this->Bench->GetImageCount() != before || this->Bench->GetFinished();
  return false;
}

bool vtkSchlierenActor::MakeImage(const View& view, int occasion)
{
  if (!this->Bench || !this->HasData || this->HasFailed())
  {
    return false;
  }
  const Silent silent(this->Silence);
  this->NoteNews();
  this->Trace(occasion, this->LookThrough(view));
  this->NoteTimes();
  if (this->Bench->GetOutput()->GetNumberOfPoints() == 0) // it failed, or rank 0 has it
  {
    return false;
  }
  this->UpdatePixels();
  return true;
}
