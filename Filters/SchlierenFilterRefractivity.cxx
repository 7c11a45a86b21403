// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// What vtkSchlierenFilter makes of its inputs before there is a view.
#include "SchlierenFilterInternals.h"

#include "Gas/GasChoices.h"
#include "Image/SceneFromSettings.h"
#include "Input/InputDescription.h"
#include "Input/RefractivitySource.h"
#include "Settings/SelectionFromInformation.h"
#include "Sources/FieldTints.h"
#include "Sources/MediumMaker.h"

#include "vtkDataObject.h"
#include "vtkInformation.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

using namespace filters;

namespace
{

/// To a description of the filter's inputs; `bodies`: may be null.
void addBodies(std::vector<double>& description, vtkAlgorithm* filter, vtkDataObject* bodies)
{
  if (bodies)
  {
    const std::vector<double> ofBodies =
      describeInput(bodies, upstreamTime(filter, vtkRefractiveIndex::BODIES));
    description.insert(description.end(), ofBodies.begin(), ofBodies.end());
  }
}

} // namespace

//------------------------------------------------------------------------------
std::vector<double> vtkSchlierenFilter::DescribeInputs(vtkDataObject* input, vtkDataObject* bodies)
{
  InputsOfRanks& ranks = this->Inside->Ranks;
  // A source that makes less than was requested, as those that spread their data do, runs at each update.
  std::vector<double> description =
    describeInput(ranks.areInPieces() ? nullptr : input, upstreamTime(this, 0));
  description.push_back(ranks.areInPieces() ? ranks.ranks().version() : 0); // of what others have
  description.push_back(this->IsLargeImage(input));
  addBodies(description, this, bodies);
  return description;
}

//------------------------------------------------------------------------------
bool vtkSchlierenFilter::IsLargeImage(vtkDataObject* input) const
{
  auto* image = vtkImageData::SafeDownCast(input);
  const double bytes = image ? static_cast<double>(image->GetNumberOfPoints()) *
      (this->Medium->GetDoublePrecision() ? sizeof(double) : sizeof(float))
                             : 0;
  return bytes > static_cast<double>(this->MediumMemory) * (1 << 20);
}

//------------------------------------------------------------------------------
std::vector<double> vtkSchlierenFilter::DescribePieces(vtkDataObject* input, vtkDataObject* bodies)
{
  // Rank 0 may have none of the data.
  vtkInformation* info = input->GetInformation();
  std::vector<double> description = describeInput(input, upstreamTime(this, 0));
  description.push_back(
    info->Has(vtkDataObject::DATA_TIME_STEP()) ? info->Get(vtkDataObject::DATA_TIME_STEP()) : 0);
  addBodies(description, this, bodies);
  description.push_back(
    -1); // not those of data that rank 0 has: DescribeInputs() has no such number
  return description;
}

//------------------------------------------------------------------------------
void vtkSchlierenFilter::PassToMedium()
{
  this->Medium->SetNumberOfThreads(this->NumberOfThreads);
  // Otherwise another wavelength would make the same refractivity once more.
  if (usesWavelength(this->Medium->GetMaker().choice().settings))
  {
    this->Medium->SetWavelength(this->Wavelength);
  }
  for (int index = vtkRefractiveIndex::DENSITY; index <= vtkRefractiveIndex::MASK; ++index)
  {
    vtkInformation* selection = this->GetInputArrayInformation(index);
    if (!(selectionFrom(selection) == selectionFrom(this->Medium->GetInputArrayInformation(index))))
    {
      this->Medium->SetInputArrayToProcess(index, selection);
    }
  }
}

//------------------------------------------------------------------------------
bool vtkSchlierenFilter::UpdateRefractivity(vtkDataObject* input, vtkDataObject* bodies)
{
  Internals& inside = *this->Inside;
  this->PassToMedium();
  std::vector<double> description = this->DescribeInputs(input, bodies);
  if (inside.holdsRefractivityOf(description, this->Medium->GetSettings(), this->ColorByField) &&
    this->UseOwnRanks())
  {
    return true;
  }
  inside.MadeWith.reset();
  inside.FieldGradients.clear();
  this->Medium->AbortExecuteOff();
  inside.Refractivity = std::make_shared<MadeRefractivity>(); // what was, goes first
  inside.Grid.clear();
  const auto made = this->FindOrMakeRefractivity(input, bodies, description);
  if (!made)
  {
    return false;
  }
  inside.Refractivity = made;
  if (!made->Warning.empty())
  {
    vtkWarningMacro(<< made->Warning << noteOnView(*this, made->FlatAxis));
  }
  inside.Input = std::move(description);
  inside.MadeWith = this->Medium->GetSettings();
  return true;
}

