// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Ranks/Ranks.h"

#include "Input/Flow.h"

#include "vtkAlgorithm.h"
#include "vtkDataObject.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMultiProcessController.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <exception>
#include <new>
#include <stdexcept>
#include <utility>

namespace filters
{

namespace
{

using Pipeline = vtkStreamingDemandDrivenPipeline;

/// Returns null for one process.
vtkMultiProcessController* controllerOfRanks()
{
  vtkMultiProcessController* controller = vtkMultiProcessController::GetGlobalController();
  return controller && controller->GetNumberOfProcesses() > 1 ? controller : nullptr;
}

/// Results of an attempt.
enum class Attempt : char
{
  Done,
  Failed,
  Lacking // arrays are missing
};

/// Maximum message size: MPI counts by int.
constexpr vtkIdType mostAtOnce = vtkIdType{ 1 } << 30;

/// Ends serve(); different from the requests of RayWorker and of filters.
constexpr std::uint32_t endOfWork = 1;

} // namespace

bool isRank0()
{
  vtkMultiProcessController* controller = controllerOfRanks();
  return !controller || controller->GetLocalProcessId() == 0;
}

bool hasOtherRanks() { return controllerOfRanks() != nullptr; }

void setComplete(vtkInformationVector* outputs)
{
  for (int port = 0; hasOtherRanks() && port < outputs->GetNumberOfInformationObjects(); ++port)
  {
    vtkInformation* outInfo = outputs->GetInformationObject(port);
    vtkInformation* dataInfo = vtkDataObject::GetData(outInfo)->GetInformation();
    dataInfo->Set(vtkDataObject::ALL_PIECES_EXTENT(), outInfo->Get(Pipeline::WHOLE_EXTENT()), 6);
    if (outInfo->Has(vtkDataObject::ALL_PIECES_EXTENT())) // the pipeline copies this one
    {
      outInfo->CopyEntry(dataInfo, vtkDataObject::ALL_PIECES_EXTENT());
    }
  }
}

void requestPiece(vtkInformation* inInfo)
{
  vtkDataObject* data = vtkDataObject::GetData(inInfo);
  if (inInfo->Has(Pipeline::WHOLE_EXTENT()) && data && data->GetExtentType() == VTK_3D_EXTENT)
  {
    // Requests the whole extent, which VTK divides by pieces.
    inInfo->Set(Pipeline::UPDATE_EXTENT(), inInfo->Get(Pipeline::WHOLE_EXTENT()), 6);
  }
  else
  {
    // Removes the key, which images upstream may have set.
    inInfo->Remove(Pipeline::UPDATE_EXTENT());
  }
  vtkMultiProcessController* controller = controllerOfRanks();
  inInfo->Set(Pipeline::UPDATE_PIECE_NUMBER(), controller ? controller->GetLocalProcessId() : 0);
  inInfo->Set(
    Pipeline::UPDATE_NUMBER_OF_PIECES(), controller ? controller->GetNumberOfProcesses() : 1);
  inInfo->Set(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS(), 0);
}

void requestPieces(vtkAlgorithm* filter, vtkInformationVector** inputs)
{
  for (int port = 0; port < filter->GetNumberOfInputPorts(); ++port)
  {
    if (vtkInformation* inInfo = inputs[port]->GetInformationObject(0))
    {
      requestPiece(inInfo);
    }
  }
}

Ranks::Bytes attempted(const std::function<Ranks::Bytes()>& make)
{
  Ranks::Bytes bytes;
  const auto fail = [&](Attempt how, const std::string& text)
  {
    bytes.clear();
    put(how, bytes);
    put(text.data(), text.size(), bytes);
  };
  try
  {
    bytes = make();
    bytes.push_back(static_cast<char>(Attempt::Done)); // at the end, so that no bytes are moved
    return bytes;
  }
  catch (const ArraysMissing& problem)
  {
    fail(Attempt::Lacking, problem.what());
  }
  catch (const std::bad_alloc&)
  {
    fail(Attempt::Failed,
      "There is not enough memory for a rank's part of the work. Use more nodes or a coarser "
      "input.");
  }
  catch (const std::exception& problem)
  {
    fail(Attempt::Failed, problem.what());
  }
  std::rotate(bytes.begin(), bytes.begin() + 1, bytes.end());
  return bytes;
}

std::vector<Ranks::Bytes> resultsOf(std::vector<Ranks::Bytes> attempts)
{
  std::string failed, lacking;
  for (Ranks::Bytes& bytes : attempts)
  {
    const auto how = static_cast<Attempt>(bytes.back());
    bytes.pop_back();
    std::string& text = how == Attempt::Lacking ? lacking : failed;
    if (how != Attempt::Done && text.empty())
    {
      text.assign(bytes.begin(), bytes.end());
    }
  }
  if (!failed.empty())
  {
    throw std::runtime_error(failed);
  }
  if (!lacking.empty())
  {
    throw ArraysMissing(lacking);
  }
  return attempts;
}

Ranks::Ranks()
  : Controller(controllerOfRanks())
{
}

std::size_t Ranks::count() const
{
  return this->Controller ? static_cast<std::size_t>(this->Controller->GetNumberOfProcesses()) : 1;
}

std::size_t Ranks::rank() const
{
  return this->Controller ? static_cast<std::size_t>(this->Controller->GetLocalProcessId()) : 0;
}

std::vector<Ranks::Bytes> Ranks::allGather(const std::function<Bytes()>& make) const
{
  Bytes own = attempted(make);
  if (!this->Controller)
  {
    return resultsOf({ std::move(own) });
  }
  Bytes together;
  for (const Bytes& one : this->gather(own, 0))
  {
    putAll(one, together);
  }
  this->broadcast(together);
  Reader reader(together);
  std::vector<Bytes> all;
  while (!reader.IsAtEnd())
  {
    all.push_back(reader.GetAll<Bytes>());
  }
  return resultsOf(std::move(all));
}

void Ranks::allGather(
  const std::function<Bytes()>& make, const std::function<void(Reader&)>& read) const
{
  for (const Bytes& bytes : this->allGather(make))
  {
    Reader reader(bytes);
    read(reader);
  }
}

void Ranks::agree(const std::function<void()>& work) const
{
  this->allGather(
    [&]
    {
      work();
      return Bytes();
    });
}

std::vector<Ranks::Bytes> Ranks::gather(const Bytes& own, std::size_t root) const
{
  if (!this->Controller)
  {
    return { own };
  }
  const std::size_t count = this->count();
  const int to = static_cast<int>(root);
  const auto size = static_cast<vtkIdType>(own.size());
  std::vector<vtkIdType> sizes(count);
  this->Controller->AllGather(&size, sizes.data(), 1);
  std::vector<Bytes> all;
  if (this->rank() == root)
  {
    for (const vtkIdType of : sizes)
    {
      all.emplace_back().reserve(static_cast<std::size_t>(of));
    }
  }
  const vtkIdType each = mostAtOnce / static_cast<vtkIdType>(count);
  const vtkIdType longest = *std::max_element(sizes.begin(), sizes.end());
  Bytes received;
  for (vtkIdType first = 0; first < longest; first += each)
  {
    std::vector<vtkIdType> lengths, offsets{ 0 };
    for (const vtkIdType of : sizes)
    {
      lengths.push_back(std::clamp<vtkIdType>(of - first, 0, each));
      offsets.push_back(offsets.back() + lengths.back());
    }
    received.resize(this->rank() == root ? static_cast<std::size_t>(offsets.back()) : 0);
    this->Controller->GatherV(own.data() + std::min(first, size), received.data(),
      lengths[this->rank()], lengths.data(), offsets.data(), to);
    for (std::size_t n = 0; n < all.size(); ++n)
    {
      all[n].insert(all[n].end(), received.begin() + offsets[n], received.begin() + offsets[n + 1]);
    }
  }
  return all;
}

void Ranks::broadcast(Bytes& bytes) const
{
  if (!this->Controller)
  {
    return;
  }
  auto size = static_cast<vtkIdType>(bytes.size());
  this->Controller->Broadcast(&size, 1, 0);
  bytes.resize(static_cast<std::size_t>(size));
  for (vtkIdType first = 0; first < size; first += mostAtOnce)
  {
    this->Controller->Broadcast(bytes.data() + first, std::min(mostAtOnce, size - first), 0);
  }
}

FilterRanks::FilterRanks()
  : Worker(static_cast<int>(this->All.rank()), static_cast<int>(this->All.count()))
{
}

bool FilterRanks::begin(
  const std::vector<double>& description, const std::string& problem, bool isWanted)
{
  if (!this->areSeveral())
  {
    if (!problem.empty())
    {
      throw std::runtime_error(problem);
    }
    return isWanted;
  }
  std::vector<Ranks::Bytes> all = this->All.allGather(
    [&]
    {
      if (!problem.empty() && isWanted)
      {
        throw std::runtime_error(problem);
      }
      Ranks::Bytes own;
      if (this->All.rank() == 0)
      {
        put(isWanted, own);
      }
      putAll(description, own);
      return own;
    });
  const bool isWantedByAll = Reader(all[0]).Get<bool>();
  all[0].erase(all[0].begin());
  if (all != this->Descriptions)
  {
    this->Descriptions = std::move(all);
    ++this->Version;
  }
  this->IsAtWork = isWantedByAll;
  return isWantedByAll;
}

std::vector<std::vector<char>> FilterRanks::request(
  const std::vector<char>& message, const std::function<void()>& meanwhile)
{
  if (!this->IsAtWork)
  {
    throw std::runtime_error("The other ranks do not work for this filter. Update it again.");
  }
  Ranks::Bytes bytes = message;
  this->All.broadcast(bytes);
  const Ranks::Bytes own = attempted(
    [&]
    {
      if (meanwhile)
      {
        meanwhile();
      }
      return Ranks::Bytes();
    });
  std::vector<Ranks::Bytes> answers = resultsOf(this->All.gather(own, 0));
  answers.erase(answers.begin());
  return answers;
}

FilterRanks::Outcome FilterRanks::serve(int threads, const Answer& answer)
{
  for (;;)
  {
    Ranks::Bytes request;
    this->All.broadcast(request);
    const std::uint32_t kind = schlieren::RayWorker::kindOf(request);
    if (kind == endOfWork)
    {
      Reader reader(request);
      reader.Get<std::uint32_t>();
      this->IsAtWork = false;
      return reader.Get<Outcome>();
    }
    this->All.gather(attempted(
                       [&]
                       {
                         return schlieren::RayWorker::isFor(kind)
                           ? this->Worker.answer(request, threads)
                           : answer(request);
                       }),
      0);
  }
}

void FilterRanks::end(const Outcome& outcome)
{
  if (this->areSeveral() && this->IsAtWork)
  {
    Ranks::Bytes message;
    put(endOfWork, message);
    put(outcome, message);
    this->All.broadcast(message);
  }
  this->IsAtWork = false;
}

} // namespace filters
