// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSchlierenFilter.h"

#include "Common/AtTheEnd.h"
#include "Common/Sentences.h"
#include "Common/Threads.h"
#include "Filter/SchlierenFilterInternals.h"
#include "Guarded.h"
#include "Image/Preview.h"
#include "Image/SceneFromSettings.h"
#include "Input/Flow.h"
#include "Input/InputDescription.h"

#include "vtkBoundingBox.h"
#include "vtkDataSet.h"
#include "vtkDataSetAttributes.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPiecewiseFunction.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <array>
#include <limits>
#include <stdexcept>
#include <utility>

using namespace filters;

vtkStandardNewMacro(vtkSchlierenFilter);

namespace
{

/// Whether an enumeration of the filter has the same values as one of the tracer.
template <class Core, class Enum>
constexpr bool sameValue(Enum value, Core ofCore)
{
  return static_cast<Core>(value) == ofCore;
}

using Self = vtkSchlierenFilter;
static_assert(sameValue(Self::STRAIGHT, schlieren::PathModel::Straight) &&
  sameValue(Self::REFRACTED, schlieren::PathModel::Refracted));
static_assert(sameValue(Self::SINGLE, schlieren::Precision::Single) &&
  sameValue(Self::DOUBLE, schlieren::Precision::Double));
static_assert(sameValue(Self::AUTO, schlieren::Device::Auto) &&
  sameValue(Self::CPU, schlieren::Device::Cpu) && sameValue(Self::CUDA, schlieren::Device::Cuda));
static_assert(sameValue(Self::KNIFE_EDGE, schlieren::Cutoff::KnifeEdge) &&
  sameValue(Self::SHADOWGRAPH, schlieren::Cutoff::Shadowgraph) &&
  sameValue(Self::BRIGHT_FIELD, schlieren::Cutoff::BrightField) &&
  sameValue(Self::DARK_FIELD, schlieren::Cutoff::DarkField) &&
  sameValue(Self::GRADED_FILTER, schlieren::Cutoff::GradedFilter) &&
  sameValue(Self::COLOR_FILTER, schlieren::Cutoff::ColorFilter) &&
  sameValue(Self::INTERFEROGRAM, schlieren::Cutoff::Interferogram) &&
  sameValue(Self::BACKGROUND_ORIENTED, schlieren::Cutoff::Background) &&
  sameValue(Self::NUMERICAL_SCHLIEREN, schlieren::Cutoff::NumericalSchlieren) &&
  sameValue(Self::PHASE_CONTRAST, schlieren::Cutoff::PhaseContrast));
static_assert(sameValue(Self::POINT, schlieren::SourceShape::Point) &&
  sameValue(Self::SLIT, schlieren::SourceShape::Slit) &&
  sameValue(Self::DISC, schlieren::SourceShape::Disc));
static_assert(sameValue(Self::LIGHT_RAYS, schlieren::LightModel::Rays) &&
  sameValue(Self::LIGHT_WAVES, schlieren::LightModel::Waves));
static_assert(sameValue(Self::DOTS, schlieren::PatternKind::Dots) &&
  sameValue(Self::STRIPES, schlieren::PatternKind::Stripes) &&
  sameValue(Self::PICTURE, schlieren::PatternKind::Image));
static_assert(sameValue(Self::EXIT_AUTO, schlieren::ExitInto::Auto) &&
  sameValue(Self::EXIT_SURROUNDINGS, schlieren::ExitInto::Surroundings) &&
  sameValue(Self::EXIT_AIR, schlieren::ExitInto::Air) &&
  sameValue(Self::EXIT_CUSTOM, schlieren::ExitInto::Custom));

/// The direction of both outputs, which since VTK 9.3 would else be the input's.
constexpr double unturned[9] = { 1, 0, 0, 0, 1, 0, 0, 0, 1 };

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

/// The time that is requested. Data without time steps are the same at all times, and VTK need not run a filter for another one.
std::optional<double> timeOf(
  vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  vtkInformation* inInfo = inputs[0]->GetInformationObject(0);
  vtkInformation* outInfo =
    outputs->GetInformationObject(std::max(0, request->Get(Pipeline::FROM_OUTPUT_PORT())));
  const bool hasTime = inInfo->Has(Pipeline::TIME_STEPS()) || inInfo->Has(Pipeline::TIME_RANGE());
  if (!hasTime || !outInfo->Has(Pipeline::UPDATE_TIME_STEP()))
  {
    return {};
  }
  return outInfo->Get(Pipeline::UPDATE_TIME_STEP());
}

const char* const noMemory =
  "There is not enough memory for the refractivity or the image. Use a coarser input or a smaller "
  "ImageSize.";

const char* const noIndexYet = "No image: the refractive index is not known yet";

/// Gives the executive the extents of the outputs.
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

std::array<int, 2> vtkSchlierenFilter::SizeFor(vtkInformationVector* input) const
{
  const int* side = this->ImageSize;
  vtkBoundingBox bounds;
  if ((side[0] == 0 || side[1] == 0) && !hasOtherRanks())
  {
    for (vtkDataObject* leaf : leavesOf(vtkDataObject::GetData(input)))
    {
      auto* data = vtkDataSet::SafeDownCast(leaf);
      if (data && data->GetNumberOfPoints() > 0)
      {
        bounds.AddBounds(data->GetBounds());
      }
    }
  }
  if (bounds.IsValid())
  {
    schlieren::Grid grid;
    grid.dimensions = { 2, 2, 2 };
    bounds.GetMinPoint(grid.origin.data());
    bounds.GetLengths(grid.spacing.data());
    const auto* flat = std::find(grid.spacing.begin(), grid.spacing.end(), 0.);
    return imageSizeFrom(facing(*this, static_cast<int>(flat - grid.spacing.begin())), grid);
  }
  constexpr int usual = 512;
  return { side[0] != 0 ? side[0] : usual, side[1] != 0 ? side[1] : usual };
}

SchlierenSettings vtkSchlierenFilter::SettingsFor(int flatAxis) const
{
  SchlierenSettings settings = facing(*this, flatAxis);
  int(&size)[2] = settings.ImageSize;
  if (size[0] == 0 || size[1] == 0)
  {
    std::copy(this->Inside->Size.begin(), this->Inside->Size.end(), size);
  }
  return settings;
}

vtkSchlierenFilter::vtkSchlierenFilter()
  : Inside(new Internals)
{
  this->SetNumberOfInputPorts(2);
  this->SetNumberOfOutputPorts(2);
}

vtkSchlierenFilter::~vtkSchlierenFilter() = default;

double vtkSchlierenFilter::MostGathered()
{
  return this->GetMaker().canUsePieces() ? this->GatherLimit
                                         : std::numeric_limits<double>::infinity();
}

vtkMTimeType vtkSchlierenFilter::GetMTime()
{
  return std::max(this->GetTimeOfProperties(), this->Inside->RefineTime.GetMTime());
}

vtkMTimeType vtkSchlierenFilter::GetTimeOfProperties()
{
  vtkMTimeType time = this->Superclass::GetMTime();
  return this->GradedFilter ? std::max(time, this->GradedFilter->GetMTime()) : time;
}

vtkMTimeType vtkSchlierenFilter::GetTimeOfImage()
{
  return std::max(this->GetTimeOfProperties(), upstreamTime(this));
}

vtkTypeBool vtkSchlierenFilter::ProcessRequest(
  vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output)
{
  int result = 1;
  const auto work = [&] { result = this->Superclass::ProcessRequest(request, input, output); };
  const auto fail = [&](const std::string& problem)
  {
    // The requests before it state what is known as yet: it does not need them, and so a rank on
    // which they have failed reaches its collectives.
    if (request->Has(vtkDemandDrivenPipeline::REQUEST_DATA()))
    {
      this->Fail(problem, this->GetTimeOfImage(), output);
    }
  };
  guarded(work, noMemory, fail);
  return result;
}

void vtkSchlierenFilter::LackInput() { this->Inside->Ranks.lackInput(); }

int vtkSchlierenFilter::FillOutputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), "vtkImageData");
  return 1;
}

