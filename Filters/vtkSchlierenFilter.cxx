// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSchlierenFilter.h"

#include "ExposureSteps.h"
#include "FieldFromImage.h"
#include "FieldTints.h"
#include "GasChoices.h"
#include "HurriedPicture.h"
#include "InputDescription.h"
#include "LastPicture.h"
#include "MeanImage.h"
#include "PictureInSlices.h"
#include "PictureOutput.h"
#include "QualityPresets.h"
#include "Ranks.h"
#include "RealOptics.h"
#include "RefractivitySource.h"
#include "RgbPictures.h"
#include "SceneFromFilter.h"
#include "SensitivityLock.h"

#include "vtkCommand.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPiecewiseFunction.h"
#include "vtkPointData.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkTimeStamp.h"

#include "Schlieren.h"

#include <algorithm>
#include <limits>
#include <new>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

vtkStandardNewMacro(vtkSchlierenFilter);

struct vtkSchlierenFilter::Internals
{
  /// The other ranks trace rays while this is there.
  class WithWorkers
  {
  public:
    WithWorkers(Internals& internals, const FilterRanks::Meeting& meeting)
      : Of(internals)
    {
      this->Of.Pictures.SetWorkers(meeting.GetWorkers());
    }
    ~WithWorkers() { this->Of.Pictures.SetWorkers({}); }
    WithWorkers(const WithWorkers&) = delete;
    WithWorkers& operator=(const WithWorkers&) = delete;

  private:
    Internals& Of;
  };

  FilterRanks Ranks;
  PictureInSlices Pictures;
  LastPicture Shown[2]; // at each output
  RgbPictureReader RgbPictures;
  vtkNew<vtkImageData> Refractivity;
  std::shared_ptr<const schlieren::MediumSource> Source; // instead of Refractivity, of meshes
  vtkTimeStamp SourceTime;
  std::string Grid; // what Source was divided into

  schlieren::Field field() const
  {
    if (!this->Source)
    {
      return fieldFrom(this->Refractivity);
    }
    schlieren::Field field;
    field.source = this->Source;
    field.grid = schlieren::coarsestGrid(*this->Source);
    field.version = this->SourceTime.GetMTime();
    return field;
  }

  // What Refractivity was made from: the input, and Medium at that time (0: nothing yet).
  std::vector<double> Input;
  vtkMTimeType MediumTime = 0;

  // A source has fields only where it needs them: its voxels are as fine as these ask for.
  bool holdsRefractivityOf(
    const std::vector<double>& input, vtkRefractiveIndex* medium, bool needsFields) const
  {
    return this->MediumTime == medium->GetMTime() && this->Input == input &&
      (!this->Source || (this->Source->fields() > 0) == needsFields);
  }

  // Of the fields that tint, on the grid of Refractivity; empty where not needed, or where Source has them.
  std::vector<float> FieldGradients;

  // Newest time of this filter and of everything upstream, Refine() apart, when it last failed, when the picture
  // at the outputs was begun, and the one that is not finished (0: there is none).
  vtkMTimeType FailedAt = 0;
  vtkMTimeType ShownOf = 0;
  vtkMTimeType UnfinishedOf = 0;
  vtkTimeStamp RefineTime;

  SensitivityLock KLock;
  SensitivityLock AmbientLock;
  bool FindsAmbient = false;  // for the image that was begun last
  std::optional<double> Time; // of the last update; unset for data without time steps

  TimeExposure Exposure;   // of the last request
  std::size_t Instant = 0; // of these, the one that is being made
  // The image of its first instant, whose k and surroundings, and place, are those of all others.
  std::optional<schlieren::Image> FirstInstant;

  // Of Medium, the last time that Precision changed it, and before that.
  vtkMTimeType PrecisionTime = 0;
  vtkMTimeType TimeBeforePrecision = 0;

  /// When anything but Precision has last changed Medium.
  vtkMTimeType settingsTimeOf(vtkRefractiveIndex* medium) const
  {
    const vtkMTimeType time = medium->GetMTime();
    return time == this->PrecisionTime ? this->TimeBeforePrecision : time;
  }

  vtkMTimeType StoppedOf = 0; // the one that Stop(), or an abort within a limit, has left; 0: none
  double Done = 0;            // of the image that was begun last: 0 to 1

  std::optional<schlieren::Image> Ready; // made by Refine(), and to be shown by the next update

  void DropShown()
  {
    this->Shown[0].Drop();
    this->Shown[1].Drop();
  }
};

