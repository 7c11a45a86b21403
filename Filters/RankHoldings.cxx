// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "RankHoldings.h"

#include "InputDescription.h"
#include "MeshHalo.h"
#include "MeshKey.h"

#include "vtkBoundingBox.h"
#include "vtkDataSet.h"
#include "vtkDataSetAttributes.h"
#include "vtkIdList.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>

namespace filters
{

namespace ranks
{

namespace
{

/// Adds where a dataset is, and some of its points and cells.
void addPlaces(Hash& hash, vtkDataSet* data)
{
  const auto addPoint = [&](vtkIdType id)
  {
    double at[3];
    data->GetPoint(id, at);
    hash.add(at, 3);
  };
  const vtkIdType most = 200;
  const auto forSome = [most](vtkIdType count, const auto& add)
  {
    for (vtkIdType n = 0; n < std::min(count, most); ++n)
    {
      add(count <= most ? n : n * (count / most));
    }
  };
  double bounds[6];
  data->GetBounds(bounds);
  hash.add(bounds, 6);
  if (auto* image = vtkImageData::SafeDownCast(data))
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      hash.add(static_cast<std::uint64_t>(image->GetDimensions()[axis]));
    }
    return; // they say where all points are, and there may be very many blocks
  }
  forSome(data->GetNumberOfPoints(), addPoint);
  vtkNew<vtkIdList> points;
  forSome(data->GetNumberOfCells(),
    [&](vtkIdType cell)
    {
      data->GetCellPoints(cell, points);
      std::for_each(points->begin(), points->end(), addPoint);
    });
}

} // namespace

Holdings holdingsOf(vtkDataObject* input)
{
  Holdings holdings{};
  Hash places;
  vtkBoundingBox box;
  for (vtkDataObject* leaf : leavesOf(input))
  {
    auto* data = vtkDataSet::SafeDownCast(leaf);
    if (data && data->GetNumberOfPoints() > 0)
    {
      holdings[0] += static_cast<double>(data->GetNumberOfPoints());
      holdings[1] += static_cast<double>(data->GetNumberOfCells());
      if (vtkUnsignedCharArray* ghosts = data->GetCellGhostArray())
      {
        for (vtkIdType i = 0; i < ghosts->GetNumberOfValues(); ++i)
        {
          holdings[1] -= ghosts->GetValue(i) & vtkDataSetAttributes::DUPLICATECELL ? 1 : 0;
        }
      }
      box.AddBounds(data->GetBounds());
      addPlaces(places, data);
    }
  }
  if (box.IsValid())
  {
    box.GetBounds(holdings.data() + 2);
  }
  holdings[8] = static_cast<double>(places.value() >> 11); // exact
  return holdings;
}

InputsOfRank inputsOfRank(vtkDataObject* data, vtkDataObject* bodies)
{
  return { { holdingsOf(data), holdingsOf(bodies) }, pieceKindsOf(data) };
}

std::vector<Holdings> holdingsOf(std::size_t input, const std::vector<InputsOfRank>& ofRanks)
{
  std::vector<Holdings> holdings;
  for (const InputsOfRank& ofRank : ofRanks)
  {
    holdings.push_back(ofRank.holdings[input]);
  }
  return holdings;
}

std::vector<std::size_t> ranksWithMore(const std::vector<Holdings>& ofRanks)
{
  std::vector<std::size_t> more;
  const Holdings* first = nullptr;
  for (std::size_t rank = 0; rank < ofRanks.size(); ++rank)
  {
    const Holdings& holdings = ofRanks[rank];
    if (holdings[0] > 0 && (first == nullptr || holdings != *first))
    {
      more.push_back(rank);
      first = first == nullptr ? &holdings : first;
    }
  }
  return more;
}

bool hasRank0All(const std::vector<Holdings>& ofRanks)
{
  const std::vector<std::size_t> ranks = ranksWithMore(ofRanks);
  return ranks.empty() || ranks.back() == 0;
}

} // namespace ranks

} // namespace filters