vtkImageData* vtkSchlierenFilter::GetOutput(int port)
{
  return vtkImageData::SafeDownCast(this->GetOutputDataObject(port));
}

MediumMaker& vtkSchlierenFilter::GetMaker()
{
  MediumMaker& maker = this->Superclass::GetMaker();
  maker.numberOfThreads = this->NumberOfThreads;
  maker.settings.Depth = this->Depth > 0 ? this->Depth : this->Inside->KeptDepth;
  return maker;
}

bool vtkSchlierenFilter::ReportMedium(double done)
{
  this->SetProgressText("computing the refractive index"); // ParaView's bar says it
  this->UpdateProgress(mediumFraction * done);
  return !this->GetAbortExecute();
}

int vtkSchlierenFilter::RequestInformation(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputVector)
{
  vtkInformation* outInfo = outputVector->GetInformationObject(0);
  std::array<int, 2>& size = this->Inside->Size;
  size = { 1, 1 }; // of a view that cannot be
  guarded([&] { size = this->SizeFor(inputs[0]); }, noMemory, [](const std::string&) {});
  double origin[3] = { 0, 0, 0 };
  double spacing[3] = { 1, 1, 1 };
  // Where the image lies depends on the input's points: RequestData corrects what is stated here
  // of the last ones. Whether these have an image is no matter of the next one.
  const auto tellPlaceInLast = [&]
  {
    const MadeRefractivity& last = *this->Inside->Refractivity;
    if (last.IsThere())
    {
      const schlieren::Frame frame =
        frameFrom(this->SettingsFor(last.FlatAxis), Internals::fieldOf(last).grid);
      std::copy(frame.origin.begin(), frame.origin.end(), origin);
      std::fill_n(spacing, 3, frame.pixelSize);
    }
  };
  guarded(tellPlaceInLast, noMemory, [](const std::string&) {});
  const int extent[6] = { 0, previewPixels(size[0], this->PreviewReduction) - 1, 0,
    previewPixels(size[1], this->PreviewReduction) - 1, 0, 0 };
  outInfo->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), extent, 6);
  outInfo->Set(vtkDataObject::ORIGIN(), origin, 3);
  outInfo->Set(vtkDataObject::SPACING(), spacing, 3);
  outInfo->Set(vtkDataObject::DIRECTION(), unturned, 9);
  const bool isColored = this->HasOwnColor();
  vtkDataObject::SetActiveAttribute(outInfo, vtkDataObject::FIELD_ASSOCIATION_POINTS,
    isColored ? "Color" : "Intensity", vtkDataSetAttributes::SCALARS);
  vtkDataObject::SetPointDataActiveScalarInfo(
    outInfo, isColored ? VTK_UNSIGNED_CHAR : VTK_FLOAT, isColored ? 3 : 1);

  // What the histogram covers depends on the light: RequestData says it.
  vtkInformation* histogramInfo = outputVector->GetInformationObject(HISTOGRAM_PORT);
  const int bins[6] = { 0, histogramBins - 1, 0, histogramBins - 1, 0, 0 };
  histogramInfo->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), bins, 6);
  histogramInfo->Set(vtkDataObject::DIRECTION(), unturned, 9);
  vtkDataObject::SetActiveAttribute(
    histogramInfo, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Rays", vtkDataSetAttributes::SCALARS);
  vtkDataObject::SetPointDataActiveScalarInfo(histogramInfo, VTK_TYPE_INT64, 1);
  return 1;
}

