// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// The medium that vtkRefractiveIndex makes of meshes and blocks without a grid in between.
#include "RefractiveIndexInternals.h"

#include "AmrSource.h"
#include "ArrayChoice.h"
#include "ChannelRanks.h"
#include "FieldFromImage.h"
#include "FieldTints.h"
#include "FlatData.h"
#include "GasChoices.h"
#include "ImageSource.h"
#include "InputDescription.h"
#include "MeshSearch.h"
#include "OneLayer.h"
#include "PiecesSource.h"
#include "PreparedLeaves.h"
#include "Ranks.h"
#include "RefractivityOfBodies.h"
#include "RefractivityOutside.h"
#include "RefractivityValues.h"
#include "Revolution.h"
#include "RevolvedSource.h"
#include "SamplingBox.h"

#include "vtkAlgorithm.h"
#include "vtkDataObject.h"
#include "vtkDoubleArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkSmartPointer.h"
#include "vtkUnsignedCharArray.h"

#include "Rays/RayWorker.h"
#include "Schlieren.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <deque>
#include <iterator>
#include <optional>
#include <stdexcept>
#include <utility>

using namespace filters;

namespace
{

bool isZero(int count) { return count == 0; }

/// Until it is aborted.
WorkProgress progressOf(vtkAlgorithm* self)
{
  return WorkProgress(
    [self](double done)
    {
      self->UpdateProgress(done);
      return !self->GetAbortExecute();
    });
}

} // namespace

//------------------------------------------------------------------------------
int filters::threadsOf(vtkRefractiveIndex* self)
{
  const int given = self->GetNumberOfThreads();
  const char* const most = std::getenv("VTK_SMP_MAX_THREADS");
  const int limit = most ? std::atoi(most) : 0;
  return given > 0 ? given : limit > 0 ? limit : schlieren::coresOfProcess();
}

//------------------------------------------------------------------------------
vtkSMPTools::Config filters::loopsWith(int threads)
{
  return vtkSMPTools::Config(threads, "STDThread", false);
}

//------------------------------------------------------------------------------
std::string filters::noGas(const Source& source)
{
  return "There is no valid value in the " + source.label +
    " (all are NaN, infinite, hidden, masked or no state of a gas), so there is no gas for light "
    "to cross. Choose another array or check the data.";
}

//------------------------------------------------------------------------------
std::string filters::noteOnWedge(vtkRefractiveIndex* self, const Source& source)
{
  std::array<double, 3> origin;
  std::copy_n(self->GetSymmetryOrigin(), 3, origin.begin());
  const std::optional<Wedge> wedge = findWedge(source, origin);
  return wedge ? "The data are a wedge of " + std::to_string(std::lround(wedge->degrees)) +
      " degrees around the " + "xyz"[wedge->axis] +
      " axis, as of an axisymmetric flow, and light crosses no more than that; set Symmetry to "
      "Axisymmetric for all of the flow."
               : "";
}

//------------------------------------------------------------------------------
void filters::addText(std::string& text, const std::string& more)
{
  text += (text.empty() || more.empty() ? "" : " ") + more;
}

//------------------------------------------------------------------------------
bool vtkRefractiveIndex::CanMakeSource(vtkDataObject* input, vtkDataObject* bodies)
{
  // Whether cells are one layer is of no effect here but in images, of which it is found at once, and with Symmetry.
  static const Source asTheyAre;
  const bool matters =
    this->Symmetry == AXISYMMETRIC || vtkImageData::SafeDownCast(input) != nullptr;
  const Source source = chooseSource(this, input, matters ? nullptr : &asTheyAre);
  const int* given = this->SamplingDimensions;
  if (this->Symmetry == AXISYMMETRIC)
  {
    revolutionOf(this, source); // throws where it is none
    return std::all_of(given, given + 3, isZero) && !SamplingBox(this->SamplingBounds).isGiven();
  }
  if ((source.image && !bodies) || SamplingBox(this->SamplingBounds).isGiven() ||
    !std::all_of(given, given + 3, isZero))
  {
    return false;
  }
  const int flat = flatAxisOf(source); // throws where there is no volume and no plane
  return !source.image || flat < 0;
}

