// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Gas/ArrayChoice.h"

#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkDataSetAttributes.h"

#include <algorithm>
#include <cstdint>
#include <utility>

namespace filters
{

void KnownArrays::Note(std::vector<FlowArray> arrays)
{
  if (!this->AreAll)
  {
    this->Arrays = std::move(arrays);
  }
}

void KnownArrays::SetOfRanks(std::vector<FlowArray> arrays)
{
  this->Arrays = std::move(arrays);
  this->AreAll = true;
}

void addArrays(std::vector<FlowArray>& all, const std::vector<FlowArray>& more)
{
  for (const FlowArray& array : more)
  {
    const auto same = std::find_if(all.begin(), all.end(),
      [&array](const FlowArray& other)
      { return other.name == array.name && other.association == array.association; });
    if (same == all.end())
    {
      all.push_back(array);
      continue;
    }
    same->components = std::max(same->components, array.components);
    same->range[0] = std::min(same->range[0], array.range[0]);
    same->range[1] = std::max(same->range[1], array.range[1]);
  }
}

std::vector<FlowArray> flowArraysOf(const std::vector<vtkDataSet*>& data, bool hasRanges)
{
  std::vector<FlowArray> all;
  for (vtkDataSet* set : data)
  {
    std::vector<FlowArray> ofSet;
    for (const FlowArray::Association association : { FlowArray::Points, FlowArray::Cells })
    {
      vtkDataSetAttributes* attributes = set->GetAttributes(association);
      for (int i = 0; i < attributes->GetNumberOfArrays(); ++i)
      {
        vtkDataArray* array = attributes->GetArray(i);
        if (!array || !array->GetName() || array->GetNumberOfTuples() == 0)
        {
          continue;
        }
        FlowArray described{ array->GetName(), association, array->GetNumberOfComponents(),
          { 0, 0 } };
        if (described.components == 1 && (hasRanges || dependsOnRange(described.name)))
        {
          array->GetFiniteRange(described.range.data(), 0);
        }
        ofSet.push_back(std::move(described));
      }
    }
    addArrays(all, ofSet);
  }
  return all;
}

void putArrays(const std::vector<FlowArray>& arrays, std::vector<char>& message)
{
  put(static_cast<std::uint64_t>(arrays.size()), message);
  for (const FlowArray& array : arrays)
  {
    putAll(array.name, message);
    put(array.association, message);
    put(array.components, message);
    put(array.range, message);
  }
}

std::vector<FlowArray> getArrays(Reader& message)
{
  std::vector<FlowArray> arrays;
  const auto count = message.Get<std::uint64_t>();
  for (std::uint64_t i = 0; i < count; ++i)
  {
    FlowArray& array = arrays.emplace_back();
    array.name = message.GetAll<std::string>();
    array.association = message.Get<FlowArray::Association>();
    array.components = message.Get<int>();
    array.range = message.Get<std::array<double, 2>>();
  }
  return arrays;
}

} // namespace filters
