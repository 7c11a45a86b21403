// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// How vtkSchlierenFilter makes an image: at once, time-sliced, or between updates (Refine).
#include "Filter/SchlierenFilterInternals.h"

#include "Common/AvailableMemory.h"
#include "Common/Sentences.h"
#include "Common/Threads.h"
#include "Guarded.h"
#include "Image/ImageLegend.h"
#include "Image/ImageOutput.h"
#include "Image/ImageStatus.h"
#include "Image/Preview.h"
#include "Image/RealOptics.h"
#include "Image/SceneFromSettings.h"
#include "Input/InputDescription.h"
#include "Sources/PieceSource.h"
#include "Sources/RevolvedSource.h"

#include "vtkCommand.h"
#include "vtkPiecewiseFunction.h"

#include <algorithm>
#include <string>
#include <utility>

using namespace filters;

namespace
{

/// Throws where the arrays of an image, and of what it is made of, do not fit into memory.
void requireMemoryFor(const schlieren::View& view, bool isColored, bool hasBackground)
{
  constexpr double ofRays = 7 * sizeof(float) + sizeof(double); // directions, displacements, paths
  constexpr double ofFilm = sizeof(float) + sizeof(double);
  constexpr double ofColor = 3 * (sizeof(float) + sizeof(double) + 1);
  constexpr double ofBackground = 3 * sizeof(float) + sizeof(double);
  const double bytes =
    ofRays + ofFilm + (isColored ? ofColor : 0) + (hasBackground ? ofBackground : 0);
  const double width = view.width, height = view.height;
  requireMemory(bytes * std::max(0., width) * std::max(0., height),
    "An image of " + std::to_string(view.width) + " x " + std::to_string(view.height) + " pixels",
    "Give a smaller ImageSize.");
}

/// What has been decided of places without cells; nothing is of images.
GasBoundary::Decided decidedIn(const schlieren::MediumSource* source)
{
  const auto* revolved = dynamic_cast<const RevolvedSource*>(source);
  const auto* piece = dynamic_cast<const PieceSource*>(revolved ? revolved->section() : source);
  return piece ? piece->boundary().decided() : GasBoundary::Decided{ 0, true };
}

} // namespace

void vtkSchlierenFilter::Refine()
{
  Internals& inside = *this->Inside;
  FilterRanks& ranks = inside.Ranks.ranks();
  bool hasMore = false;
  ranks.resume();
  if (isRank0())
  {
    Internals::WithRanks withRanks(inside);
    const auto work = [&] { hasMore = this->RefineOnRank0(); };
    if (!guarded(work, "", [](const std::string&) {})) // an update begins again, and says it
    {
      inside.UnfinishedOf = 0;
      hasMore = true;
    }
    withRanks.Outcome = { hasMore, inside.HasImage };
  }
  else
  {
    hasMore = ranks
                .serve(threadsFrom(this->NumberOfThreads),
                  [&](const std::vector<char>& request) { return inside.Ranks.answer(request); })
                .hasMore;
  }
  if (hasMore)
  {
    inside.RefineTime.Modified();
    this->InvokeEvent(vtkCommand::ModifiedEvent);
  }
}

bool vtkSchlierenFilter::RefineOnRank0()
{
  Internals& inside = *this->Inside;
  if (this->GetStopped())
  {
    const vtkMTimeType stopped = std::exchange(inside.StoppedOf, 0);
    if (inside.FailedAt == stopped) // there is nothing to continue
    {
      inside.FailedAt = 0;
    }
    else
    {
      inside.UnfinishedOf = stopped;
    }
    return true;
  }
  return this->TimeLimit > 0 ? this->WorkOn() : !this->GetFinished();
}

void vtkSchlierenFilter::Stop()
{
  Internals& inside = *this->Inside;
  inside.IsStopping = true;
  if (inside.UnfinishedOf != 0 && inside.UnfinishedOf == this->GetTimeOfImage())
  {
    inside.StoppedOf = std::exchange(inside.UnfinishedOf, 0);
  }
}

