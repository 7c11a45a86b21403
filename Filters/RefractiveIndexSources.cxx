// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// The medium that vtkRefractiveIndex makes of meshes and blocks without a grid in between.
#include "RefractiveIndexInternals.h"

#include "AmrSource.h"
#include "ArrayChoice.h"
#include "BodyTriangles.h"
#include "FieldFromImage.h"
#include "FieldTints.h"
#include "FlatData.h"
#include "GasChoices.h"
#include "ImageSource.h"
#include "InputDescription.h"
#include "InputsOfRanks.h"
#include "OneLayer.h"
#include "PreparedLeaves.h"
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

#include "Schlieren.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <optional>
#include <stdexcept>
#include <utility>

using namespace filters;

namespace
{

bool isZero(int count) { return count == 0; }

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
WorkProgress filters::progressOf(vtkAlgorithm* self)
{
  return WorkProgress(
    [self](double done)
    {
      self->UpdateProgress(done);
      return !self->GetAbortExecute();
    });
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
bool vtkRefractiveIndex::CanMakeSource(vtkDataObject* input, vtkDataObject* bodies, bool imagesToo)
{
  // Whether cells are one layer is of no effect here but in images, of which it is found at once, and with Symmetry.
  static const Source asTheyAre;
  const bool matters =
    this->Symmetry == AXISYMMETRIC || vtkImageData::SafeDownCast(input) != nullptr;
  const Source source = chooseSource(this, input, matters ? nullptr : &asTheyAre);
  if (this->Symmetry == AXISYMMETRIC)
  {
    revolutionOf(this, source); // throws where it is none
    return !this->WantsGrid();
  }
  const int flat = flatAxisOf(source); // throws where there is no volume and no plane
  if (this->WantsGrid() || source.image)
  {
    return flat < 0 && (bodies || (imagesToo && !this->WantsGrid()));
  }
  return true;
}

//------------------------------------------------------------------------------
bool vtkRefractiveIndex::WantsGrid() const
{
  const int* given = this->SamplingDimensions;
  return SamplingBox(this->SamplingBounds).isGiven() || !std::all_of(given, given + 3, isZero);
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
std::shared_ptr<const schlieren::MediumSource> vtkRefractiveIndex::MakeSource(
  vtkDataObject* input, vtkDataObject* bodies, std::string& warning, SourceContents contents)
{
  const bool isGrid = this->Symmetry == NO_SYMMETRY &&
    (this->WantsGrid() || chooseSource(this, input).image != nullptr);
  return isGrid ? this->MakeSourceOfImage(input, bodies, warning, contents)
                : this->MakeSourceOfCells(input, bodies, warning, contents);
}

//------------------------------------------------------------------------------
std::shared_ptr<const schlieren::MediumSource> vtkRefractiveIndex::MakeSourceOfCells(
  vtkDataObject* input, vtkDataObject* bodies, std::string& warning, SourceContents contents)
{
  Source source = chooseSource(this, input);
  std::optional<Revolution> revolution;
  if (this->Symmetry == AXISYMMETRIC)
  {
    revolution = revolutionOf(this, source);
  }
  const int flat = flatAxisOf(source);
  this->FlatAxis = flat;
  const double depth = flat < 0 ? 0 : depthOf(source, flat);
  this->Grid.clear();
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
bool vtkRefractiveIndex::CanUsePieces()
{
  const int* given = this->SamplingDimensions;
  return std::all_of(given, given + 3, isZero) && !SamplingBox::isWanted(this->SamplingBounds) &&
    this->Symmetry == NO_SYMMETRY; // a plane is small
}

//------------------------------------------------------------------------------
std::shared_ptr<const schlieren::MediumSource> vtkRefractiveIndex::MakeSourceOfPieces(
  InputsOfRanks& inputs, vtkDataObject* bodies, std::string& warning, SourceContents contents,
  int instant)
{
  this->Grid.clear();
  this->FlatAxis = -1;
  this->LeaveMesh();
  MadeOverRanks made;
  try
  {
    made = inputs.make(bodies, contents == WITH_FIELDS, instant);
  }
  catch (const std::runtime_error&)
  {
    if (this->GetAbortExecute())
    {
      return nullptr;
    }
    throw;
  }
  Source source;
  source.model = modelFrom(this);
  source.noteOnGases = noteOnGases(this);
  source.label = made.label;
  if (!made.hasGas)
  {
    throw std::runtime_error(noGas(source));
  }
  warning = warningFrom(source.model, made.tally);
  if (bodies && !made.meetsBodies)
  {
    addText(warning, bodiesAreOutside);
  }
  addText(warning, this->NewNoteOnValues(source));
  addText(warning, this->NewNoteOnGases(source));
  return made.source;
}