namespace
{

/// Share of the progress bar that belongs to finding the refractivity.
constexpr double mediumShare = 0.2;

/// The direction of both outputs, which since VTK 9.3 would else be the input's.
constexpr double unturned[9] = { 1, 0, 0, 0, 1, 0, 0, 0, 1 };

/// Whether two array selections say the same.
bool sameSelection(vtkInformation* a, vtkInformation* b)
{
  const auto name = [](vtkInformation* info)
  {
    const char* text =
      info->Has(vtkDataObject::FIELD_NAME()) ? info->Get(vtkDataObject::FIELD_NAME()) : nullptr;
    return std::string(text ? text : "");
  };
  const auto number = [](vtkInformation* info, vtkInformationIntegerKey* key)
  { return info->Has(key) ? info->Get(key) : -1; };
  return name(a) == name(b) &&
    number(a, vtkDataObject::FIELD_ASSOCIATION()) ==
    number(b, vtkDataObject::FIELD_ASSOCIATION()) &&
    number(a, vtkDataObject::FIELD_ATTRIBUTE_TYPE()) ==
    number(b, vtkDataObject::FIELD_ATTRIBUTE_TYPE());
}

/// Everything of the inputs that the refractivity depends on.
std::vector<double> describeInputs(
  vtkSchlierenFilter* self, vtkDataObject* input, vtkDataObject* bodies)
{
  std::vector<double> description = describeInput(input, upstreamTime(self, 0));
  if (bodies)
  {
    const std::vector<double> ofBodies =
      describeInput(bodies, upstreamTime(self, vtkRefractiveIndex::BODIES));
    description.insert(description.end(), ofBodies.begin(), ofBodies.end());
  }
  return description;
}

/// Whether there are no data because a filter before this one was aborted.
bool isAbortedUpstream(vtkAlgorithm* filter, vtkDataObject* input)
{
  if (!input || input->GetNumberOfElements(vtkDataObject::POINT) > 0)
  {
    return false;
  }
  while (filter->GetNumberOfInputPorts() > 0 && filter->GetNumberOfInputConnections(0) > 0)
  {
    filter = filter->GetInputAlgorithm(0, 0);
    if (filter->GetAbortExecute())
    {
      return true;
    }
  }
  return false;
}

const char* const noIndexYet = "No image: the refractive index is not known yet";

/// Whether the bench itself makes colours.
bool seesColor(vtkSchlierenFilter* self)
{
  switch (self->GetCutoff())
  {
    case vtkSchlierenFilter::COLOR_FILTER:
      return true;
    case vtkSchlierenFilter::INTERFEROGRAM:
      return self->GetWhiteLight();
    case vtkSchlierenFilter::BACKGROUND_ORIENTED:
      return self->GetBackgroundPattern() == vtkSchlierenFilter::PICTURE;
    default:
      return false;
  }
}

ColorScale colorScaleFrom(vtkSchlierenFilter* self)
{
  const bool isShadow = self->GetCutoff() == vtkSchlierenFilter::SHADOWGRAPH;
  return seesColor(self) ? ColorScale::Srgb
                         : (isShadow ? ColorScale::LinearToTwice : ColorScale::Linear);
}

bool liesAt(const schlieren::Frame& frame, const schlieren::Frame& place)
{
  return frame.origin == place.origin && frame.pixelSize == place.pixelSize;
}

/// Tells the executive where the outputs lie.
void tellPlaces(vtkInformationVector* outputs)
{
  for (int port = 0; port < outputs->GetNumberOfInformationObjects(); ++port)
  {
    vtkImageData* image = vtkImageData::GetData(outputs, port);
    vtkInformation* info = outputs->GetInformationObject(port);
    info->Set(vtkDataObject::ORIGIN(), image->GetOrigin(), 3);
    info->Set(vtkDataObject::SPACING(), image->GetSpacing(), 3);
  }
}

} // namespace

//------------------------------------------------------------------------------
vtkSchlierenFilter::vtkSchlierenFilter()
  : Inside(new Internals)
{
  this->SetNumberOfInputPorts(2);
  this->SetNumberOfOutputPorts(2);
  this->vtkSchlierenFilter::SetQuality(INTERACTIVE);
  this->Medium->AddObserver(vtkCommand::ProgressEvent, this, &vtkSchlierenFilter::OnMediumProgress);
}

//------------------------------------------------------------------------------
vtkSchlierenFilter::~vtkSchlierenFilter() = default;

//------------------------------------------------------------------------------
void vtkSchlierenFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Medium:\n";
  this->Medium->PrintSelf(os, indent.GetNextIndent());
  os << indent << "LengthScale: " << this->LengthScale << "\n";
  os << indent << "AutoAmbientRefractivity: " << this->AutoAmbientRefractivity << "\n";
  os << indent << "AmbientRefractivity: " << this->AmbientRefractivity << "\n";
  os << indent << "LockAmbient: " << this->LockAmbient << "\n";
  os << indent << "LockedAmbient: " << this->GetLockedAmbient() << "\n";
  os << indent << "Wavelength: " << this->Wavelength << "\n";
  os << indent << "ViewDirection: " << this->ViewDirection[0] << " " << this->ViewDirection[1]
     << " " << this->ViewDirection[2] << "\n";
  os << indent << "ViewUp: " << this->ViewUp[0] << " " << this->ViewUp[1] << " " << this->ViewUp[2]
     << "\n";
  os << indent << "HasFocalPoint: " << this->HasFocalPoint << "\n";
  os << indent << "FocalPoint: " << this->FocalPoint[0] << " " << this->FocalPoint[1] << " "
     << this->FocalPoint[2] << "\n";
  os << indent << "ParallelScale: " << this->ParallelScale << "\n";
  os << indent << "ImageSize: " << this->ImageSize[0] << " " << this->ImageSize[1] << "\n";
  os << indent << "Cutoff: " << this->Cutoff << "\n";
  os << indent << "KnifeEdgeAngle: " << this->KnifeEdgeAngle << "\n";
  os << indent << "CutoffOffset: " << this->CutoffOffset << "\n";
  os << indent << "InvertCutoff: " << this->InvertCutoff << "\n";
  os << indent << "AutoKScale: " << this->AutoKScale << "\n";
  os << indent << "LockK: " << this->LockK << "\n";
  os << indent << "LockedK: " << this->GetLockedK() << "\n";
  os << indent << "KScale: " << this->KScale << "\n";
  os << indent << "KFromOptics: " << this->KFromOptics << "\n";
  os << indent << "FocalLength: " << this->FocalLength << "\n";
  os << indent << "SourceWidth: " << this->SourceWidth << "\n";
  os << indent << "SourceLength: " << this->SourceLength << "\n";
  os << indent << "CutoffPosition: " << this->CutoffPosition << "\n";
  os << indent << "KScaleUsed: " << this->KScaleUsed << "\n";
  os << indent << "Sensitivity: " << this->Sensitivity << "\n";
  os << indent << "GradedFilter: " << this->GradedFilter << "\n";
  os << indent << "ColorFilterImage: " << this->ColorFilterImage << "\n";
  os << indent << "FringeMode: " << this->FringeMode << "\n";
  os << indent << "FringeSpacing: " << this->FringeSpacing << "\n";
  os << indent << "FringeAngle: " << this->FringeAngle << "\n";
  os << indent << "BeamAngle: " << this->BeamAngle << "\n";
  os << indent << "WhiteLight: " << this->WhiteLight << "\n";
  os << indent << "ScreenDistance: " << this->ScreenDistance << "\n";
  os << indent << "FocusOffset: " << this->FocusOffset << "\n";
  os << indent << "LightSource: " << this->LightSource << "\n";
  os << indent << "SourceDistance: " << this->SourceDistance << "\n";
  os << indent << "SourceShape: " << this->SourceShape << "\n";
  os << indent << "BackgroundPattern: " << this->BackgroundPattern << "\n";
  os << indent << "BackgroundDistance: " << this->BackgroundDistance << "\n";
  os << indent << "BackgroundPeriod: " << this->BackgroundPeriod << "\n";
  os << indent << "BackgroundAngle: " << this->BackgroundAngle << "\n";
  os << indent << "BackgroundImage: " << this->BackgroundImage << "\n";
  os << indent << "ColorByField: " << this->ColorByField << "\n";
  os << indent << "FieldColors:";
  for (const double value : this->FieldColors)
  {
    os << " " << value;
  }
  os << "\n";
  os << indent << "Quality: " << this->GetQuality() << "\n";
  for (const QualitySetting& setting : qualitySettings)
  {
    os << indent << setting.Property << ": " << setting.Get(this) << "\n";
  }
  os << indent << "ExposureTime: " << this->ExposureTime << "\n";
  os << indent << "ExposureSamples: " << this->ExposureSamples << "\n";
  os << indent << "NoiseFilter: " << this->NoiseFilter << "\n";
  os << indent << "NoiseFilterRadius: " << this->NoiseFilterRadius << "\n";
  os << indent << "HistogramSize: " << this->HistogramSize << "\n";
  os << indent << "MemoryBudget: " << this->MemoryBudget << "\n";
  os << indent << "MediumMemory: " << this->MediumMemory << "\n";
  os << indent << "Seed: " << this->Seed << "\n";
  os << indent << "Device: " << this->Device << "\n";
  os << indent << "NumberOfThreads: " << this->NumberOfThreads << "\n";
  os << indent << "PreviewReduction: " << this->PreviewReduction << "\n";
  os << indent << "TimeLimit: " << this->TimeLimit << "\n";
  os << indent << "Finished: " << this->GetFinished() << "\n";
  os << indent << "PictureCount: " << this->PictureCount << "\n";
  os << indent << "Status: " << this->Status << "\n";
  os << indent << "FollowedView: " << this->FollowedView << "\n";
  os << indent << "Grid: " << this->GetGrid() << "\n";
  os << indent << "MediumBuilds: " << this->GetMediumBuilds() << "\n";
  os << indent << "TotalRaysTraced: " << this->GetTotalRaysTraced() << "\n";
}

