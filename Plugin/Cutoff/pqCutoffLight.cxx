// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "pqCutoffLight.h"

#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkPointData.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace
{

constexpr double nearlyAll = 0.999;

} // namespace

pqCutoffLight::pqCutoffLight(vtkImageData* histogram)
{
  vtkDataArray* rays = histogram ? histogram->GetPointData()->GetArray("Rays") : nullptr;
  const int size = rays ? histogram->GetDimensions()[0] : 0;
  if (size == 0 || histogram->GetDimensions()[1] != size || rays->GetRange()[1] <= 0)
  {
    return;
  }
  this->Size = size;
  this->BinWidth = histogram->GetSpacing()[0];
  this->Bins.resize(static_cast<std::size_t>(size) * size);
  const double scale = 1 / std::log1p(rays->GetRange()[1]);
  std::vector<double> inRing(size); // rays by radius in half bins
  double all = 0;
  for (int row = 0; row < size; ++row)
  {
    for (int column = 0; column < size; ++column)
    {
      const vtkIdType bin = static_cast<vtkIdType>(row) * size + column;
      const double count = rays->GetTuple1(bin);
      this->Bins[bin] = static_cast<float>(scale * std::log1p(count));
      inRing[std::max(std::abs(2 * row + 1 - size), std::abs(2 * column + 1 - size))] += count;
      all += count;
    }
  }
  double inside = 0;
  for (int ring = 0; ring < size && inside < nearlyAll * all; ++ring)
  {
    inside += inRing[ring];
    this->Extent = 0.5 * (ring + 1) * this->BinWidth;
  }
}

double pqCutoffLight::brightnessAt(const QPointF& deflection) const
{
  if (this->isEmpty())
  {
    return 0;
  }
  const double column = std::floor(deflection.x() / this->BinWidth + 0.5 * this->Size);
  const double row = std::floor(deflection.y() / this->BinWidth + 0.5 * this->Size);
  const bool isInside = column >= 0 && column < this->Size && row >= 0 && row < this->Size;
  return isInside ? this->Bins[static_cast<std::size_t>(row * this->Size + column)] : 0;
}
