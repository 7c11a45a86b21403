// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "MeshSearch.h"

#include "MeshKey.h"
#include "RefractivityValues.h"

#include "vtkDataSet.h"
#include "vtkDoubleArray.h"
#include "vtkImageData.h"
#include "vtkSMPTools.h"

#include <algorithm>
#include <exception>
#include <mutex>
#include <utility>

namespace filters
{

namespace
{

std::uint64_t keyOf(const std::vector<vtkDataSet*>& leaves, vtkImageData* grid)
{
  Hash hash;
  hash.add(grid->GetOrigin(), 3);
  hash.add(grid->GetSpacing(), 3);
  for (int axis = 0; axis < 3; ++axis)
  {
    hash.add(static_cast<std::uint64_t>(grid->GetDimensions()[axis]));
  }
  for (vtkDataSet* leaf : leaves)
  {
    addMesh(hash, leaf);
  }
  return hash.value();
}

/// Works on all pieces, on as many at once as there are threads. Whether it was left to finish.
template <class Work>
bool forPieces(int pieces, const Progress& progress, const Work& work)
{
  const int batch = std::max(1, 2 * vtkSMPTools::GetEstimatedNumberOfThreads());
  std::mutex one;
  std::exception_ptr problem; // mostly of memory: a thread must not end with it
  for (int first = 0; first < pieces; first += batch)
  {
    const int last = std::min(pieces, first + batch);
    vtkSMPTools::For(first, last, 1,
      [&](vtkIdType begin, vtkIdType end)
      {
        for (vtkIdType piece = begin; piece < end; ++piece)
        {
          try
          {
            work(static_cast<int>(piece));
          }
          catch (...)
          {
            const std::lock_guard<std::mutex> lock(one);
            problem = std::current_exception();
          }
        }
      });
    if (problem)
    {
      std::rethrow_exception(problem);
    }
    if (!progress(static_cast<double>(last) / pieces))
    {
      return false;
    }
  }
  return true;
}

} // namespace

void MeshSearch::release()
{
  this->places = std::vector<Places>();
  this->outside = nullptr;
}

bool sampleMeshes(const std::vector<vtkDataSet*>& leaves, vtkImageData* grid, int flatAxis,
  MeshSearch& search, const Progress& progress, vtkDoubleArray* values, vtkUnsignedCharArray* valid)
{
  MeshSampler sampler(leaves, grid, flatAxis);
  const std::uint64_t key = keyOf(leaves, grid);
  search.isSeries = search.key == key;
  search.key = key;
  if (!search.isSeries)
  {
    search.release();
  }
  const bool isFound = !search.places.empty();
  const bool isKept = !isFound && (search.isSeries || search.isNeededAgain) &&
    grid->GetNumberOfPoints() <= MeshSearch::maxPointsKept;
  std::vector<Places> found(isKept ? static_cast<std::size_t>(sampler.pieces()) : 0);
  if (!isFound)
  {
    ++search.count;
    sampler.sort(MeshSampler::Cells::Visible);
  }
  const bool isDone = forPieces(sampler.pieces(), progress,
    [&](int piece)
    {
      const auto here = static_cast<std::size_t>(piece);
      Places now;
      if (!isFound)
      {
        now = sampler.find(piece);
      }
      sampler.interpolate(
        piece, isFound ? search.places[here] : now, values->GetPointer(0), valid->GetPointer(0));
      if (isKept)
      {
        found[here] = std::move(now);
      }
    });
  if (isDone && isKept)
  {
    search.places = std::move(found);
  }
  return isDone;
}

vtkSmartPointer<vtkUnsignedCharArray> outsideOf(const std::vector<vtkDataSet*>& leaves,
  vtkImageData* grid, int flatAxis, MeshSearch& search, const Progress& progress,
  vtkUnsignedCharArray* valid)
{
  auto outside = newMask(grid->GetNumberOfPoints());
  if (search.outside)
  {
    outside->DeepCopy(search.outside); // which becomes part of an output
    return outside;
  }
  outside->SetName(transparentName);
  for (vtkIdType i = 0; i < outside->GetNumberOfValues(); ++i)
  {
    outside->SetValue(i, valid->GetValue(i) ? 0 : 1);
  }
  MeshSampler sampler(leaves, grid, flatAxis);
  sampler.sort(MeshSampler::Cells::Hidden);
  if (!forPieces(sampler.pieces(), progress,
        [&](int piece) { sampler.cover(piece, sampler.find(piece), outside->GetPointer(0)); }))
  {
    return nullptr;
  }
  if (!search.places.empty())
  {
    search.outside = vtkSmartPointer<vtkUnsignedCharArray>::New();
    search.outside->DeepCopy(outside);
  }
  return outside;
}

} // namespace filters