//------------------------------------------------------------------------------
void vtkSchlierenFilter::SetFocalPoint(double x, double y, double z)
{
  const double point[3] = { x, y, z };
  if (!this->HasFocalPoint || !std::equal(point, point + 3, this->FocalPoint))
  {
    std::copy(point, point + 3, this->FocalPoint);
    this->HasFocalPoint = true;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
void vtkSchlierenFilter::ClearFocalPoint()
{
  if (this->HasFocalPoint)
  {
    std::fill_n(this->FocalPoint, 3, 0.);
    this->HasFocalPoint = false;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
void vtkSchlierenFilter::AddFieldColor(double value)
{
  this->FieldColors.push_back(value);
  this->Modified();
}

//------------------------------------------------------------------------------
void vtkSchlierenFilter::ClearFieldColors()
{
  this->FieldColors.clear();
  this->Modified();
}

//------------------------------------------------------------------------------
void vtkSchlierenFilter::SetGradedFilter(vtkPiecewiseFunction* function)
{
  if (this->GradedFilter != function)
  {
    this->GradedFilter = function;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
vtkPiecewiseFunction* vtkSchlierenFilter::GetGradedFilter() const { return this->GradedFilter; }

//------------------------------------------------------------------------------
double vtkSchlierenFilter::GetKScaleOfOptics()
{
  return this->FocalLength > 0 && this->SourceWidth > 0
    ? this->FocalLength / (metresPerMillimetre * this->SourceWidth)
    : std::numeric_limits<double>::quiet_NaN();
}

//------------------------------------------------------------------------------
double vtkSchlierenFilter::GetCutoffOffsetOfOptics()
{
  return this->SourceWidth > 0 ? this->CutoffPosition / this->SourceWidth
                               : std::numeric_limits<double>::quiet_NaN();
}

//------------------------------------------------------------------------------
double vtkSchlierenFilter::GetGladstoneDaleConstantUsed()
{
  this->PassToMedium();
  return this->Medium->GetGladstoneDaleConstantUsed();
}

//------------------------------------------------------------------------------
void vtkSchlierenFilter::SetQuality(int quality)
{
  if (quality < INTERACTIVE || quality >= CUSTOM)
  {
    return;
  }
  for (const QualitySetting& setting : qualitySettings)
  {
    setting.Set(this, setting.Values[static_cast<std::size_t>(quality)]);
  }
}

//------------------------------------------------------------------------------
int vtkSchlierenFilter::GetQuality()
{
  int quality = INTERACTIVE;
  while (quality < CUSTOM &&
    !std::all_of(qualitySettings.begin(), qualitySettings.end(),
      [&](const QualitySetting& setting)
      { return setting.Get(this) == setting.Values[static_cast<std::size_t>(quality)]; }))
  {
    ++quality;
  }
  return quality;
}

//------------------------------------------------------------------------------
const char* vtkSchlierenFilter::GetQualitySetting(int number)
{
  const auto index = static_cast<std::size_t>(number);
  return index < qualitySettings.size() ? qualitySettings[index].Property : nullptr;
}

//------------------------------------------------------------------------------
double vtkSchlierenFilter::GetQualityValue(int quality, int number)
{
  const auto index = static_cast<std::size_t>(number);
  return quality >= INTERACTIVE && quality < CUSTOM && index < qualitySettings.size()
    ? qualitySettings[index].Values[static_cast<std::size_t>(quality)]
    : 0;
}

//------------------------------------------------------------------------------
void vtkSchlierenFilter::SetPrecision(int precision)
{
  precision = std::clamp<int>(precision, SINGLE, DOUBLE);
  if (this->Precision != precision)
  {
    this->Precision = precision;
    this->Inside->TimeBeforePrecision = this->Inside->settingsTimeOf(this->Medium);
    this->Medium->SetDoublePrecision(precision == DOUBLE);
    this->Inside->PrecisionTime = this->Medium->GetMTime();
    this->Modified();
  }
}

//------------------------------------------------------------------------------
const char* vtkSchlierenFilter::GetGrid() const
{
  return this->Inside->Source ? this->Inside->Grid.c_str() : this->Medium->GetGrid();
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkSchlierenFilter::GetMediumBuilds()
{
  return this->Inside->Pictures.GetBench().work().mediumBuilds;
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkSchlierenFilter::GetTotalRaysTraced()
{
  return this->Inside->Pictures.GetBench().work().raysTraced;
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkSchlierenFilter::GetMeshSearches() { return this->Medium->GetMeshSearches(); }

//------------------------------------------------------------------------------
vtkTypeInt64 vtkSchlierenFilter::GetMeshBuilds() { return this->Medium->GetMeshBuilds(); }

//------------------------------------------------------------------------------
vtkTypeInt64 vtkSchlierenFilter::GetGridPlans() { return this->Medium->GetGridPlans(); }

//------------------------------------------------------------------------------
void vtkSchlierenFilter::Refine()
{
  Internals& inside = *this->Inside;
  FilterRanks::Meeting meeting(inside.Ranks, std::nullopt);
  bool hasMore = false;
  if (isRank0())
  {
    const Internals::WithWorkers withWorkers(inside, meeting);
    hasMore = this->RefineOnRank0();
    meeting.SetOutcome(hasMore);
  }
  else
  {
    hasMore = meeting.Serve(threadsFrom(this));
  }
  if (hasMore)
  {
    inside.RefineTime.Modified();
    this->InvokeEvent(vtkCommand::ModifiedEvent);
  }
}

//------------------------------------------------------------------------------
bool vtkSchlierenFilter::RefineOnRank0()
{
  Internals& inside = *this->Inside;
  if (this->GetStopped())
  {
    const vtkMTimeType stopped = std::exchange(inside.StoppedOf, 0);
    if (inside.FailedAt == stopped) // there is nothing to go on with
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

//------------------------------------------------------------------------------
void vtkSchlierenFilter::Stop()
{
  Internals& inside = *this->Inside;
  if (inside.UnfinishedOf != 0 && inside.UnfinishedOf == this->GetTimeOfPicture())
  {
    inside.StoppedOf = std::exchange(inside.UnfinishedOf, 0);
  }
}

//------------------------------------------------------------------------------
bool vtkSchlierenFilter::GetStopped()
{
  return this->Inside->StoppedOf != 0 && this->Inside->StoppedOf == this->GetTimeOfPicture();
}

//------------------------------------------------------------------------------
int vtkSchlierenFilter::GetPercentDone()
{
  const int percent = static_cast<int>(100 * this->Inside->Done);
  return this->GetFinished() && !this->GetStopped() ? 100 : std::min(percent, 99);
}

//------------------------------------------------------------------------------
bool vtkSchlierenFilter::WorkOn()
{
  Internals& inside = *this->Inside;
  this->PassToMedium();
  const vtkMTimeType now = this->GetTimeOfPicture();
  const bool goesOn = inside.UnfinishedOf == now;
  if (goesOn && inside.Ready)
  {
    return true;
  }
  if (goesOn || this->CanBegin(now))
  {
    try
    {
      schlieren::Monitor monitor;
      monitor.progress = [&inside](double done) { inside.Done = done; };
      schlieren::Image image = goesOn ? inside.Pictures.GoOn(this->TimeLimit, monitor)
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
    catch (const std::exception&) // an update begins again, and says it
    {
      inside.Pictures.GiveUp();
      inside.UnfinishedOf = 0;
      return true;
    }
  }
  return std::exchange(inside.UnfinishedOf, 0) != 0; // then there will be another picture
}

//------------------------------------------------------------------------------
bool vtkSchlierenFilter::CanBegin(vtkMTimeType now)
{
  Internals& inside = *this->Inside;
  return !(this->ExposureTime > 0) && inside.ShownOf != 0 && inside.ShownOf != now &&
    inside.FailedAt != now && inside.Shown[PICTURE_PORT].IsThere() &&
    (!this->ColorByField || inside.Source || !inside.FieldGradients.empty()) &&
    inside.holdsRefractivityOf(
      describeInputs(this, inside.Ranks.GetInput(0, this->GetInputDataObject(0, 0)),
        inside.Ranks.GetInput(
          vtkRefractiveIndex::BODIES, this->GetInputDataObject(vtkRefractiveIndex::BODIES, 0))),
      this->Medium, this->ColorByField);
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkSchlierenFilter::GetPictureCount() const
{
  return this->PictureCount + (this->Inside->Ready ? 1 : 0);
}

//------------------------------------------------------------------------------
bool vtkSchlierenFilter::GetFinished() { return this->Inside->UnfinishedOf == 0; }

//------------------------------------------------------------------------------
vtkMTimeType vtkSchlierenFilter::GetMTime()
{
  return std::max(this->GetTimeOfProperties(), this->Inside->RefineTime.GetMTime());
}

//------------------------------------------------------------------------------
vtkMTimeType vtkSchlierenFilter::GetTimeOfProperties()
{
  vtkMTimeType time = std::max(this->Superclass::GetMTime(), this->Medium->GetMTime());
  return this->GradedFilter ? std::max(time, this->GradedFilter->GetMTime()) : time;
}

//------------------------------------------------------------------------------
vtkMTimeType vtkSchlierenFilter::GetTimeOfPicture()
{
  return std::max({ this->GetTimeOfProperties(), upstreamTime(this, 0),
    upstreamTime(this, vtkRefractiveIndex::BODIES) });
}

//------------------------------------------------------------------------------
vtkTypeBool vtkSchlierenFilter::ProcessRequest(
  vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output)
{
  if (request->Has(vtkDemandDrivenPipeline::REQUEST_DATA_OBJECT()))
  {
    this->Inside->Ranks.CountChanges(this);
  }
  return this->Superclass::ProcessRequest(request, input, output);
}

//------------------------------------------------------------------------------
int vtkSchlierenFilter::FillInputPortInformation(int port, vtkInformation* info)
{
  // Of bodies, too, so that Convert can say what is wrong with other types than vtkPolyData.
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkDataSet");
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkCompositeDataSet");
  if (port == vtkRefractiveIndex::BODIES)
  {
    info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  }
  return 1;
}

//------------------------------------------------------------------------------
void vtkSchlierenFilter::PassToMedium()
{
  // Otherwise another wavelength would make the same refractivity once more.
  if (refractivity::usesWavelength(this->Medium))
  {
    this->Medium->SetWavelength(this->Wavelength);
  }
  for (int index = vtkRefractiveIndex::DENSITY; index <= vtkRefractiveIndex::MASK; ++index)
  {
    vtkInformation* selection = this->GetInputArrayInformation(index);
    if (!sameSelection(selection, this->Medium->GetInputArrayInformation(index)))
    {
      this->Medium->SetInputArrayToProcess(index, selection);
    }
  }
}

//------------------------------------------------------------------------------
void vtkSchlierenFilter::OnMediumProgress()
{
  this->Progress(mediumShare * this->Medium->GetProgress());
  if (this->GetAbortExecute())
  {
    this->Medium->AbortExecuteOn();
  }
}

//------------------------------------------------------------------------------
void vtkSchlierenFilter::Progress(double fraction)
{
  const Internals& inside = *this->Inside;
  const auto instants =
    static_cast<double>(std::max<std::size_t>(1, inside.Exposure.Instants.size()));
  this->UpdateProgress((static_cast<double>(inside.Instant) + fraction) / instants);
}

//------------------------------------------------------------------------------
bool vtkSchlierenFilter::UpdateRefractivity(vtkDataObject* input, vtkDataObject* bodies)
{
  Internals& inside = *this->Inside;
  this->PassToMedium();
  std::vector<double> description = describeInputs(this, input, bodies);
  if (inside.holdsRefractivityOf(description, this->Medium, this->ColorByField))
  {
    return true;
  }
  inside.MediumTime = 0;
  inside.FieldGradients.clear();
  this->Medium->AbortExecuteOff();
  this->Medium->SetNumberOfThreads(this->NumberOfThreads);
  inside.Source.reset();
  inside.Grid.clear();
  inside.Refractivity->Initialize();
  std::string warning;
  if (this->Medium->CanMakeSource(input))
  {
    inside.Source = this->Medium->MakeSource(input, bodies, warning,
      this->ColorByField ? vtkRefractiveIndex::WITH_FIELDS
                         : vtkRefractiveIndex::REFRACTIVITY_ALONE);
    inside.SourceTime.Modified();
  }
  if (!inside.Source && !this->Medium->GetAbortExecute())
  {
    if (this->ColorByField)
    {
      this->Medium->KeepMeshSearch(); // for UpdateFieldGradients
    }
    warning = this->Medium->Convert(input, inside.Refractivity, bodies);
  }
  if (this->Medium->GetAbortExecute())
  {
    return false;
  }
  if (!warning.empty())
  {
    vtkWarningMacro(<< warning);
  }
  if (!inside.Source)
  {
    mergeMasks(inside.Refractivity);
  }
  inside.Input = std::move(description);
  inside.MediumTime = this->Medium->GetMTime();
  return true;
}

//------------------------------------------------------------------------------
void vtkSchlierenFilter::UpdateFieldGradients(vtkDataObject* input)
{
  Internals& inside = *this->Inside;
  if (!this->ColorByField || inside.Source)
  {
    inside.FieldGradients = std::vector<float>();
  }
  else if (inside.FieldGradients.empty())
  {
    inside.FieldGradients =
      fieldGradients(this->Medium, input, inside.Refractivity, threadsFrom(this));
  }
}

//------------------------------------------------------------------------------
bool vtkSchlierenFilter::GoesOn(vtkDataObject* input, vtkDataObject* bodies)
{
  Internals& inside = *this->Inside;
  return !this->GetFinished() && inside.UnfinishedOf == this->GetTimeOfPicture() &&
    inside.holdsRefractivityOf(
      describeInputs(this, input, bodies), this->Medium, this->ColorByField);
}

//------------------------------------------------------------------------------
bool vtkSchlierenFilter::Render(vtkImageData* output, vtkImageData* histogram, bool goesOn)
{
  Internals& inside = *this->Inside;
  schlieren::Monitor monitor;
  monitor.aborted = [this]() { return this->GetAbortExecute() != 0; };
  monitor.progress = [this](double fraction)
  {
    this->Inside->Done = fraction;
    if (!(this->TimeLimit > 0)) // else it would flicker
    {
      this->Progress(mediumShare + (1 - mediumShare) * fraction);
    }
  };
  std::optional<schlieren::Image> ready = std::exchange(inside.Ready, std::nullopt);
  if (goesOn && ready && (this->TimeLimit > 0 || ready->finished))
  {
    return this->Show(std::move(*ready), output, histogram);
  }
  ready.reset();
  if (goesOn)
  {
    return this->Show(inside.Pictures.GoOn(this->TimeLimit, monitor), output, histogram);
  }

  const LastPicture& shown = inside.Shown[PICTURE_PORT];
  const bool isColored = this->ColorByField || seesColor(this);
  if (this->TimeLimit > 0 && (!shown.IsThere() || (isColored && !shown.HasColor())))
  {
    // Something to show if time is over before the first sample of each pixel is there.
    if (!this->Show(this->Begin(true, 0, monitor), output, histogram))
    {
      return false;
    }
  }
  return this->Show(this->Begin(false, this->TimeLimit, monitor), output, histogram);
}

//------------------------------------------------------------------------------
void vtkSchlierenFilter::SetLockedK(double k)
{
  if (k != this->GetLockedK())
  {
    this->Inside->KLock.Give(k > 0 ? std::make_optional(k) : std::nullopt);
    this->Modified();
  }
}

//------------------------------------------------------------------------------
double vtkSchlierenFilter::GetLockedK() const { return this->Inside->KLock.GetKept().value_or(0); }

//------------------------------------------------------------------------------
void vtkSchlierenFilter::SetLockedAmbient(double ambient)
{
  if (ambient != this->GetLockedAmbient())
  {
    this->Inside->AmbientLock.Give(ambient != 0 ? std::make_optional(ambient) : std::nullopt);
    this->Modified();
  }
}

//------------------------------------------------------------------------------
double vtkSchlierenFilter::GetLockedAmbient() const
{
  return this->Inside->AmbientLock.GetKept().value_or(0);
}

//------------------------------------------------------------------------------
ImageCircumstances vtkSchlierenFilter::CircumstancesOf(
  std::vector<double> medium, std::vector<double> rays)
{
  const Internals& inside = *this->Inside;
  medium.push_back(static_cast<double>(inside.settingsTimeOf(this->Medium)));
  return { inside.Time,
    { static_cast<double>(upstreamTime(this, 0)),
      static_cast<double>(upstreamTime(this, vtkRefractiveIndex::BODIES)) },
    inside.Exposure.IsNone() ? std::make_optional(inside.Input) : std::nullopt, std::move(medium),
    std::move(rays) };
}

//------------------------------------------------------------------------------
std::optional<double> vtkSchlierenFilter::KeptK()
{
  if (!choosesK(this))
  {
    return {}; // what is kept waits: the change may be undone
  }
  return this->Inside->KLock.For(this->LockK,
    this->CircumstancesOf(
      { static_cast<double>(this->Cutoff), static_cast<double>(this->AutoAmbientRefractivity),
        this->AutoAmbientRefractivity ? 0 : this->AmbientRefractivity },
      settingsOfRays(this)));
}

//------------------------------------------------------------------------------
std::optional<double> vtkSchlierenFilter::KeptAmbient()
{
  this->Inside->AmbientLock.For(
    this->LockAmbient ? LOCK_OVER_TIME : LOCK_OFF, this->CircumstancesOf({}, {}));
  // Given at the time that it was found, it would make another medium of the same data.
  return this->Inside->AmbientLock.GetKept();
}

//------------------------------------------------------------------------------
schlieren::Image vtkSchlierenFilter::Begin(
  bool isHurried, double seconds, const schlieren::Monitor& monitor)
{
  Internals& inside = *this->Inside;
  inside.Done = 0;
  schlieren::Field field = inside.field();
  field.ambient = !this->AutoAmbientRefractivity ? this->AmbientRefractivity
    : inside.FirstInstant                        ? inside.FirstInstant->ambient
                                                 : this->KeptAmbient();
  inside.FindsAmbient = !field.ambient;
  field.lengthScale = this->LengthScale;
  schlieren::Scene scene = sceneFrom(this, this->Medium, field.grid, inside.RgbPictures);
  if (inside.FirstInstant && choosesK(this))
  {
    scene.kScale = inside.FirstInstant->kScale;
  }
  else if (const std::optional<double> k = this->KeptK())
  {
    scene.kScale = k;
  }
  if (this->ColorByField)
  {
    const std::size_t fields = this->Medium->GetFields().size();
    scene.fieldColors = fieldColors(this->FieldColors, fields);
    field.gradients = { static_cast<int>(fields),
      inside.Source ? nullptr : inside.FieldGradients.data(), field.version };
  }
  if (isHurried)
  {
    hurry(scene, schlieren::frameOf(field.grid, scene.view), reductionAtFirst(scene.view));
  }
  return inside.Pictures.Begin(field, scene, seconds, monitor);
}

//------------------------------------------------------------------------------
bool vtkSchlierenFilter::Expose(ExposureSteps& steps, vtkImageData* output, vtkImageData* histogram)
{
  Internals& inside = *this->Inside;
  schlieren::Monitor monitor;
  monitor.aborted = [this]() { return this->GetAbortExecute() != 0; };
  monitor.progress = [this](double fraction)
  { this->Progress(mediumShare + (1 - mediumShare) * fraction); };
  MeanImage mean;
  steps.Keep();
  for (const TimeExposure::Instant& instant : inside.Exposure.Instants)
  {
    while (steps.IsBefore(instant))
    {
      steps.GoOn();
      inside.Pictures.SetWorkers(steps.GetMeeting().GetWorkers());
      steps.Keep();
    }
    const auto input = steps.GetData(0, instant);
    const auto bodies = steps.GetData(vtkRefractiveIndex::BODIES, instant);
    if (!this->UpdateRefractivity(input, bodies))
    {
      return false;
    }
    this->UpdateFieldGradients(input);
    schlieren::Image image = this->Begin(false, 0, monitor);
    if (image.aborted)
    {
      return false;
    }
    if (!inside.FirstInstant)
    {
      inside.FirstInstant.emplace();
      inside.FirstInstant->frame = image.frame;
      inside.FirstInstant->ambient = image.ambient;
      inside.FirstInstant->kScale = image.kScale;
      this->KeepFound(image);
    }
    else if (!liesAt(image.frame, inside.FirstInstant->frame))
    {
      throw std::runtime_error("The box of the data changes within ExposureTime, and with it what "
                               "the image shows. Set FocalPoint and ParallelScale.");
    }
    mean.Add(std::move(image));
    ++inside.Instant;
  }
  inside.MediumTime = 0; // the refractivity is that of no input
  return this->Show(mean.Take(), output, histogram);
}

//------------------------------------------------------------------------------
void vtkSchlierenFilter::KeepFound(const schlieren::Image& image)
{
  Internals& inside = *this->Inside;
  if (!inside.Pictures.GetScene().kScale && image.kScale > 0)
  {
    inside.KLock.Found(image.kScale);
  }
  if (inside.FindsAmbient)
  {
    inside.AmbientLock.Found(image.ambient);
  }
}

//------------------------------------------------------------------------------
bool vtkSchlierenFilter::Show(
  schlieren::Image&& image, vtkImageData* output, vtkImageData* histogram)
{
  Internals& inside = *this->Inside;
  inside.UnfinishedOf = image.finished || image.aborted ? 0 : this->GetTimeOfPicture();
  if (image.aborted)
  {
    return false;
  }
  inside.ShownOf = this->GetTimeOfPicture();
  if (image.intensity.empty()) // no more samples than before
  {
    return true;
  }
  const schlieren::Scene& scene = inside.Pictures.GetScene();
  const bool isWhole = image.width == this->ImageSize[0] && image.height == this->ImageSize[1];
  if (isWhole) // of a hurried one the whole picture will say it
  {
    for (const std::string& warning : inside.Pictures.GetWarnings(image))
    {
      vtkWarningMacro(<< warning);
    }
  }
  if (isWhole)
  {
    this->KeepFound(image);
  }
  const bool isKept = choosesK(this) && this->GetLockedK() > 0;
  dropIdleBounds(image);
  this->Status = (isWhole ? "" : "Preview: ") + inside.Pictures.GetStatus(image) +
    (inside.Exposure.IsNone() ? "" : ", " + inside.Exposure.GetWords()) +
    (isKept ? ", " + kInWords(image.kScale, isKept) : "");
  this->KScaleUsed = image.kScale;
  this->Sensitivity = sensitivityInWords(this, image.kScale, isKept);
  ++this->PictureCount;
  output->Initialize();
  histogram->Initialize();
  setOutput(output, image);
  if (!image.color.empty())
  {
    addColor(output, image, colorScaleFrom(this));
  }
  if (scene.cutoff == schlieren::Cutoff::Interferogram && scene.fringes.finite)
  {
    addFringeSpacing(output, scene.fringes.spacing);
  }
  if (!inside.Exposure.IsNone())
  {
    addExposure(output, inside.Exposure.Begin, inside.Exposure.End);
  }
  if (inside.Source)
  {
    inside.Grid = mediumInWords(image.medium);
    inside.Grid += inside.Source->fields() > 0 ? " or of the full colour" : "";
    addMedium(output, image.medium);
  }
  addGrid(output, this->GetGrid(), inside.Refractivity);
  setHistogram(histogram, image.histogram);
  inside.Shown[PICTURE_PORT].Keep(output);
  inside.Shown[HISTOGRAM_PORT].Keep(histogram);
  return true;
}

//------------------------------------------------------------------------------
int vtkSchlierenFilter::RequestInformation(vtkInformation* vtkNotUsed(request),
  vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkInformation* outInfo = outputVector->GetInformationObject(0);
  const int extent[6] = { 0, hurriedPixels(this->ImageSize[0], this->PreviewReduction) - 1, 0,
    hurriedPixels(this->ImageSize[1], this->PreviewReduction) - 1, 0, 0 };
  double origin[3] = { 0, 0, 0 };
  double spacing[3] = { 1, 1, 1 };
  try
  {
    // Where the picture lies depends on the input's points: RequestData corrects what is told here
    // before the input has been produced.
    const FilterRanks& ranks = this->Inside->Ranks;
    if (vtkDataObject* input = ranks.GetInput(0, vtkDataObject::GetData(inputVector[0])))
    {
      this->PassToMedium();
      schlieren::Grid grid;
      vtkDataObject* bodies = ranks.GetInput(vtkRefractiveIndex::BODIES,
        vtkDataObject::GetData(inputVector[vtkRefractiveIndex::BODIES]));
      if (this->Inside->holdsRefractivityOf(
            describeInputs(this, input, bodies), this->Medium, this->ColorByField))
      {
        grid = this->Inside->field().grid;
      }
      else
      {
        vtkNew<vtkImageData> planned;
        if (this->Medium->CanMakeSource(input))
        {
          this->Medium->ComputeBox(input, planned);
        }
        else
        {
          this->Medium->ComputeGrid(input, planned);
        }
        grid = gridFrom(planned);
      }
      const schlieren::Frame frame = frameFrom(this, grid);
      std::copy(frame.origin.begin(), frame.origin.end(), origin);
      std::fill_n(spacing, 3, frame.pixelSize);
    }
  }
  catch (const std::exception&) // RequestData will say it
  {
  }
  outInfo->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), extent, 6);
  outInfo->Set(vtkDataObject::ORIGIN(), origin, 3);
  outInfo->Set(vtkDataObject::SPACING(), spacing, 3);
  outInfo->Set(vtkDataObject::DIRECTION(), unturned, 9);
  const bool isColored = this->ColorByField || seesColor(this);
  vtkDataObject::SetActiveAttribute(outInfo, vtkDataObject::FIELD_ASSOCIATION_POINTS,
    isColored ? "Color" : "Intensity", vtkDataSetAttributes::SCALARS);
  vtkDataObject::SetPointDataActiveScalarInfo(
    outInfo, isColored ? VTK_UNSIGNED_CHAR : VTK_FLOAT, isColored ? 3 : 1);

  // What the histogram covers depends on the light: RequestData says it.
  vtkInformation* histogramInfo = outputVector->GetInformationObject(HISTOGRAM_PORT);
  const int bins[6] = { 0, this->HistogramSize - 1, 0, this->HistogramSize - 1, 0,
    std::min(this->HistogramSize, 1) - 1 };
  histogramInfo->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), bins, 6);
  histogramInfo->Set(vtkDataObject::DIRECTION(), unturned, 9);
  vtkDataObject::SetActiveAttribute(
    histogramInfo, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Rays", vtkDataSetAttributes::SCALARS);
  vtkDataObject::SetPointDataActiveScalarInfo(histogramInfo, VTK_TYPE_INT64, 1);
  return 1;
}

//------------------------------------------------------------------------------
int vtkSchlierenFilter::RequestUpdateExtent(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  Internals& inside = *this->Inside;
  // A preview is there to be quick.
  const double length = this->PreviewReduction > 1 ? 0 : this->ExposureTime;
  inside.Exposure = exposureFor(inputVector[0]->GetInformationObject(0),
    outputVector->GetInformationObject(std::max(0, request->Get(Pipeline::FROM_OUTPUT_PORT()))),
    length, this->ExposureSamples);
  if (!inside.Exposure.IsNone())
  {
    requestTime(this, inputVector, inside.Exposure.Steps.front());
  }
  if (this->Inside->Ranks.Request(this, inputVector))
  {
    this->Inside->FailedAt = this->Inside->StoppedOf = 0; // of another time step, perhaps
  }
  return 1;
}

//------------------------------------------------------------------------------
int vtkSchlierenFilter::RequestData(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  Internals& inside = *this->Inside;
  vtkImageData* output = vtkImageData::GetData(outputVector, PICTURE_PORT);
  vtkImageData* histogram = vtkImageData::GetData(outputVector, HISTOGRAM_PORT);
  output->Initialize();
  histogram->Initialize();
  setComplete(outputVector);

  this->PassToMedium();
  ExposureSteps steps(this, inside.Ranks, inputVector, outputVector, inside.Exposure);
  const bool isExposure = !inside.Exposure.IsNone();
  inside.Instant = 0;
  inside.FirstInstant.reset();
  // An empty output lets the pipeline ask again and again, on rank 0 alone: one message is enough.
  const vtkMTimeType now = this->GetTimeOfPicture();
  if (inside.FailedAt == now)
  {
    return 1;
  }
  steps.Meet(refractivity::arraysOf(this->Medium));
  if (!isRank0())
  {
    do
    {
      steps.GetMeeting().Serve(threadsFrom(this));
    } while (steps.GoOn());
    return 1;
  }
  const Internals::WithWorkers withWorkers(inside, steps.GetMeeting());

  const auto showLast = [&]()
  {
    for (int port = 0; port < this->GetNumberOfOutputPorts(); ++port)
    {
      inside.Shown[port].Show(vtkImageData::GetData(outputVector, port),
        outputVector->GetInformationObject(port)->Get(
          vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT()));
    }
    tellPlaces(outputVector);
  };
  if (this->GetStopped())
  {
    showLast();
    return 1;
  }

  // Data without time steps are the same at all times, and VTK need not run this for another one.
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  vtkInformation* inInfo = inputVector[0]->GetInformationObject(0);
  vtkInformation* outInfo =
    outputVector->GetInformationObject(std::max(0, request->Get(Pipeline::FROM_OUTPUT_PORT())));
  inside.Time.reset();
  if ((inInfo->Has(Pipeline::TIME_STEPS()) || inInfo->Has(Pipeline::TIME_RANGE())) &&
    outInfo->Has(Pipeline::UPDATE_TIME_STEP()))
  {
    inside.Time = outInfo->Get(Pipeline::UPDATE_TIME_STEP());
  }

  this->SetAbortExecute(0); // it stays set after an abort
  try
  {
    const FilterRanks::Inputs inputs = steps.GetMeeting().Gather();
    vtkDataObject* input = inputs.data;
    vtkDataObject* bodies = inputs.bodies;
    if (isAbortedUpstream(this, input))
    {
      this->ForgetPicture();
      this->Status = noIndexYet;
      return 1;
    }
    const bool goesOn = !isExposure && this->GoesOn(input, bodies);
    inside.UnfinishedOf = 0;
    if (!(this->TimeLimit > 0))
    {
      inside.DropShown(); // there will be a better picture, which wants the memory
    }
    bool isMade = goesOn || isExposure || this->UpdateRefractivity(input, bodies);
    if (isMade && !goesOn && !isExposure)
    {
      this->UpdateFieldGradients(input);
    }
    isMade = isMade &&
      (isExposure ? this->Expose(steps, output, histogram)
                  : this->Render(output, histogram, goesOn));
    if (isMade)
    {
      showLast();
      return 1;
    }
  }
  catch (const std::bad_alloc&)
  {
    inside.FailedAt = now;
    vtkErrorMacro(<< "There is not enough memory for the refractivity grid or the image. Use a "
                     "coarser input, smaller SamplingDimensions or a smaller ImageSize.");
  }
  catch (const std::exception& problem)
  {
    inside.FailedAt = now;
    vtkErrorMacro(<< problem.what());
  }
  const bool isStopped = this->TimeLimit > 0 && this->GetAbortExecute() && inside.FailedAt != now;
  this->ForgetPicture();
  output->Initialize();
  histogram->Initialize();
  if (isStopped)
  {
    inside.FailedAt = inside.StoppedOf = this->GetTimeOfPicture(); // later than `now` by the abort
    this->Status = isExposure ? "No image: the exposure was stopped" : noIndexYet;
  }
  return 1;
}

//------------------------------------------------------------------------------
void vtkSchlierenFilter::ForgetPicture()
{
  Internals& inside = *this->Inside;
  inside.UnfinishedOf = 0;
  inside.Pictures.GiveUp();
  inside.Ready.reset();
  inside.DropShown();
  this->KScaleUsed = 0;
  this->Sensitivity.clear();
  this->Status.clear();
}