bool vtkSchlierenFilter::GetStopped()
{
  return this->Inside->StoppedOf != 0 && this->Inside->StoppedOf == this->GetTimeOfImage();
}

bool vtkSchlierenFilter::GetHasImage() { return this->Inside->HasImage; }

int vtkSchlierenFilter::GetPercentDone()
{
  const int percent = static_cast<int>(100 * this->Inside->Done);
  return this->GetFinished() && !this->GetStopped() ? 100 : std::min(percent, 99);
}

bool vtkSchlierenFilter::WorkOn()
{
  Internals& inside = *this->Inside;
  const vtkMTimeType now = this->GetTimeOfImage();
  const bool continues = inside.UnfinishedOf == now && this->UseOwnRanks();
  if (continues && inside.Ready)
  {
    return true;
  }
  if (continues || this->CanBegin(now))
  {
    schlieren::Monitor monitor;
    monitor.progress = [&inside](double done) { inside.Done = done; };
    schlieren::Image image = continues ? inside.Images.Resume(this->TimeLimit, monitor)
                                       : this->Begin(false, this->TimeLimit, monitor);
    inside.UnfinishedOf = now;
    if (!image.finished && image.intensity.empty())
    {
      inside.Ready.reset();
      return false;
    }
    inside.Ready = std::move(image);
    return true;
  }
  return std::exchange(inside.UnfinishedOf, 0) != 0; // then there will be another image
}

bool vtkSchlierenFilter::CanBegin(vtkMTimeType now)
{
  Internals& inside = *this->Inside;
  return inside.ShownOf != 0 && inside.ShownOf != now && inside.FailedAt != now &&
    inside.Shown[IMAGE_PORT].IsThere() &&
    inside.holdsRefractivityOf(
      this->DescribeInputs(inside.Ranks.gatheredOf(0, this->GetInputDataObject(0, 0)),
        inside.Ranks.gatheredOf(BODIES, this->GetInputDataObject(BODIES, 0))),
      this->GetMediumSettings()) &&
    this->UseOwnRanks();
}

vtkTypeInt64 vtkSchlierenFilter::GetImageCount() const
{
  return this->ImageCount + (this->Inside->Ready ? 1 : 0);
}

bool vtkSchlierenFilter::GetFinished() { return this->Inside->UnfinishedOf == 0; }

bool vtkSchlierenFilter::Continues(vtkDataObject* input, vtkDataObject* bodies)
{
  Internals& inside = *this->Inside;
  return !this->GetFinished() && inside.UnfinishedOf == this->GetTimeOfImage() &&
    inside.holdsRefractivityOf(this->DescribeInputs(input, bodies), this->GetMediumSettings()) &&
    this->UseOwnRanks();
}

bool vtkSchlierenFilter::Render(vtkImageData* output, vtkImageData* histogram, bool continues)
{
  Internals& inside = *this->Inside;
  schlieren::Monitor monitor;
  monitor.aborted = [this]() { return this->GetAbortExecute() != 0; };
  monitor.progress = [this](double fraction)
  {
    this->Inside->Done = fraction;
    if (!(this->TimeLimit > 0)) // else it would flicker
    {
      this->SetProgressText("tracing light");
      this->UpdateProgress(mediumFraction + (1 - mediumFraction) * fraction);
    }
  };
  std::optional<schlieren::Image> ready = std::exchange(inside.Ready, std::nullopt);
  if (continues && ready && (this->TimeLimit > 0 || ready->finished))
  {
    return this->Show(std::move(*ready), output, histogram);
  }
  ready.reset();
  if (continues)
  {
    return this->Show(inside.Images.Resume(this->TimeLimit, monitor), output, histogram);
  }

  const LastImage& shown = inside.Shown[IMAGE_PORT];
  if (this->TimeLimit > 0 && (!shown.IsThere() || (this->HasOwnColor() && !shown.HasColor())))
  {
    // Something to show if time is over before the first sample of each pixel is there.
    if (!this->Show(this->Begin(true, 0, monitor), output, histogram))
    {
      return false;
    }
  }
  schlieren::Image image = this->Begin(false, this->TimeLimit, monitor);
  // A time step is not shown with the image of another: an animation does not wait until that is refined.
  while (inside.ShownTime && inside.ShownTime != inside.Time && image.intensity.empty() &&
    !image.finished && !image.aborted)
  {
    image = inside.Images.Resume(this->TimeLimit, monitor);
  }
  return this->Show(std::move(image), output, histogram);
}

