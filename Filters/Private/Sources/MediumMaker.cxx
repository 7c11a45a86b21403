// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Sources/MediumMaker.h"

#include "Common/AvailableMemory.h"
#include "Common/FieldFromImage.h"
#include "Common/Threads.h"
#include "Input/FlatBodies.h"
#include "Input/FlatData.h"
#include "Input/InputDescription.h"
#include "Input/OneLayer.h"
#include "Input/RefractivityOfImage.h"
#include "Input/SamplingBox.h"
#include "Sources/AmrPiece.h"
#include "Sources/FieldTints.h"
#include "Sources/GridOfSource.h"
#include "Sources/Mirrored.h"
#include "Sources/PreparedLeaves.h"
#include "Sources/Revolution.h"
#include "Sources/RevolvedSource.h"
#include "Walls/BodyTriangles.h"

#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkIntArray.h"
#include "vtkMatrix3x3.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkUnsignedCharArray.h"

#include "Schlieren.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace filters
{

namespace
{

/// Throws if memory does not suffice for a grid's arrays and their computation.
void requireMemoryFor(
  vtkImageData* grid, bool isDouble, std::size_t bytesToMake, const std::string& remedy)
{
  int points[3];
  grid->GetDimensions(points);
  const std::size_t bytes = bytesToMake + 1 + (isDouble ? sizeof(double) : sizeof(float));
  requireMemory(static_cast<double>(bytes) * points[0] * points[1] * points[2],
    "The refractivity on a grid of " + std::to_string(points[0]) + " x " +
      std::to_string(points[1]) + " x " + std::to_string(points[2]) + " points",
    remedy);
}

const char* const fewerPoints =
  "Give smaller SamplingDimensions (zeros: chosen from the data), or SamplingBounds of a part of "
  "the data.";

/// Returns the coordinate axis across the plane of the data; -1: there is none.
int planeOf(const Source& source)
{
  return source.image && !source.image->GetDirectionMatrix()->IsIdentity() ? -1
                                                                           : flatAxisOf(source);
}

/// Makes the source of an image. `bodies`: in its axes; may be null.
std::shared_ptr<const PieceSource> sourceOf(
  std::unique_ptr<const ImagePiece> piece, vtkDataObject* bodies)
{
  const double ambient = ImagePiece::ambientOf(piece->outer());
  auto boundary = std::make_shared<const GasBoundary>(piece->faces(), bodies, Outside::Passes);
  return std::make_shared<PieceSource>(std::move(piece), std::move(boundary), ambient);
}

/// Makes the source of adaptive meshes, with walls at the edges of solid cells.
std::shared_ptr<const PieceSource> sourceOf(
  std::unique_ptr<const AmrPiece> piece, vtkDataObject* bodies, Outside outside)
{
  const double ambient = weightedMedian(piece->refractivity().outerValues());
  BoundaryFaces faces = piece->refractivity().faces();
  sortTriangles(faces);
  auto boundary = std::make_shared<const GasBoundary>(std::move(faces), bodies, outside);
  return std::make_shared<PieceSource>(std::move(piece), std::move(boundary), ambient);
}

/// Returns a note on 3-D data that are a wedge; else empty.
std::string noteOnWedge(const Source& source)
{
  const std::optional<Wedge> wedge = findWedge(source, source.choice.settings.symmetryOrigin());
  return wedge ? "The data are a wedge of " + std::to_string(std::lround(wedge->degrees)) +
      " degrees around the " + "xyz"[wedge->axis] +
      " axis, as of an axisymmetric flow, and light crosses no more than that; set Symmetry to "
      "Axisymmetric for all of the flow."
               : "";
}

} // namespace

//------------------------------------------------------------------------------
MediumMaker::MediumMaker(Progress progress)
  : Report(std::move(progress))
{
}

//------------------------------------------------------------------------------
int MediumMaker::threads() const
{
  const int given = threadsFrom(this->numberOfThreads);
  return given > 0 ? given : schlieren::coresOfProcess();
}

//------------------------------------------------------------------------------
std::string noGas(const std::string& label)
{
  return "There is no valid value in the " + label +
    " (all are NaN, infinite, hidden, masked or no state of a gas), so there is no gas for light "
    "to cross. Choose another array or check the data.";
}

//------------------------------------------------------------------------------
void addText(std::string& text, const std::string& more)
{
  text += (text.empty() || more.empty() ? "" : " ") + more;
}

//------------------------------------------------------------------------------
MediumChoice MediumMaker::choice() const { return choiceOf(this->settings, this->Known.Get()); }

//------------------------------------------------------------------------------
MediumChoice MediumMaker::choiceFor(vtkDataObject* input)
{
  return filters::choiceFor(this->settings, this->Known, dataSetsOf(input));
}

//------------------------------------------------------------------------------
WorkProgress MediumMaker::progressOf(double from, double to) const
{
  return WorkProgress(this->Report).part(from, to);
}

//------------------------------------------------------------------------------
Source MediumMaker::choose(vtkDataObject* input, const Source* like)
{
  return chooseSource(this->settings, this->Known, input, like);
}

//------------------------------------------------------------------------------
bool MediumMaker::willReadCells(vtkDataObject* image)
{
  try
  {
    return this->choose(image).leaves[0].ofCells;
  }
  catch (const std::runtime_error&)
  {
    return selectionsFrom(this->choice().settings)[0].cellsFirst;
  }
}

//------------------------------------------------------------------------------
void MediumMaker::forgetLast()
{
  this->Grid.clear();
  this->FlatAxis = -1;
  leave(this->Mesh);
}

//------------------------------------------------------------------------------
std::string MediumMaker::warningOf(const Source& source, const Tally& tally, bool bodiesMissed)
{
  std::string warning = warningFrom(source.model, tally);
  if (bodiesMissed)
  {
    addText(warning, bodiesAreOutside);
  }
  Implausible found;
  if (!source.leaves.empty())
  {
    found = implausibleIn(source);
  }
  if (found.kind != this->ToldOfValues)
  {
    addText(warning, found.text);
  }
  this->ToldOfValues = found.kind;
  if (source.noteOnGases != this->ToldOfGases)
  {
    addText(warning, source.noteOnGases);
  }
  this->ToldOfGases = source.noteOnGases;
  return warning;
}

//------------------------------------------------------------------------------
void MediumMaker::computeGrid(vtkDataObject* input, vtkImageData* structure)
{
  const Source source = this->choose(input);
  this->FlatAxis = planeOf(source);
  if (this->settings.isAxisymmetric())
  {
    gridOf(revolutionOf(source), source, this->settings.SamplingDimensions,
      SamplingBox(this->settings.SamplingBounds), structure);
  }
  else if (source.image)
  {
    gridOfImage(source.image, source.leaves[0].ofCells, source.depth, structure);
    SamplingBox(this->settings.SamplingBounds).crop(structure);
  }
  else
  {
    const GridPlan& plan = this->planGrid(source, input);
    plan.amr ? gridOf(*plan.amr, structure) : gridOf(plan.resampling, structure);
  }
}

//------------------------------------------------------------------------------
void MediumMaker::computeBox(vtkDataObject* input, vtkImageData* structure)
{
  const Source source = this->choose(input);
  this->FlatAxis = planeOf(source);
  if (this->settings.isAxisymmetric())
  {
    boxOf(revolutionOf(source), structure);
    return;
  }
  gridOf(boxOf(source), structure);
}

//------------------------------------------------------------------------------
const MediumMaker::GridPlan& MediumMaker::planGrid(const Source& source, vtkDataObject* input)
{
  GridPlan& plan = this->Plan;
  std::vector<double> described = describeInput(input, 0);
  if (plan.input != described || plan.settings != source.choice.settings)
  {
    plan.input.clear();
    ++plan.count;
    const SamplingBox box(this->settings.SamplingBounds);
    plan.amr = planAmr(source, this->settings.SamplingDimensions, box);
    if (!plan.amr)
    {
      plan.resampling = planResampling(source, this->settings.SamplingDimensions, box);
    }
    plan.settings = source.choice.settings;
    plan.input = std::move(described);
  }
  return plan;
}

//------------------------------------------------------------------------------
void MediumMaker::fillFromImage(
  Source source, Numbers numbers, vtkDataObject* bodies, vtkImageData* output, std::string& warning)
{
  leave(this->Mesh);
  if (auto* fields = std::get_if<FieldMean>(&source.model))
  {
    fields->findRanges(source.leaves);
  }
  gridOfImage(source.image, source.leaves[0].ofCells, source.depth, output);
  requireMemoryFor(output, this->settings.DoublePrecision, 0, "Use a coarser input.");
  const Tally tally = convertImage(source, numbers, output);
  SamplingBox(this->settings.SamplingBounds).crop(output);
  bool bodiesMissed = false;
  if (bodies)
  {
    vtkNew<vtkImageData> refractivity;
    refractivity->ShallowCopy(output);
    mergeMasks(refractivity);
    const auto own = turnedBack(bodies, gridFrom(output).direction);
    const auto withBodies = sourceOf(std::make_unique<const ImagePiece>(refractivity,
                                       ImagePiece::extentsOf(output), own, this->threads()),
      own);
    this->progressOf(0.5, 1).reach(0.4);
    bodiesMissed =
      !withBodies->meetsBodies() || !maskWalls(*withBodies, this->progressOf(0.7, 1), output);
  }
  warning = this->warningOf(source, tally, bodiesMissed);
  const int flat = flatAxisOf(source);
  addText(warning, flat < 0 ? noteOnWedge(source) : warningOfExtrusion(source, flat));
}

//------------------------------------------------------------------------------
void MediumMaker::fillFromSource(const Source& source, vtkDataObject* input, Numbers numbers,
  vtkDataObject* bodies, vtkImageData* output, std::string& warning, std::string& note)
{
  if (this->settings.isAxisymmetric())
  {
    note = "of the body of revolution";
    gridOf(revolutionOf(source), source, this->settings.SamplingDimensions,
      SamplingBox(this->settings.SamplingBounds), output);
  }
  else
  {
    const GridPlan& plan = this->planGrid(source, input);
    note = plan.amr ? plan.amr->note : plan.resampling.note;
    plan.amr ? gridOf(*plan.amr, output) : gridOf(plan.resampling, output);
  }
  constexpr std::size_t bytesToFill = sizeof(double) + 3;
  requireMemoryFor(output, this->settings.DoublePrecision, bytesToFill, fewerPoints);
  const auto made = this->makeSourceOfCells(source, input, bodies, warning, false);
  fillGrid(*made, numbers, bodies != nullptr, this->progressOf(0.5, 1), output);
}

//------------------------------------------------------------------------------
std::string MediumMaker::convert(
  vtkDataObject* input, vtkImageData* output, vtkDataObject* bodies, Numbers numbers)
{
  output->Initialize();
  this->Grid.clear();
  return this->convert(this->choose(input), input, output, bodies, numbers);
}

//------------------------------------------------------------------------------
std::string MediumMaker::convert(const Source& source, vtkDataObject* input, vtkImageData* output,
  vtkDataObject* bodies, Numbers numbers)
{
  this->progressOf(0, 1).reach(0.05);
  numbers = this->settings.DoublePrecision ? Numbers::Doubles : numbers;
  this->FlatAxis = planeOf(source);
  std::string warning, note = "the data's own";
  vtkSMPTools::LocalScope(loopsWith(this->threads()),
    [&]
    {
      this->keepsGrid(source)
        ? this->fillFromImage(source, numbers, bodies, output, warning)
        : this->fillFromSource(source, input, numbers, bodies, output, warning, note);
    });
  const unsigned char* valid =
    vtkUnsignedCharArray::SafeDownCast(output->GetPointData()->GetArray(maskName))->GetPointer(0);
  if (std::none_of(
        valid, valid + output->GetNumberOfPoints(), [](unsigned char v) { return v != 0; }))
  {
    throw std::runtime_error(bodies ? bodiesCoverAll : noGas(source.label));
  }

  int dimensions[3];
  output->GetDimensions(dimensions);
  this->Grid = std::to_string(dimensions[0]) + " x " + std::to_string(dimensions[1]) + " x " +
    std::to_string(dimensions[2]) + " points: " + note;
  vtkNew<vtkIntArray> used;
  used->SetName("SamplingDimensions");
  used->SetNumberOfComponents(3);
  used->InsertNextTypedTuple(dimensions);
  output->GetFieldData()->AddArray(used);
  return warning;
}

//------------------------------------------------------------------------------
bool MediumMaker::canMakeSource(vtkDataObject* input, vtkDataObject* bodies, bool imagesToo)
{
  // Flattens single layers only in images, where that is fast, and with Symmetry.
  static const Source asTheyAre;
  const bool matters =
    this->settings.isAxisymmetric() || vtkImageData::SafeDownCast(input) != nullptr;
  const Source source = this->choose(input, matters ? nullptr : &asTheyAre);
  if (this->settings.isAxisymmetric())
  {
    revolutionOf(source); // throws if there is none
    return !this->wantsGrid();
  }
  const int flat = flatAxisOf(source); // throws without volume and plane
  if (this->wantsGrid() || source.image)
  {
    return flat < 0 && (bodies || (imagesToo && !this->wantsGrid()));
  }
  return true;
}

//------------------------------------------------------------------------------
bool MediumMaker::hasDimensions() const
{
  const int* given = this->settings.SamplingDimensions;
  return std::any_of(given, given + 3, [](int count) { return count != 0; });
}

//------------------------------------------------------------------------------
bool MediumMaker::canUsePieces() const
{
  return !this->hasDimensions() && !SamplingBox::isWanted(this->settings.SamplingBounds) &&
    !this->settings.isAxisymmetric(); // planes are small
}

//------------------------------------------------------------------------------
bool MediumMaker::wantsGrid() const
{
  return SamplingBox(this->settings.SamplingBounds).isGiven() || this->hasDimensions();
}

//------------------------------------------------------------------------------
std::unique_ptr<ImagePiece> MediumMaker::makePieceOfImage(vtkImageData* refractivity,
  const ImagePiece::Extents& extents, vtkDataObject* bodies, vtkDataObject* input,
  const Source& source, bool withFields, const std::vector<FieldMean::Range>& ranges)
{
  const int threads = this->threads();
  auto piece = std::make_unique<ImagePiece>(refractivity, extents, bodies, threads);
  if (withFields)
  {
    forFieldImages(
      *this, input, source, refractivity,
      [&](std::size_t, vtkImageData* field) { piece->addField(field, threads); }, ranges);
  }
  return piece;
}

//------------------------------------------------------------------------------
std::shared_ptr<const schlieren::MediumSource> MediumMaker::makeSourceOfImage(const Source& source,
  vtkDataObject* input, vtkDataObject* bodies, std::string& warning, bool withFields)
{
  vtkNew<vtkImageData> refractivity;
  warning = this->convert(source, input, refractivity, nullptr, Numbers::Differences);
  this->Grid.clear();
  mergeMasks(refractivity);
  std::shared_ptr<const PieceSource> made;
  const auto make = [&]
  {
    const auto own = turnedBack(bodies, gridFrom(refractivity).direction);
    made = sourceOf(this->makePieceOfImage(refractivity, ImagePiece::extentsOf(refractivity), own,
                      input, source, withFields),
      own);
    this->progressOf(0, 1).reach(1);
  };
  vtkSMPTools::LocalScope(loopsWith(this->threads()), make);
  if (!made->hasGas())
  {
    throw std::runtime_error(bodiesCoverAll);
  }
  if (bodies && !made->meetsBodies())
  {
    addText(warning, bodiesAreOutside);
  }
  return made;
}

//------------------------------------------------------------------------------
std::shared_ptr<const schlieren::MediumSource> MediumMaker::makeSource(
  vtkDataObject* input, vtkDataObject* bodies, std::string& warning, bool withFields)
{
  const Source source = this->choose(input);
  const bool isGrid =
    this->keepsGrid(source) || (this->wantsGrid() && !this->settings.isAxisymmetric());
  return isGrid ? this->makeSourceOfImage(source, input, bodies, warning, withFields)
                : this->makeSourceOfCells(source, input, bodies, warning, withFields);
}

//------------------------------------------------------------------------------
std::shared_ptr<const schlieren::MediumSource> MediumMaker::makeSourceOtherwise(
  vtkDataObject* input, vtkDataObject* bodies, Progress progress)
{
  MediumMaker other(std::move(progress));
  other.settings = this->choiceFor(input).settings;
  other.settings.Reconstruction = other.settings.Reconstruction == MediumSettings::Smooth
    ? MediumSettings::Coarser
    : MediumSettings::Smooth;
  other.numberOfThreads = this->numberOfThreads;
  const Source source = other.choose(input);
  if (other.keepsGrid(source) || other.wantsGrid() || findLevels(source.leaves))
  {
    return nullptr;
  }
  std::string warning; // as that of the settings
  return other.makeSourceOfCells(source, input, bodies, warning, false);
}

//------------------------------------------------------------------------------
std::shared_ptr<const PieceSource> MediumMaker::makeOf(
  Source source, std::vector<Source> fields, vtkDataObject* bodies, double depth, Tally& tally)
{
  const int flat = this->FlatAxis;
  const vtkSmartPointer<vtkDataObject> ownBodies = turnedBodies(bodies, flat, depth);
  const auto outside = static_cast<Outside>(this->settings.Outside);
  std::optional<AmrLevels> levels = findLevels(source.leaves);
  if (!levels)
  {
    if (flat >= 0)
    {
      source = extruded(source, flat, depth);
      for (Source& field : fields)
      {
        field = extruded(field, flat, depth);
      }
    }
    const auto reconstruction = reconstructionOf(this->settings);
    const PreparedLeaves leaves = preparedLeaves(source, fields, reconstruction, tally);
    this->progressOf(0, 1).reach(0.1);
    return sourceOfMeshes(
      leaves, { reconstruction, outside, flat }, ownBodies, this->progressOf(0.1, 1), this->Mesh);
  }
  if (flat >= 0)
  {
    setDepth(*levels, depth);
    levels = turnedAcrossZ(std::move(*levels));
  }
  std::for_each(fields.begin(), fields.end(), bringToCells);
  return sourceOf(
    std::make_unique<AmrPiece>(*levels, source, fields, tally, this->progressOf(0.02, 1)),
    ownBodies, outside);
}

//------------------------------------------------------------------------------
std::shared_ptr<const schlieren::MediumSource> MediumMaker::makeSourceOfCells(
  Source source, vtkDataObject* input, vtkDataObject* bodies, std::string& warning, bool withFields)
{
  std::optional<Revolution> revolution;
  if (this->settings.isAxisymmetric())
  {
    revolution = revolutionOf(source);
  }
  this->FlatAxis = flatAxisOf(source);
  const double depth = this->FlatAxis < 0 ? 0 : depthOf(source, this->FlatAxis);
  this->Grid.clear();
  const std::string ofShape = revolution ? revolution->note
    : this->FlatAxis >= 0                ? warningOfExtrusion(source, this->FlatAxis)
                                         : noteOnWedge(source);
  Tally tally;
  std::shared_ptr<const PieceSource> made;
  const auto make = [&]
  {
    if (auto* mean = std::get_if<FieldMean>(&source.model))
    {
      mean->findRanges(source.leaves);
    }
    std::vector<Source> fields;
    if (withFields)
    {
      fields = fieldSources(source.choice.settings, input, source);
    }
    if (revolution)
    {
      source = mirrored(source, *revolution);
      for (Source& field : fields)
      {
        field = mirrored(field, *revolution);
      }
    }
    this->progressOf(0, 1).reach(0.02);
    made = this->makeOf(source, std::move(fields), bodies, depth, tally);
  };
  vtkSMPTools::LocalScope(loopsWith(this->threads()), make);
  if (!made->hasGas())
  {
    throw std::runtime_error(noGas(source.label));
  }
  warning = this->warningOf(source, tally, bodies && !made->meetsBodies());
  addText(warning, ofShape);
  if (revolution)
  {
    return std::make_shared<RevolvedSource>(made, *revolution);
  }
  return made;
}

} // namespace filters