int vtkSchlierenFilter::RequestUpdateExtent(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  Internals& inside = *this->Inside;
  requestPieces(this, inputVector);
  const auto time = timeOf(request, inputVector, outputVector);
  if (time != inside.RequestedTime)
  {
    inside.FailedAt = inside.StoppedOf = 0; // of another time step
  }
  inside.RequestedTime = time;
  return 1;
}

void vtkSchlierenFilter::RequestSame(vtkInformation* inInfo) { requestPiece(inInfo); }

int vtkSchlierenFilter::RequestData(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  Internals& inside = *this->Inside;
  vtkImageData* output = vtkImageData::GetData(outputVector, IMAGE_PORT);
  vtkImageData* histogram = vtkImageData::GetData(outputVector, HISTOGRAM_PORT);
  output->Initialize();
  histogram->Initialize();
  const AtTheEnd complete([&] { setComplete(outputVector); }); // also of what has failed
  const AtTheEnd forgetChoice([&] { inside.Chosen.reset(); });
  const vtkMTimeType now = this->GetTimeOfImage();
  bool isWanted = false;
  // Of what has failed before, one message is enough.
  const auto begin = [&]
  { isWanted = inside.Ranks.begin(this, inputVector, inside.FailedAt != now); };
  const auto failOfRanks = [&](const std::string& problem)
  {
    if (isRank0() && inside.FailedAt != now)
    {
      this->Fail(problem, now, outputVector);
    }
  };
  if (!guarded(begin, noMemory, failOfRanks) || !isWanted)
  {
    return 1;
  }
  const double maxCells = this->MostGathered();
  std::optional<Internals::WithRanks> withRanks;
  if (isRank0())
  {
    withRanks.emplace(inside);
  }
  inside.Ranks.setOwn(this->GetMaker(), vtkDataObject::GetData(inputVector[0]),
    vtkDataObject::GetData(inputVector[BODIES]));
  const AtTheEnd forgetOwn([&] { inside.Ranks.forgetOwn(); });
  if (!isRank0())
  {
    inside.HasImage =
      inside.Ranks.ranks()
        .serve(threadsFrom(this->NumberOfThreads),
          [&](const std::vector<char>& message) { return inside.Ranks.answer(message); })
        .hasImage;
    return 1;
  }
  const AtTheEnd noteImage(
    [&]
    {
      inside.HasImage = output->GetNumberOfPoints() > 0;
      withRanks->Outcome.hasImage = inside.HasImage;
    });

  if (this->GetStopped())
  {
    this->ShowLast(outputVector);
    return 1;
  }

  inside.Time = timeOf(request, inputVector, outputVector);
  this->SetAbortExecute(0); // it stays set after an abort
  inside.IsStopping = false;
  guarded([&] { this->MakeImage(maxCells, outputVector); }, noMemory,
    [&](const std::string& problem) { this->Fail(problem, now, outputVector); });
  return 1;
}