ImageCircumstances vtkSchlierenFilter::CircumstancesOf(
  std::vector<double> medium, std::vector<double> rays)
{
  const Internals& inside = *this->Inside;
  MediumSettings properties = inside.inUse(this->GetMediumSettings());
  properties.DoublePrecision = false;
  return { inside.Time, inside.Input, std::move(properties), std::move(medium), std::move(rays) };
}

ImageCircumstances vtkSchlierenFilter::CircumstancesOfRays()
{
  return this->CircumstancesOf(
    { std::max(this->AmbientRefractivity, -1.), static_cast<double>(this->ExitInto),
      this->ExitInto == EXIT_CUSTOM ? this->ExitRefractivity : 0 },
    settingsOfRays(*this));
}

void vtkSchlierenFilter::UseKept(schlieren::Scene& scene)
{
  std::optional<double> kept;
  if (choosesK(*this) || choosesScreen(scene)) // else what is kept waits: the change may be undone
  {
    kept =
      this->Inside->SensitivityLocks[this->Cutoff].For(this->KMode, this->CircumstancesOfRays());
  }
  if (kept)
  {
    (choosesScreen(scene) ? scene.screenDistance : scene.kScale) = kept;
  }
  else if (this->KMode == K_AUTOMATIC_KEPT)
  {
    this->KScaleUsed = this->AutomaticUsed = 0; // those of an earlier image do not hold any more
  }
}

std::optional<double> vtkSchlierenFilter::KeptAmbient()
{
  this->Inside->AmbientLock.For(K_AUTOMATIC, this->CircumstancesOf({}, {}));
  // Given at the time that it was found, it would make another medium of the same data.
  return this->Inside->AmbientLock.GetKept();
}

schlieren::Image vtkSchlierenFilter::Begin(
  bool isPreview, double seconds, const schlieren::Monitor& monitor)
{
  Internals& inside = *this->Inside;
  inside.Done = 0;
  schlieren::Field field = Internals::fieldOf(*inside.Refractivity);
  field.ambient = this->AmbientRefractivity <= -1 ? this->KeptAmbient() : this->AmbientRefractivity;
  inside.FindsAmbient = !field.ambient;
  field.lengthScale = this->LengthScale;
  schlieren::Scene scene =
    sceneFrom(this->SettingsFor(inside.Refractivity->FlatAxis), field.grid, inside.RgbImages);
  if (scene.cutoff == schlieren::Cutoff::GradedFilter)
  {
    scene.gradedFilter = gradedFilterFrom(this->GradedFilter);
  }
  if (inside.Pupil.aperture > 0)
  {
    scene.lens.aperture = inside.Pupil.aperture;
    scene.lens.focusDistance = inside.Pupil.focusDistance;
  }
  this->UseKept(scene);
  if (isPreview)
  {
    makePreview(scene, schlieren::frameOf(field.grid, scene.view), reductionAtFirst(scene.view));
  }
  requireMemoryFor(scene.view, this->HasOwnColor(), CutoffHasBackground(this->Cutoff));
  return inside.Images.Begin(field, scene, seconds, monitor);
}

void vtkSchlierenFilter::KeepFound(const schlieren::Image& image)
{
  Internals& inside = *this->Inside;
  const schlieren::Scene& scene = inside.Images.GetScene();
  const bool hasScreen = choosesScreen(scene);
  const double found = hasScreen ? image.screenDistance : image.kScale;
  if (!(hasScreen ? scene.screenDistance : scene.kScale) && found > 0)
  {
    inside.SensitivityLocks[this->Cutoff].Found(found);
  }
  if (inside.FindsAmbient)
  {
    inside.AmbientLock.Found(image.ambient);
  }
}

