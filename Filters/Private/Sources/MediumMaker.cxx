// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Sources/MediumMaker.h"

#include "Common/AvailableMemory.h"
#include "Common/FieldFromImage.h"
#include "Common/Threads.h"
#include "Input/FlatData.h"
#include "Input/InputDescription.h"
#include "Input/OneLayer.h"
#include "Input/RefractivityOfImage.h"
#include "Input/SamplingBox.h"
#include "Sources/AmrSource.h"
#include "Sources/FieldTints.h"
#include "Sources/GridOfSource.h"
#include "Sources/ImageSource.h"
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
#include <iterator>
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
bool MediumMaker::keepsGrid(vtkDataObject* input)
{
  return !this->settings.isAxisymmetric() && this->choose(input).image != nullptr;
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
void MediumMaker::leaveMesh()
{
  if (this->Mesh.use_count() > 1)
  {
    const vtkTypeInt64 builds = this->Mesh->builds;
    this->Mesh = std::make_shared<KeptMesh>();
    this->Mesh->builds = builds;
  }
  this->Mesh->release();
}

//------------------------------------------------------------------------------
void MediumMaker::forgetLast()
{
  this->Grid.clear();
  this->FlatAxis = -1;
  this->leaveMesh();
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
void MediumMaker::fillFromImage(const Source& given, Numbers numbers, vtkDataObject* bodies,
  vtkImageData* output, std::string& warning)
{
  Source source = given;
  this->leaveMesh();
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
    const ImageSource withBodies(
      refractivity, bodies, vtkSMPTools::GetEstimatedNumberOfThreads(), this->progressOf(0.5, 0.7));
    bodiesMissed =
      !withBodies.meetsBodies() || !maskWalls(withBodies, this->progressOf(0.7, 1), output);
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
  const auto made = this->makeSourceOfCells(input, bodies, warning);
  fillGrid(*made, numbers, bodies != nullptr, this->progressOf(0.5, 1), output);
}

//------------------------------------------------------------------------------
std::string MediumMaker::convert(
  vtkDataObject* input, vtkImageData* output, vtkDataObject* bodies, Numbers numbers)
{
  output->Initialize();
  this->Grid.clear();
  const Source source = this->choose(input);
  this->progressOf(0, 1).reach(0.05);
  numbers = this->settings.DoublePrecision ? Numbers::Doubles : numbers;
  this->FlatAxis = planeOf(source);
  std::string warning, note = "the data's own";
  vtkSMPTools::LocalScope(loopsWith(this->threads()),
    [&]
    {
      source.image && !this->settings.isAxisymmetric()
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
std::shared_ptr<const schlieren::MediumSource> MediumMaker::makeSourceOfImage(
  vtkDataObject* input, vtkDataObject* bodies, std::string& warning, bool withFields)
{
  vtkNew<vtkImageData> refractivity;
  warning = this->convert(input, refractivity, nullptr, Numbers::Differences);
  this->Grid.clear();
  mergeMasks(refractivity);
  const WorkProgress progress(this->Report);
  std::shared_ptr<ImageSource> made;
  const auto make = [&]
  {
    const int threads = vtkSMPTools::GetEstimatedNumberOfThreads();
    made = std::make_shared<ImageSource>(refractivity, bodies, threads, progress.part(0.5, 1));
    if (withFields)
    {
      forFieldImages(*this, input, refractivity, threads,
        [&](std::size_t, vtkImageData* field) { made->addField(field, threads); });
    }
    progress.reach(1);
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
  const bool isGrid =
    !this->settings.isAxisymmetric() && (this->wantsGrid() || this->keepsGrid(input));
  return isGrid ? this->makeSourceOfImage(input, bodies, warning, withFields)
                : this->makeSourceOfCells(input, bodies, warning, withFields);
}

//------------------------------------------------------------------------------
MediumMaker::Made MediumMaker::makeOfMesh(
  const Source& source, const std::vector<FieldValues>& fields, vtkDataObject* bodies, int flat)
{
  const WorkProgress progress(this->Report);
  Made result;
  const bool isSmooth = this->settings.isSmooth();
  const auto cellValues = isSmooth ? CellValues::Known : CellValues::Averaged;
  std::shared_ptr<const SharedPoints> shared;
  std::vector<const Source*> others;
  std::transform(fields.begin(), fields.end(), std::back_inserter(others),
    [](const FieldValues& field) { return &field.source; });
  const auto leaves = preparedLeaves(source, cellValues, result.tally, shared, others);
  progress.reach(0.1);
  const auto outside = static_cast<filters::Outside>(this->settings.Outside);
  const auto reconstruction =
    isSmooth ? CellTree::Reconstruction::Smooth : CellTree::Reconstruction::Linear;
  const std::uint64_t key = MeshSource::keyOf(leaves, bodies, outside, reconstruction);
  if (this->Mesh->key != key || !MeshSource::hasSameSheets(this->Mesh->mesh, leaves))
  {
    this->leaveMesh();
  }
  KeptMesh& kept = *this->Mesh;
  const WorkProgress ofMedium = progress.part(0.1, fields.empty() ? 1 : 0.8);
  std::shared_ptr<MeshSource> made;
  if (kept.key == key)
  {
    made = std::make_shared<MeshSource>(leaves, kept.mesh, ofMedium, flat);
  }
  else
  {
    ++kept.builds;
    made = std::make_shared<MeshSource>(leaves, bodies, outside, reconstruction, ofMedium, flat);
    kept.key = key;
  }
  kept.mesh = made->mesh();
  const auto begunAt = [&](std::size_t number)
  { return 0.8 + 0.2 * static_cast<double>(number) / static_cast<double>(fields.size()); };
  for (std::size_t number = 0; number < fields.size(); ++number)
  {
    Tally notReported;
    made->addField(preparedLeaves(fields[number].source, cellValues, notReported, shared),
      progress.part(begunAt(number), begunAt(number + 1)));
  }
  result.hasGas = made->hasGas();
  result.meetsBodies = made->meetsBodies();
  result.source = made;
  return result;
}

//------------------------------------------------------------------------------
MediumMaker::Made MediumMaker::makeOf(
  Source source, std::vector<FieldValues> fields, vtkDataObject* bodies, double depth)
{
  const int flat = this->FlatAxis;
  const vtkSmartPointer<vtkDataObject> ownBodies = turnedBodies(bodies, flat, depth);
  std::optional<AmrLevels> levels = findLevels(source.leaves);
  if (!levels)
  {
    if (flat >= 0)
    {
      source = extruded(source, flat, depth);
      for (FieldValues& field : fields)
      {
        field.source = extruded(field.source, flat, depth);
      }
    }
    return this->makeOfMesh(source, fields, ownBodies, flat);
  }
  if (flat >= 0)
  {
    setDepth(*levels, depth);
    levels = turnedAcrossZ(std::move(*levels));
  }
  Made result;
  const auto outside = static_cast<filters::Outside>(this->settings.Outside);
  const auto made = std::make_shared<AmrSource>(
    *levels, source, ownBodies, outside, result.tally, this->progressOf(0.02, 1));
  for (FieldValues& field : fields)
  {
    bringToCells(field);
    made->addField(*levels, field.source);
  }
  result.hasGas = made->hasGas();
  result.meetsBodies = made->meetsBodies();
  result.source = made;
  return result;
}

//------------------------------------------------------------------------------
std::shared_ptr<const schlieren::MediumSource> MediumMaker::makeSourceOfCells(
  vtkDataObject* input, vtkDataObject* bodies, std::string& warning, bool withFields)
{
  Source source = this->choose(input);
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
  Made made;
  const auto make = [&]
  {
    if (auto* mean = std::get_if<FieldMean>(&source.model))
    {
      mean->findRanges(source.leaves);
    }
    std::vector<FieldValues> fields;
    if (withFields)
    {
      fields = fieldValues(source.choice.settings, input, source);
    }
    if (revolution)
    {
      source = mirrored(source, *revolution);
      for (FieldValues& field : fields)
      {
        field.source = mirrored(field.source, *revolution);
      }
    }
    this->progressOf(0, 1).reach(0.02);
    made = this->makeOf(source, std::move(fields), bodies, depth);
  };
  vtkSMPTools::LocalScope(loopsWith(this->threads()), make);
  if (!made.hasGas)
  {
    throw std::runtime_error(noGas(source.label));
  }
  warning = this->warningOf(source, made.tally, bodies && !made.meetsBodies);
  addText(warning, ofShape);
  if (revolution)
  {
    return std::make_shared<RevolvedSource>(made.source, *revolution);
  }
  return made.source;
}

} // namespace filters
