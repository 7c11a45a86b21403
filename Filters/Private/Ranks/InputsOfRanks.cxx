// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Ranks/InputsOfRanks.h"

#include "Gas/ArrayChoice.h"
#include "Gas/GasChoices.h"
#include "Input/Flow.h"
#include "Input/GatheredData.h"
#include "Input/InputDescription.h"
#include "Ranks/ChoiceOverRanks.h"
#include "Ranks/PiecesOfRanks.h"
#include "Sources/MediumMaker.h"

#include "vtkAlgorithm.h"
#include "vtkDataObject.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"

#include <algorithm>
#include <map>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <utility>

namespace filters
{

namespace
{

/// The first bytes of requests, different from those of SamplesOverRanks and RayWorker.
enum Kind : std::uint32_t
{
  ShareArrays = 10,
  Locate, ///< an input
  Gather, ///< an input
  Make,   ///< a source
  Use,    ///< a source that another filter of the rank may have
  Release
};

/// Ratio of images to meshes: images take about 10 bytes per point and less time, meshes about 200;
/// and an image on rank 0 keeps its own grid, which is exact.
constexpr double cellsOfImageForOne = 160;

std::vector<char> requestOf(Kind kind)
{
  std::vector<char> request;
  put(kind, request);
  return request;
}

std::string absenceOf(const Ranks& ranks)
{
  return "Rank " + std::to_string(ranks.rank()) + " of " + std::to_string(ranks.count()) +
    " has no input, because something upstream of this filter has failed there. See what that "
    "rank has reported, or use one process.";
}

/// Numbers the sources of all filters of this rank.
class Sources
{
public:
  void add(const std::shared_ptr<const SamplesOverRanks>& source)
  {
    const std::lock_guard<std::mutex> lock(this->One);
    for (auto entry = this->All.begin(); entry != this->All.end();)
    {
      entry = entry->second.expired() ? this->All.erase(entry) : std::next(entry);
    }
    this->All[source->number()] = source;
  }
  std::shared_ptr<const SamplesOverRanks> find(std::uint64_t number)
  {
    const std::lock_guard<std::mutex> lock(this->One);
    const auto found = this->All.find(number);
    return found == this->All.end() ? nullptr : found->second.lock();
  }
  std::uint64_t newNumber()
  {
    const std::lock_guard<std::mutex> lock(this->One);
    return ++this->Last;
  }

private:
  std::mutex One;
  std::map<std::uint64_t, std::weak_ptr<const SamplesOverRanks>> All;
  std::uint64_t Last = 0;
};

Sources& sources()
{
  static Sources all;
  return all;
}

} // namespace

bool InputsOfRanks::begin(vtkAlgorithm* filter, vtkInformationVector** inputs, bool isWanted)
{
  std::vector<double> description;
  for (int port = 0; port < filter->GetNumberOfInputPorts(); ++port)
  {
    vtkDataObject* data = vtkDataObject::GetData(inputs[port]);
    vtkInformation* info = data ? data->GetInformation() : nullptr;
    description.push_back(static_cast<double>(upstreamTime(filter, port)));
    description.push_back(info && info->Has(vtkDataObject::DATA_TIME_STEP())
        ? info->Get(vtkDataObject::DATA_TIME_STEP())
        : 0);
    for (const int kind : { vtkDataObject::POINT, vtkDataObject::CELL })
    {
      description.push_back(data ? static_cast<double>(data->GetNumberOfElements(kind)) : 0);
    }
  }
  const bool lacksInput = std::exchange(this->LacksInput, false);
  return this->All.begin(description, lacksInput ? absenceOf(this->All.all()) : "", isWanted);
}

void InputsOfRanks::setOwn(MediumMaker& maker, vtkDataObject* data, vtkDataObject* bodies)
{
  this->Maker = &maker;
  this->Own = { data, bodies };
}

void InputsOfRanks::forgetOwn()
{
  this->Maker = nullptr;
  this->Own = {};
}

/// Requests work of all ranks, which rank 0 does meanwhile, too.
void InputsOfRanks::requestOfAll(const std::vector<char>& message)
{
  this->All.request(message, [&] { this->answer(message); });
}

void InputsOfRanks::shareArrays()
{
  if (this->All.areSeveral() && isOpen(this->Maker->settings))
  {
    this->requestOfAll(requestOf(ShareArrays));
  }
}

InputsOfRanks::Inputs InputsOfRanks::gather(double maxCells)
{
  const Inputs own{ this->Own[0], this->Own[1] };
  if (!this->All.areSeveral())
  {
    return own;
  }
  const std::vector<std::string> arrays = arraysOf(this->Maker->choice().settings);
  const auto hasArray = [this](const std::string& name)
  {
    return std::find(this->GatheredArrays.begin(), this->GatheredArrays.end(), name) !=
      this->GatheredArrays.end();
  };
  const bool isKnown = this->GatheredVersion == this->All.version() &&
    this->GatheredMost == maxCells &&
    (!this->Gathered[0] || std::all_of(arrays.begin(), arrays.end(), hasArray));
  if (!isKnown)
  {
    this->GatheredVersion = -1;
    this->Gathered = {};
    for (const int port : { 0, 1 })
    {
      std::vector<char> request = requestOf(Locate);
      put(port, request);
      this->requestOfAll(request);
    }
    const Located& data = this->Places[0];
    const double ofImages =
      data.kind == static_cast<int>(PiecesOfRanks::Kind::Image) ? cellsOfImageForOne : 1;
    this->InPieces = data.kind != static_cast<int>(PiecesOfRanks::Kind::Gathered) &&
      !data.isOnRank0 && data.cells / ofImages > maxCells;
    for (const int port : { 0, 1 })
    {
      if (!this->Places[static_cast<std::size_t>(port)].isOnRank0 && (port == 1 || !this->InPieces))
      {
        std::vector<char> request = requestOf(Gather);
        put(port, request);
        this->requestOfAll(request);
      }
    }
    this->GatheredArrays = arrays;
    this->GatheredVersion = this->All.version();
    this->GatheredMost = maxCells;
  }
  return { this->gatheredOf(0, own.data), this->gatheredOf(1, own.bodies) };
}

vtkDataObject* InputsOfRanks::gatheredOf(int port, vtkDataObject* own) const
{
  vtkDataObject* gathered = this->Gathered[static_cast<std::size_t>(port)];
  return gathered && own ? gathered : own;
}

std::shared_ptr<const schlieren::MediumSource> InputsOfRanks::make(
  vtkDataObject* bodies, std::string& warning)
{
  std::vector<char> ofBodies;
  if (bodies)
  {
    for (const DatasetPiece& piece : piecesOf(bodies, {}))
    {
      pack(piece, ofBodies);
    }
  }
  std::vector<char> request = requestOf(Make);
  put(sources().newNumber(), request);
  putAll(ofBodies, request);
  this->requestOfAll(request);
  const MediumChoice choice = this->Maker->choice();
  Flow flow;
  flow.model = modelFrom(choice.settings);
  flow.choice = choice;
  flow.notes = choice.warning;
  if (!this->Made.source)
  {
    throw std::runtime_error(noGas(this->Made.label));
  }
  this->Made.source->use(&this->All);
  warning =
    this->Maker->warningOf(flow, this->Made.tally, bodies && !this->Made.source->meetsBodies());
  return this->Made.source;
}

bool InputsOfRanks::use(const schlieren::MediumSource* source)
{
  const auto* ofRanks = dynamic_cast<const SamplesOverRanks*>(source);
  if (!ofRanks)
  {
    return true;
  }
  if (ofRanks->isUsedBy(&this->All) && this->Held.get() == ofRanks)
  {
    return true;
  }
  std::vector<char> request = requestOf(Use);
  put(ofRanks->number(), request);
  try
  {
    this->requestOfAll(request);
  }
  catch (const std::runtime_error&)
  {
    return false;
  }
  ofRanks->use(&this->All);
  return true;
}

void InputsOfRanks::release()
{
  if (this->All.areSeveral() && this->Held)
  {
    this->requestOfAll(requestOf(Release));
  }
}

std::vector<char> InputsOfRanks::answer(const std::vector<char>& request)
{
  Reader reader(request);
  const Ranks& ranks = this->All.all();
  switch (reader.Get<std::uint32_t>())
  {
    case ShareArrays:
      filters::shareArrays(ranks, *this->Maker, this->Own[0]);
      break;
    case Locate:
    case Gather:
    {
      const auto port = static_cast<std::size_t>(reader.Get<int>());
      const MediumSettings& settings = this->Maker->settings;
      PiecesOfRanks pieces(ranks, this->Own[port],
        port == 0 ? arraysOf(this->Maker->choice().settings) : std::vector<std::string>(),
        port == 0 && settings.mayBeWedge() ? std::optional(settings.symmetryOrigin())
                                           : std::nullopt);
      if (Reader(request).Get<std::uint32_t>() == Gather)
      {
        this->Gathered[port] = pieces.gather();
      }
      this->Places[port] = { pieces.cells(), static_cast<int>(pieces.kind()), pieces.areOnRank0() };
      break;
    }
    case Make:
    {
      const auto number = reader.Get<std::uint64_t>();
      const auto ofBodies = reader.GetAll<std::vector<char>>();
      this->Held = nullptr; // frees memory first
      this->Made = {};
      vtkSmartPointer<vtkDataObject> bodies;
      ranks.agree([&] { bodies = gatheredData({ ofBodies }); });
      this->Made = makeOverRanks(*this->Maker, ranks, this->Own[0], bodies, number, this->Cache);
      this->Held = this->Made.source;
      if (this->Held)
      {
        sources().add(this->Held);
      }
      break;
    }
    case Use:
      ranks.agree(
        [&]
        {
          this->Held = sources().find(reader.Get<std::uint64_t>());
          if (!this->Held)
          {
            throw std::runtime_error("A rank has no such source any more.");
          }
        });
      break;
    case Release:
      this->Held = nullptr;
      this->Made = {};
      this->Cache.release();
      break;
    case SamplesOverRanks::requestOfBricks:
      if (!this->Held || this->Held->number() != reader.Get<std::uint64_t>())
      {
        throw std::runtime_error(
          "A rank does not have its piece of the input any more. Update the filter again.");
      }
      return this->Held->answerBricks(reader);
    default:
      throw std::runtime_error("Rank 0 requests what this version of the plugin does not know. "
                               "Use the same version on all ranks.");
  }
  return {};
}

} // namespace filters
