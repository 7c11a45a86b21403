// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Sources/RevolvedImage.h"

#include "Common/AvailableMemory.h"
#include "Input/RefractivityValues.h"

#include "vtkDoubleArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkUnsignedCharArray.h"

#include "Schlieren.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace filters
{

namespace
{

constexpr double fewestPoints = 128, mostPoints = 256; // along the longest side

/// Returns the points of cubes about as large as the plane's cells.
schlieren::Lattice latticeFor(const schlieren::Box& box, const Choice& choice)
{
  double cells = 0;
  for (const Leaf& leaf : choice.flow.leaves)
  {
    cells += static_cast<double>(leaf.data->GetNumberOfCells());
  }
  const Revolution& revolution = *choice.revolution;
  const double edge =
    std::sqrt((revolution.high - revolution.low) * revolution.radius / std::max(1., cells));
  double longest = 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    longest = std::max(longest, box.high[axis] - box.low[axis]);
  }
  const double spacing =
    longest / (std::clamp(std::ceil(longest / edge) + 1, fewestPoints, mostPoints) - 1);
  schlieren::Lattice lattice;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double length = box.high[axis] - box.low[axis];
    lattice.points[axis] = std::max(2, 1 + static_cast<int>(std::lround(length / spacing)));
    lattice.first[axis] = box.low[axis];
    lattice.spacing[axis] = length / (lattice.points[axis] - 1);
  }
  return lattice;
}

} // namespace

void sampleRevolved(const schlieren::MediumSource& source, const Choice& choice,
  const WorkProgress& progress, vtkImageData* image)
{
  const schlieren::Lattice all = latticeFor(source.bounds(), choice);
  image->Initialize();
  image->SetDimensions(all.points.data());
  image->SetOrigin(all.first.data());
  image->SetSpacing(all.spacing.data());
  const vtkIdType layer = vtkIdType{ all.points[0] } * all.points[1];
  vtkNew<vtkDoubleArray> values;
  setTuples(values, image->GetNumberOfPoints());
  const auto valid = newMask(image->GetNumberOfPoints());
  const auto outside = newMask(image->GetNumberOfPoints());
  outside->SetName(transparentName);
  forChunks(
    all.points[2], progress,
    [&](vtkIdType begin, vtkIdType end)
    {
      schlieren::Lattice some = all;
      some.points[2] = static_cast<int>(end - begin);
      some.first[2] += static_cast<double>(begin) * all.spacing[2];
      std::vector<schlieren::Place> places(static_cast<std::size_t>(some.size()));
      source.sample(some, values->GetPointer(begin * layer), places.data(), nullptr);
      for (std::size_t i = 0; i < places.size(); ++i)
      {
        const vtkIdType at = begin * layer + static_cast<vtkIdType>(i);
        valid->SetValue(at, places[i] == schlieren::Place::Gas ? 1 : 0);
        outside->SetValue(at, places[i] == schlieren::Place::Window ? 1 : 0);
      }
    },
    8); // layers at a time: a constant, because samples may depend on the lattice
  setArrays(image, { values }, Linear(), valid, Numbers::Singles);
  setOutside(outside, image);
}

} // namespace filters