bool vtkSchlierenFilter::Show(
  schlieren::Image&& image, vtkImageData* output, vtkImageData* histogram)
{
  Internals& inside = *this->Inside;
  inside.UnfinishedOf = image.finished || image.aborted ? 0 : this->GetTimeOfImage();
  if (image.aborted)
  {
    return false;
  }
  inside.ShownOf = this->GetTimeOfImage();
  if (image.intensity.empty()) // no more samples than before
  {
    return true;
  }
  inside.ShownTime = inside.Time;
  const schlieren::Scene& scene = inside.Images.GetScene();
  const SchlierenSettings settings = this->SettingsFor(inside.Refractivity->FlatAxis);
  const bool isWhole =
    image.width == settings.ImageSize[0] && image.height == settings.ImageSize[1];
  const GasBoundary::Decided decided = decidedIn(inside.Refractivity->Source.get());
  const std::string outside = decided.bodies > 0 ? outsideInWords(image, decided.isAlone) : "";
  if (isWhole) // of a preview the whole image will say it
  {
    constexpr double most = 0.5;
    if (!outside.empty() && blockedShare(image) > most &&
      inside.Refractivity->IsForMe("outside", this) && !std::exchange(inside.HasNotedOutside, true))
    {
      vtkWarningMacro(
        << outside
        << ": places that the mesh leaves out are taken for a body. If they are none, "
           "set Outside to Passes, and give bodies as Bodies."
        << seeTroubleshooting);
    }
    for (const auto& [kind, warning] : inside.Images.GetWarnings(image))
    {
      if (inside.Refractivity->IsForMe(kind, this))
      {
        vtkWarningMacro(<< warning << seeTroubleshooting);
      }
    }
  }
  if (isWhole)
  {
    this->KeepFound(image);
  }
  const bool isAutomatic = choosesK(*this) || choosesScreen(scene);
  const bool isKept = isAutomatic && this->GetLockedK() > 0;
  // Waves are made of a finished image.
  const bool isStillOfRays =
    lightModelOf(*this) == schlieren::LightModel::Waves && (!isWhole || !image.finished);
  this->Status = std::string(isWhole ? "" : "Preview: ") + (isStillOfRays ? "rays as yet, " : "") +
    inside.Images.GetStatus(image) + (outside.empty() ? "" : ", " + outside) +
    (inside.Refractivity->Wedge.empty() ? "" : ", " + inside.Refractivity->Wedge) +
    (isKept && image.kScale > 0 ? ", " + kInWords(image.kScale, isKept) : "");
  this->KScaleUsed = image.kScale;
  this->AutomaticUsed = isAutomatic ? std::max(image.kScale, image.screenDistance) : 0;
  const std::string camera = cameraInWords(settings, scene, image);
  this->Sensitivity = sensitivityInWords(*this, image.kScale, isKept);
  this->Sensitivity += (this->Sensitivity.empty() || camera.empty() ? "" : "; ") + camera;
  ++this->ImageCount;
  output->Initialize();
  histogram->Initialize();
  const ColorScale colors = this->HasOwnColor() ? ColorScale::Srgb
    : CutoffWhite(this->Cutoff) > 1             ? ColorScale::LinearToTwice
                                                : ColorScale::Linear;
  addLegend(output, *this, scene, image, isKept, colors);
  setOutput(output, image);
  if (!image.color.empty())
  {
    addColor(output, image);
  }
  if (schlieren::techniqueOf(scene.cutoff).hasFringes)
  {
    addFringes(output, scene);
  }
  if (const auto& source = inside.Refractivity->Source)
  {
    inside.Grid = mediumInWords(image.medium);
    inside.Grid += source->makers() ? ", of data that stay on their ranks" : "";
    addMedium(output, image.medium);
  }
  addGrid(output, this->GetGrid());
  setHistogram(histogram, image.histogram);
  inside.Shown[IMAGE_PORT].Keep(output);
  inside.Shown[HISTOGRAM_PORT].Keep(histogram);
  return true;
}