//------------------------------------------------------------------------------
std::shared_ptr<const schlieren::MediumSource> vtkRefractiveIndex::MakeSourceOfImage(
  vtkDataObject* input, vtkDataObject* bodies, std::string& warning, SourceContents contents)
{
  vtkNew<vtkImageData> refractivity;
  warning = this->Convert(input, refractivity, nullptr, DIFFERENCES);
  this->Grid.clear();
  if (this->GetAbortExecute())
  {
    return nullptr;
  }
  mergeMasks(refractivity);
  const WorkProgress progress = progressOf(this);
  std::shared_ptr<ImageSource> made;
  const auto make = [&]
  {
    const int threads = vtkSMPTools::GetEstimatedNumberOfThreads();
    made = std::make_shared<ImageSource>(refractivity, bodies, threads, progress.part(0.5, 1));
    if (contents == WITH_FIELDS)
    {
      forFieldImages(this, input, refractivity, threads,
        [&](std::size_t, vtkImageData* field) { made->addField(field, threads); });
    }
    made->setHelpers(this->Pieces);
    progress.reach(1);
  };
  try
  {
    vtkSMPTools::LocalScope(loopsWith(threadsOf(this)), make);
  }
  catch (const Stopped&)
  {
    return nullptr;
  }
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
std::shared_ptr<const schlieren::MediumSource> vtkRefractiveIndex::MakeSource(vtkDataObject* input,
  vtkDataObject* bodies, std::string& warning, SourceContents contents)
{
  Source source = chooseSource(this, input);
  std::optional<Revolution> revolution;
  if (this->Symmetry == AXISYMMETRIC)
  {
    revolution = revolutionOf(this, source);
  }
  else if (source.image)
  {
    return this->MakeSourceOfImage(input, bodies, warning, contents);
  }
  const int flat = flatAxisOf(source);
  this->FlatAxis = flat;
  const double depth = flat < 0 ? 0 : depthOf(source, flat);
  this->Grid.clear();
  this->Search->release();
  Tally tally;
  bool hasGas = false, meetsBodies = false;
  std::shared_ptr<const schlieren::MediumSource> result;
  const auto take = [&](const auto& made)
  {
    hasGas = made->hasGas();
    meetsBodies = made->meetsBodies();
    result = made;
  };
  std::string ofShape; // before it is changed
  if (revolution)
  {
    ofShape = revolution->note;
  }
  else if (flat >= 0)
  {
    ofShape = warningOfExtrusion(source, flat);
  }
  else
  {
    ofShape = noteOnWedge(this, source);
  }
  const WorkProgress progress = progressOf(this);
  const auto make = [&]
  {
    if (auto* mean = std::get_if<FieldMean>(&source.model))
    {
      mean->findRanges(source.leaves);
    }
    std::vector<FieldValues> fields;
    if (contents == WITH_FIELDS)
    {
      fields = fieldValues(this, input, source);
    }
    if (revolution)
    {
      source = mirrored(source, *revolution);
      for (FieldValues& field : fields)
      {
        field.source = mirrored(field.source, *revolution);
      }
    }
    progress.reach(0.02);
    const auto outside = static_cast<filters::Outside>(this->Outside);
    const vtkSmartPointer<vtkDataObject> ownBodies = turnedBodies(bodies, flat, depth);
    if (std::optional<AmrLevels> levels = findLevels(source.leaves))
    {
      if (flat >= 0)
      {
        setDepth(*levels, depth);
        levels = turnedAcrossZ(std::move(*levels));
      }
      const auto made = std::make_shared<AmrSource>(
        *levels, source, ownBodies, outside, tally, progress.part(0.02, 1));
      for (FieldValues& field : fields)
      {
        bringToCells(field);
        made->addField(*levels, field.source);
      }
      made->setHelpers(this->Pieces);
      take(made);
      return;
    }
    if (flat >= 0)
    {
      source = extruded(source, flat, depth);
      for (FieldValues& field : fields)
      {
        field.source = extruded(field.source, flat, depth);
      }
    }
    const bool isSmooth = this->Reconstruction != LINEAR_IN_CELLS;
    const auto cellValues = isSmooth ? CellValues::Known : CellValues::Averaged;
    std::shared_ptr<const SharedPoints> shared;
    std::vector<const Source*> others;
    std::transform(fields.begin(), fields.end(), std::back_inserter(others),
      [](const FieldValues& field) { return &field.source; });
    const auto leaves = preparedLeaves(source, cellValues, tally, shared, others);
    progress.reach(0.1);
    const auto reconstruction =
      isSmooth ? CellTree::Reconstruction::Smooth : CellTree::Reconstruction::Linear;
    const std::uint64_t key = MeshSource::keyOf(leaves, ownBodies, outside, reconstruction);
    if (this->Mesh->key != key || !MeshSource::hasSameSheets(this->Mesh->mesh, leaves))
    {
      this->LeaveMesh();
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
      made =
        std::make_shared<MeshSource>(leaves, ownBodies, outside, reconstruction, ofMedium, flat);
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
    made->setHelpers(this->Pieces);
    take(made);
  };
  try
  {
    vtkSMPTools::LocalScope(loopsWith(threadsOf(this)), make);
  }
  catch (const Stopped&)
  {
    return nullptr;
  }
  if (!hasGas)
  {
    throw std::runtime_error(noGas(source));
  }
  warning = warningFrom(source.model, tally);
  if (bodies && !meetsBodies)
  {
    addText(warning, bodiesAreOutside);
  }
  addText(warning, this->NewNoteOnValues(source));
  addText(warning, this->NewNoteOnGases(source));
  addText(warning, ofShape);
  if (revolution)
  {
    return std::make_shared<RevolvedSource>(result, *revolution);
  }
  return result;
}

//------------------------------------------------------------------------------
bool vtkRefractiveIndex::ConvertRevolved(vtkDataObject* input, vtkImageData* output,
  vtkDataObject* bodies, Numbers numbers, std::string& warning)
{
  const auto source = this->MakeSource(input, bodies, warning);
  if (!source)
  {
    return false;
  }
  const std::string grid = this->Grid;
  this->ComputeGrid(input, output);
  this->Grid = grid;
  int points[3];
  output->GetDimensions(points);
  schlieren::Lattice all;
  output->GetOrigin(all.first.data());
  output->GetSpacing(all.spacing.data());
  const vtkIdType layer = vtkIdType{ points[0] } * points[1];
  vtkNew<vtkDoubleArray> values;
  values->SetNumberOfValues(output->GetNumberOfPoints());
  const auto valid = newMask(output->GetNumberOfPoints());
  const auto outside = newMask(output->GetNumberOfPoints());
  outside->SetName(transparentName);
  vtkSMPTools::LocalScope(loopsWith(threadsOf(this)),
    [&]
    {
      vtkSMPTools::For(0, points[2],
        [&](vtkIdType begin, vtkIdType end)
        {
          schlieren::Lattice lattice = all;
          lattice.points = { points[0], points[1], static_cast<int>(end - begin) };
          lattice.first[2] += static_cast<double>(begin) * all.spacing[2];
          std::vector<schlieren::Place> places(static_cast<std::size_t>(lattice.size()));
          source->sample(lattice, values->GetPointer(begin * layer), places.data(), nullptr);
          for (vtkIdType i = 0; i < layer * (end - begin); ++i)
          {
            const schlieren::Place place = places[static_cast<std::size_t>(i)];
            valid->SetValue(begin * layer + i, place == schlieren::Place::Gas ? 1 : 0);
            outside->SetValue(begin * layer + i, place == schlieren::Place::Window ? 1 : 0);
          }
        });
    });
  setArrays(output, { values }, Linear(), valid, numbers);
  setOutside(outside, output);
  return true;
}

//------------------------------------------------------------------------------
bool vtkRefractiveIndex::CanUsePieces()
{
  const int* given = this->SamplingDimensions;
  return std::all_of(given, given + 3, isZero) && !SamplingBox::isWanted(this->SamplingBounds) &&
    this->Symmetry == NO_SYMMETRY; // a plane is small
}

//------------------------------------------------------------------------------
void vtkRefractiveIndex::SetPieceChannels(std::vector<schlieren::Channel*> channels)
{
  this->Pieces->SetChannels(std::move(channels));
}

//------------------------------------------------------------------------------
void vtkRefractiveIndex::SetHelp(bool help) { this->Pieces->SetHelp(help); }

//------------------------------------------------------------------------------
bool vtkRefractiveIndex::UseSource(const schlieren::MediumSource* source)
{
  const auto* ofRanks = dynamic_cast<const SourceOfRanks*>(source);
  this->HasPieces = this->HasPieces || (source && source->isRemote());
  return !ofRanks || ofRanks->useRanks(this->Pieces);
}

//------------------------------------------------------------------------------
bool vtkRefractiveIndex::UsesSource(const schlieren::MediumSource* source)
{
  const auto* ofRanks = dynamic_cast<const SourceOfRanks*>(source);
  return !ofRanks || ofRanks->usesRanks(*this->Pieces);
}

//------------------------------------------------------------------------------
void vtkRefractiveIndex::ShareArrays(vtkDataObject* own)
{
  if (!hasOtherRanks() || !isOpen(this))
  {
    return;
  }
  ChannelRanks& pieces = *this->Pieces;
  try
  {
    std::vector<std::vector<char>> requests(pieces.Count(), pieceRequest(PieceWorker::GiveArrays));
    requests[0].clear();
    std::vector<FlowArray> all = flowArraysOf(dataSetsOf(own), true);
    const auto answers = pieces.Request(std::move(requests));
    std::deque<Reader> readers = readersOf(answers);
    for (Reader& reader : readers)
    {
      addArrays(all, getArrays(reader));
    }
    std::vector<char> message = pieceRequest(PieceWorker::TakeArrays);
    putArrays(all, message);
    requests.assign(pieces.Count(), message);
    requests[0].clear();
    pieces.Request(std::move(requests));
    this->Known->SetOfRanks(std::move(all));
  }
  catch (const std::runtime_error&)
  {
    // A rank has not come, which whoever gathers the data reports.
  }
}

//------------------------------------------------------------------------------
void vtkRefractiveIndex::ReleasePieces()
{
  if (std::exchange(this->HasPieces, false))
  {
    *this->MeshOfPieces = {};
    ChannelRanks& pieces = *this->Pieces;
    try
    {
      pieces.Request(
        std::vector<std::vector<char>>(pieces.Count(), pieceRequest(PieceWorker::Forget)));
    }
    catch (const std::runtime_error&)
    {
      // A rank has not come. It forgets its piece when the next one is made.
    }
  }
}

//------------------------------------------------------------------------------
void vtkRefractiveIndex::SetPieceData(vtkDataObject* data, vtkDataObject* earlier)
{
  this->Pieces->GetOwn().SetData(data, earlier);
}

//------------------------------------------------------------------------------
void vtkRefractiveIndex::SetInstantOfPieces(double ratio)
{
  std::vector<char> request = pieceRequest(PieceWorker::Instant);
  put(ratio, request);
  ChannelRanks& pieces = *this->Pieces;
  std::vector<std::vector<char>> requests(pieces.Count(), request);
  requests[0].clear();
  readersOf(pieces.Request(std::move(requests))); // throws what has gone wrong
}

//------------------------------------------------------------------------------
std::vector<char> vtkRefractiveIndex::RespondForPiece(const std::vector<char>& message)
{
  return PieceWorker::IsFor(schlieren::RayWorker::kindOf(message))
    ? this->Pieces->GetOwn().Respond(message)
    : std::vector<char>();
}

//------------------------------------------------------------------------------
std::shared_ptr<const schlieren::MediumSource> vtkRefractiveIndex::MakeSourceOfPieces(
  vtkDataObject* input, vtkDataObject* bodies, std::string& warning, SourceContents contents)
{
  this->Grid.clear();
  this->FlatAxis = -1;
  this->Search->release();
  this->LeaveMesh();
  this->SetPieceData(input);
  this->HasPieces = true;
  std::shared_ptr<PiecesSource> made;
  try
  {
    vtkSMPTools::LocalScope(loopsWith(threadsOf(this)),
      [&]
      {
        made = std::make_shared<PiecesSource>(this->Pieces, bodies,
          static_cast<filters::Outside>(this->Outside), contents == WITH_FIELDS,
          *this->MeshOfPieces, progressOf(this));
        *this->MeshOfPieces = made->mesh();
      });
  }
  catch (const Stopped&)
  {
    this->SetPieceData(nullptr);
    return nullptr;
  }
  this->SetPieceData(nullptr);
  Source source;
  source.model = modelFrom(this);
  source.noteOnGases = noteOnGases(this);
  source.label = made->label();
  if (!made->hasGas())
  {
    throw std::runtime_error(noGas(source));
  }
  warning = warningFrom(source.model, made->tally());
  if (bodies && !made->meetsBodies())
  {
    addText(warning, bodiesAreOutside);
  }
  addText(warning, this->NewNoteOnValues(source));
  addText(warning, this->NewNoteOnGases(source));
  return made;
}