void vtkSchlierenFilter::ShowLast(vtkInformationVector* outputs)
{
  for (int port = 0; port < this->GetNumberOfOutputPorts(); ++port)
  {
    this->Inside->Shown[port].Show(vtkImageData::GetData(outputs, port),
      outputs->GetInformationObject(port)->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT()));
  }
  tellPlaces(outputs);
}

void vtkSchlierenFilter::MakeImage(double maxCells, vtkInformationVector* outputs)
{
  Internals& inside = *this->Inside;
  vtkImageData* output = vtkImageData::GetData(outputs, IMAGE_PORT);
  vtkImageData* histogram = vtkImageData::GetData(outputs, HISTOGRAM_PORT);
  inside.Ranks.shareArrays();
  const auto [input, bodies] = inside.Ranks.gather(maxCells);
  if (!inside.Ranks.areInPieces() && isAbortedUpstream(this, input))
  {
    this->ForgetImage();
    this->Status = noIndexYet;
    return;
  }
  const bool continues = this->Continues(input, bodies);
  inside.UnfinishedOf = 0;
  if (!(this->TimeLimit > 0))
  {
    inside.DropShown(); // there will be a better image, which wants the memory
  }
  const bool isThere = continues || this->UpdateRefractivity(input, bodies);
  if (isThere && this->Render(output, histogram, continues))
  {
    this->ShowLast(outputs);
    return;
  }
  this->ForgetImage();
  output->Initialize();
  histogram->Initialize();
  if (this->GetAbortExecute() && (this->TimeLimit > 0 || inside.IsStopping))
  {
    inside.FailedAt = inside.StoppedOf = this->GetTimeOfImage(); // later than `now` by the abort
    this->Status = this->TimeLimit > 0 ? noIndexYet : "No image: it was stopped";
  }
}

void vtkSchlierenFilter::Fail(
  const std::string& problem, vtkMTimeType now, vtkInformationVector* outputs)
{
  this->Inside->FailedAt = now;
  vtkErrorMacro(<< problem << seeTroubleshooting);
  this->ForgetImage();
  this->Status = "No image: " + problem;
  for (int port = 0; port < outputs->GetNumberOfInformationObjects(); ++port)
  {
    vtkImageData::GetData(outputs, port)->Initialize();
  }
}

void vtkSchlierenFilter::ForgetImage()
{
  Internals& inside = *this->Inside;
  inside.UnfinishedOf = 0;
  inside.Ready.reset();
  inside.DropShown();
  this->KScaleUsed = this->AutomaticUsed = 0;
  this->Sensitivity.clear();
  this->Status.clear();
}
