// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Wavefront/Aperture.h"

#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkImageEuclideanDistance.h"
#include "vtkNew.h"
#include "vtkPointData.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace filters
{

namespace
{

/// For each line of pixels, the first and the last one that `has` names.
struct Ends
{
  template <class Has>
  Ends(int lines, int length, const Has& has)
    : first(static_cast<std::size_t>(lines), length)
    , last(static_cast<std::size_t>(lines), -1)
  {
    for (int line = 0; line < lines; ++line)
    {
      for (int at = 0; at < length; ++at)
      {
        if (has(line, at))
        {
          const auto l = static_cast<std::size_t>(line);
          this->first[l] = std::min(this->first[l], at);
          this->last[l] = at;
        }
      }
    }
  }

  bool surround(int line, int at) const
  {
    const auto l = static_cast<std::size_t>(line);
    return this->first[l] <= at && at <= this->last[l];
  }

  std::vector<int> first, last;
};

/// The side of the largest square of lit pixels whose last column and row these are, for each pixel.
std::vector<double> sidesOfSquares(const LitPixels& pixels)
{
  const auto columns = static_cast<std::size_t>(pixels.columns);
  std::vector<double> sides(pixels.isLit.begin(), pixels.isLit.end());
  for (std::size_t i = columns; i < sides.size(); ++i)
  {
    if (sides[i] > 0 && i % columns > 0)
    {
      sides[i] = 1 + std::min({ sides[i - 1], sides[i - columns], sides[i - columns - 1] });
    }
  }
  return sides;
}

/// The diameter of the largest circle of lit pixels around each pixel.
std::vector<double> diametersOfCircles(const LitPixels& pixels)
{
  vtkNew<vtkImageData> lit; // with a frame, beyond which no pixel is lit
  lit->SetDimensions(pixels.columns + 2, pixels.rows + 2, 1);
  lit->AllocateScalars(VTK_DOUBLE, 1);
  lit->GetPointData()->GetScalars()->Fill(0);
  const auto forPixels = [&](const auto& use)
  {
    std::size_t i = 0;
    for (int row = 0; row < pixels.rows; ++row)
    {
      for (int column = 0; column < pixels.columns; ++column)
      {
        use(i++, column + 1, row + 1);
      }
    }
  };
  forPixels([&](std::size_t i, int column, int row)
    { lit->SetScalarComponentFromDouble(column, row, 0, 0, pixels.isLit[i]); });
  vtkNew<vtkImageEuclideanDistance> distance;
  distance->SetInputData(lit);
  distance->SetDimensionality(2);
  distance->ConsiderAnisotropyOff();
  distance->Update();
  std::vector<double> diameters(pixels.isLit.size());
  forPixels(
    [&](std::size_t i, int column, int row)
    {
      const double square = distance->GetOutput()->GetScalarComponentAsDouble(column, row, 0, 0);
      diameters[i] = square > 0 ? 2 * std::sqrt(square) - 1 : 0;
    });
  return diameters;
}

} // namespace

bool Aperture::has(int ofColumn, int ofRow) const
{
  const double x = std::abs(ofColumn - this->column), y = std::abs(ofRow - this->row);
  const double distance = this->shape == ApertureShape::Round ? std::hypot(x, y) : std::max(x, y);
  constexpr double rounding = 1e-9; // of coordinates in data units
  return distance <= 0.5 * this->diameter * (1 + rounding);
}

LitPixels litPixelsOf(vtkImageData* image, const std::vector<double>& path)
{
  LitPixels pixels{ image->GetDimensions()[0], image->GetDimensions()[1], {} };
  vtkDataArray* blocked = image->GetPointData()->GetArray("BlockedFraction");
  const auto isBlocked = [&](std::size_t i)
  { return blocked && blocked->GetComponent(static_cast<vtkIdType>(i), 0) > 0; };
  const auto isInData = [&](int column, int row)
  {
    const std::size_t i = static_cast<std::size_t>(row) * static_cast<std::size_t>(pixels.columns) +
      static_cast<std::size_t>(column);
    return path[i] != 0 || isBlocked(i);
  };
  const Ends ofRows(
    pixels.rows, pixels.columns, [&](int row, int column) { return isInData(column, row); });
  const Ends ofColumns(pixels.columns, pixels.rows, isInData);
  for (int row = 0; row < pixels.rows; ++row)
  {
    for (int column = 0; column < pixels.columns; ++column)
    {
      const std::size_t i = pixels.isLit.size();
      pixels.isLit.push_back(std::isfinite(path[i]) && !isBlocked(i) &&
        ofRows.surround(row, column) && ofColumns.surround(column, row));
    }
  }
  return pixels;
}

Aperture largestAperture(const LitPixels& pixels, ApertureShape shape)
{
  const bool isRound = shape == ApertureShape::Round;
  const std::vector<double> sizes = isRound ? diametersOfCircles(pixels) : sidesOfSquares(pixels);
  Aperture best{ shape, 0, 0, 0 };
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < sizes.size(); ++i)
  {
    const auto columns = static_cast<std::size_t>(pixels.columns);
    const double back = isRound ? 0 : 0.5 * (sizes[i] - 1); // to the middle of the square
    const double column = static_cast<double>(i % columns) - back,
                 row = static_cast<double>(i / columns) - back;
    const double away =
      std::hypot(column - 0.5 * (pixels.columns - 1), row - 0.5 * (pixels.rows - 1));
    if (sizes[i] > best.diameter || (sizes[i] == best.diameter && away < least))
    {
      best = { shape, column, row, sizes[i] };
      least = away;
    }
  }
  return best;
}

} // namespace filters