//------------------------------------------------------------------------------
bool vtkSchlierenFilter::UseOwnRanks()
{
  return this->Inside->Ranks.use(this->Inside->Refractivity->Source.get());
}

//------------------------------------------------------------------------------
std::shared_ptr<const MadeRefractivity> vtkSchlierenFilter::FindOrMakeRefractivity(
  vtkDataObject* input, vtkDataObject* bodies, const std::vector<double>& description)
{
  const bool arePieces = this->Inside->Ranks.areInPieces();
  MediumMaker& maker = this->Medium->GetMaker();
  RefractivityKey key{ input, bodies, arePieces ? this->DescribePieces(input, bodies) : description,
    maker.choiceFor(input).settings, this->ColorByField };
  const std::shared_ptr<const MadeRefractivity> found = findRefractivity(key);
  if (found && this->Inside->Ranks.use(found->Source.get()))
  {
    if (!arePieces)
    {
      this->Inside->Ranks.release();
    }
    maker.setMesh(found->Mesh);
    return found;
  }
  std::shared_ptr<const MadeRefractivity> made = this->MakeRefractivity(input, bodies);
  if (made)
  {
    shareRefractivity(std::move(key), made);
  }
  return made;
}

//------------------------------------------------------------------------------
std::shared_ptr<const MadeRefractivity> vtkSchlierenFilter::MakeRefractivity(
  vtkDataObject* input, vtkDataObject* bodies)
{
  Internals& inside = *this->Inside;
  MediumMaker& maker = this->Medium->GetMaker();
  auto made = std::make_shared<MadeRefractivity>();
  try
  {
    const bool isLarge = this->IsLargeImage(input);
    if (inside.Ranks.areInPieces())
    {
      maker.forgetLast();
      made->Source = inside.Ranks.make(bodies, this->ColorByField, made->Warning);
    }
    else if (inside.Ranks.release(); maker.canMakeSource(input, bodies, isLarge))
    {
      made->Source = maker.makeSource(input, bodies, made->Warning, this->ColorByField);
      if (isLarge && !bodies)
      {
        addText(made->Warning,
          "The image's own grid would take more than MediumMemory, so its medium is a tree within "
          "MediumTolerance. Set MediumMemory higher for its own grid.");
      }
    }
    else
    {
      made->Warning = maker.convert(input, made->Image, bodies, Numbers::Differences);
      mergeMasks(made->Image);
    }
  }
  catch (const Stopped&)
  {
    return nullptr;
  }
  catch (const std::runtime_error&)
  {
    if (this->Medium->GetAbortExecute()) // on all ranks
    {
      return nullptr;
    }
    throw;
  }
  vtkTimeStamp now;
  now.Modified();
  made->SourceTime = now.GetMTime();
  made->Mesh = maker.mesh();
  made->Grid = maker.grid();
  made->FlatAxis = maker.flatAxis();
  return made;
}

//------------------------------------------------------------------------------
std::function<std::shared_ptr<const schlieren::MediumSource>()> vtkSchlierenFilter::OtherSource()
{
  Internals& inside = *this->Inside;
  if (!this->DataError || !inside.Refractivity->Source || inside.Ranks.areInPieces())
  {
    return {};
  }
  return [this]() -> std::shared_ptr<const schlieren::MediumSource>
  {
    const auto inputOf = [this](int port)
    { return this->Inside->Ranks.gatheredOf(port, this->GetInputDataObject(port, 0)); };
    try
    {
      return this->Medium->GetMaker().makeSourceOtherwise(inputOf(0),
        inputOf(vtkRefractiveIndex::BODIES),
        [this](double) { return this->GetAbortExecute() == 0; });
    }
    catch (const Stopped&)
    {
      return nullptr;
    }
  };
}

//------------------------------------------------------------------------------
void vtkSchlierenFilter::UpdateFieldGradients(vtkDataObject* input)
{
  Internals& inside = *this->Inside;
  if (!this->ColorByField || inside.Refractivity->Source)
  {
    inside.FieldGradients = std::vector<float>();
  }
  else if (inside.FieldGradients.empty())
  {
    inside.FieldGradients =
      fieldGradients(this->Medium->GetMaker(), input, inside.Refractivity->Image);
  }
}
