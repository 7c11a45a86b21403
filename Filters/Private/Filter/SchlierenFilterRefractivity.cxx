// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// What vtkSchlierenFilter makes of its inputs before there is a view.
#include "Filter/SchlierenFilterInternals.h"

#include "Common/Sentences.h"
#include "Gas/GasChoices.h"
#include "Guarded.h"
#include "Image/SceneFromSettings.h"
#include "Input/Flow.h"
#include "Input/InputDescription.h"
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
      describeInput(bodies, upstreamTime(filter, vtkFlowAlgorithm::BODIES));
    description.insert(description.end(), ofBodies.begin(), ofBodies.end());
  }
}

} // namespace

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

bool vtkSchlierenFilter::IsLargeImage(vtkDataObject* input) const
{
  auto* image = vtkImageData::SafeDownCast(input);
  const double bytes = image ? static_cast<double>(image->GetNumberOfPoints()) *
      (this->DoublePrecision ? sizeof(double) : sizeof(float))
                             : 0;
  return bytes > static_cast<double>(this->MediumMemory) * (1 << 20);
}

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

const Choice& vtkSchlierenFilter::Chosen(vtkDataObject* input)
{
  std::optional<Choice>& chosen = this->Inside->Chosen;
  if (!chosen)
  {
    chosen = this->GetMaker().choose(input);
  }
  return *chosen;
}

bool vtkSchlierenFilter::UpdateRefractivity(vtkDataObject* input, vtkDataObject* bodies)
{
  Internals& inside = *this->Inside;
  inside.Chosen.reset();
  std::vector<double> description = this->DescribeInputs(input, bodies);
  MediumSettings settings = this->GetMediumSettings();
  settings.Wavelength = MediumSettings().Wavelength; // without influence on a flow's size
  inside.DepthLock.For(K_AUTOMATIC, { inside.Time, description, std::move(settings), {}, {} });
  const double kept = inside.DepthLock.GetKept().value_or(0);
  if (inside.holdsRefractivityOf(description, this->GetMediumSettings()) &&
    kept == inside.KeptDepth && this->UseOwnRanks())
  {
    return true;
  }
  inside.MadeWith.reset();
  inside.Refractivity = std::make_shared<MadeRefractivity>(); // what was, goes first
  inside.Grid.clear();
  inside.KeptDepth = kept;
  const auto made = this->FindOrMakeRefractivity(input, bodies, description);
  if (!made)
  {
    return false;
  }
  inside.Refractivity = made;
  if (made->Depth > 0)
  {
    inside.DepthLock.Found(made->Depth);
  }
  if (!made->Warning.empty() && made->IsForMe("medium", this))
  {
    vtkWarningMacro(<< shortened(made->Warning) << noteOnView(*this, made->FlatAxis));
  }
  inside.Input = std::move(description);
  inside.UsesWavelength = usesWavelength(this->GetMaker().choice().settings);
  inside.MadeWith = inside.inUse(this->GetMediumSettings());
  return true;
}

bool vtkSchlierenFilter::UseOwnRanks()
{
  return this->Inside->Ranks.use(this->Inside->Refractivity->Source.get());
}

std::shared_ptr<const MadeRefractivity> vtkSchlierenFilter::FindOrMakeRefractivity(
  vtkDataObject* input, vtkDataObject* bodies, const std::vector<double>& description)
{
  const bool arePieces = this->Inside->Ranks.areInPieces();
  MediumMaker& maker = this->GetMaker();
  RefractivityKey key{ input, bodies, arePieces ? this->DescribePieces(input, bodies) : description,
    arePieces ? maker.choiceFor(input).settings : this->Chosen(input).flow.choice.settings };
  const std::shared_ptr<const MadeRefractivity> found = findRefractivity(key);
  if (found && this->Inside->Ranks.use(found->Source.get()))
  {
    if (!arePieces)
    {
      this->Inside->Ranks.release();
    }
    maker.setMesh(found->Mesh);
    maker.setSaid(found->Said);
    return found;
  }
  std::shared_ptr<const MadeRefractivity> made = this->MakeRefractivity(input, bodies);
  if (made)
  {
    cacheRefractivity(std::move(key), made);
  }
  return made;
}

std::shared_ptr<const MadeRefractivity> vtkSchlierenFilter::MakeRefractivity(
  vtkDataObject* input, vtkDataObject* bodies)
{
  Internals& inside = *this->Inside;
  MediumMaker& maker = this->GetMaker();
  try
  {
    if (inside.Ranks.areInPieces())
    {
      maker.forgetLast();
      auto made = std::make_shared<MadeRefractivity>();
      made->Source = inside.Ranks.make(bodies, made->Warning);
      vtkTimeStamp now;
      now.Modified();
      made->SourceTime = now.GetMTime();
      made->Mesh = maker.mesh();
      made->Said = maker.said();
      return made;
    }
    inside.Ranks.release();
    const Choice& choice = this->Chosen(input);
    const bool isLarge = this->IsLargeImage(input) && choice.flatAxis < 0;
    const auto made = maker.make(choice, bodies, isLarge);
    if (isLarge && choice.keepsGrid() && !bodies)
    {
      addText(made->Warning,
        "The image's own grid would take more than MediumMemory, so its medium is a tree within "
        "MediumTolerance. Set MediumMemory higher for its own grid.");
    }
    return made;
  }
  catch (const Stopped&)
  {
    return nullptr;
  }
  catch (const std::runtime_error&)
  {
    if (this->GetAbortExecute()) // on all ranks
    {
      return nullptr;
    }
    throw;
  }
}
