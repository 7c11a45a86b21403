// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Sources/RevolvedSource.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace filters
{

namespace
{

/// Rows of N per voxel: cubic interpolation between them errs less than a brick's spline.
constexpr double rowsPerVoxel = 2;

constexpr double notANumber = std::numeric_limits<double>::quiet_NaN();

} // namespace

/// A lattice of the section with rows at r = (first + k) spacing, common to neighbouring lattices.
struct RevolvedSource::Rows
{
  double spacing;
  std::int64_t first;
  std::size_t columns, rows;
  bool areRows; // whether the section's x is along the axis, so that rows are contiguous
  std::vector<double> values;
  std::vector<schlieren::Place> places;
  std::vector<float> distances;

  std::size_t at(std::size_t column, std::size_t row) const
  {
    return this->areRows ? row * this->columns + column : column * this->rows + row;
  }
  /// Returns the row before a radius, and the distance from it in rows.
  std::pair<std::size_t, double> before(double r) const
  {
    const double row = r / this->spacing - static_cast<double>(this->first);
    const double whole = std::clamp(std::floor(row), 1., static_cast<double>(this->rows) - 3);
    return { static_cast<std::size_t>(whole), row - whole };
  }
  double valueAt(std::size_t column, double r) const
  {
    const auto [row, t] = this->before(r);
    std::array<double, 4> four;
    bool areAll = true;
    for (std::size_t i = 0; i < 4; ++i)
    {
      const std::size_t point = this->at(column, row + i - 1);
      four[i] = this->places[point] == schlieren::Place::Gas ? this->values[point] : notANumber;
      areAll = areAll && std::isfinite(four[i]);
    }
    if (areAll)
    {
      return four[1] +
        0.5 * t *
        (four[2] - four[0] +
          t *
            (2 * four[0] - 5 * four[1] + 4 * four[2] - four[3] +
              t * (3 * (four[1] - four[2]) + four[3] - four[0])));
    }
    // Interpolates from the rows on its side of a wall, or copies the nearest one.
    if (std::isfinite(four[1]) && std::isfinite(four[2]))
    {
      return (1 - t) * four[1] + t * four[2];
    }
    if (std::isfinite(four[1]))
    {
      return std::isfinite(four[0]) ? four[1] + t * (four[1] - four[0]) : four[1];
    }
    if (std::isfinite(four[2]))
    {
      return std::isfinite(four[3]) ? four[2] + (1 - t) * (four[2] - four[3]) : four[2];
    }
    for (std::size_t far = 1; far < this->rows; ++far)
    {
      for (const bool isAfter : { false, true })
      {
        if (isAfter ? row + far < this->rows : row >= far)
        {
          const std::size_t point = this->at(column, isAfter ? row + far : row - far);
          if (this->places[point] == schlieren::Place::Gas && std::isfinite(this->values[point]))
          {
            return this->values[point];
          }
        }
      }
    }
    return notANumber;
  }
};

RevolvedSource::RevolvedSource(
  std::shared_ptr<const schlieren::MediumSource> section, const Revolution& revolution)
  : Section(std::move(section))
  , Of(revolution)
  , Along(revolution.axis < revolution.radial
        ? 0
        : 1) // see directionAcross(): the others keep their order
  , Away(1 - this->Along)
  , BoundsOfSection(this->Section->bounds())
{
}

std::array<double, 3> RevolvedSource::voxelShape() const
{
  const std::array<double, 3> ofSection = this->Section->voxelShape();
  std::array<double, 3> shape;
  shape.fill(ofSection[this->Away]);
  shape[static_cast<std::size_t>(this->Of.axis)] = ofSection[this->Along];
  return shape;
}

/// Returns the bounds of a box turned into the half plane.
schlieren::Box RevolvedSource::sectionOf(const schlieren::Box& box) const
{
  schlieren::Box section = this->BoundsOfSection;
  const auto axis = static_cast<std::size_t>(this->Of.axis);
  double nearest = 0, farthest = 0; // squares of radii
  for (std::size_t i = 0; i < 3; ++i)
  {
    if (i == axis)
    {
      continue;
    }
    const double low = box.low[i] - this->Of.origin[i], high = box.high[i] - this->Of.origin[i];
    const double least = low > 0 ? low : (high < 0 ? high : 0);
    const double most = std::max(std::abs(low), std::abs(high));
    nearest += least * least;
    farthest += most * most;
  }
  const double from = this->Of.origin[static_cast<std::size_t>(this->Of.radial)];
  section.low[this->Along] = box.low[axis];
  section.high[this->Along] = box.high[axis];
  section.low[this->Away] = from + std::sqrt(nearest);
  section.high[this->Away] = from + std::sqrt(farthest);
  return section;
}

schlieren::MediumSource::Content RevolvedSource::contentOf(const schlieren::Box& box) const
{
  Content content = this->Section->contentOf(this->sectionOf(box));
  const std::array<double, 3> ofSection = content.cellSize;
  content.cellSize.fill(ofSection[this->Away]);
  content.cellSize[static_cast<std::size_t>(this->Of.axis)] = ofSection[this->Along];
  content.areWallsFlat = false; // they are curved
  return content;
}

RevolvedSource::Rows RevolvedSource::rowsFor(const schlieren::Lattice& lattice, double spacing,
  double nearest, double farthest, bool hasDistances) const
{
  const auto axis = static_cast<std::size_t>(this->Of.axis);
  Rows rows;
  rows.spacing = spacing;
  rows.first = static_cast<std::int64_t>(std::floor(nearest / spacing)) - 1;
  rows.rows = static_cast<std::size_t>(
    static_cast<std::int64_t>(std::floor(farthest / spacing)) + 3 - rows.first);
  rows.columns = static_cast<std::size_t>(lattice.points[axis]);
  rows.areRows = this->Along == 0;
  schlieren::Lattice ofSection;
  ofSection.points = { 1, 1, 1 };
  ofSection.points[this->Along] = lattice.points[axis];
  ofSection.points[this->Away] = static_cast<int>(rows.rows);
  ofSection.spacing[this->Along] = lattice.spacing[axis];
  ofSection.spacing[this->Away] = spacing;
  ofSection.spacing[2] = std::max(lattice.spacing[axis], spacing);
  ofSection.first[this->Along] = lattice.first[axis];
  ofSection.first[this->Away] = this->Of.origin[static_cast<std::size_t>(this->Of.radial)] +
    static_cast<double>(rows.first) * spacing;
  ofSection.first[2] = 0.5 * (this->BoundsOfSection.low[2] + this->BoundsOfSection.high[2]);
  const auto size = static_cast<std::size_t>(ofSection.size());
  rows.places.resize(size);
  rows.values.resize(size);
  rows.distances.resize(hasDistances ? size : 0);
  this->Section->sample(ofSection, rows.values.data(), rows.places.data(),
    hasDistances ? rows.distances.data() : nullptr);
  return rows;
}

void RevolvedSource::sample(const schlieren::Lattice& lattice, double* refractivity,
  schlieren::Place* places, float* distances) const
{
  const auto axis = static_cast<std::size_t>(this->Of.axis);
  const std::size_t b = axis == 0 ? 1 : 0, c = axis == 2 ? 1 : 2;
  const auto radiusAt = [&](int j, int k)
  {
    return std::hypot(lattice.first[b] + j * lattice.spacing[b] - this->Of.origin[b],
      lattice.first[c] + k * lattice.spacing[c] - this->Of.origin[c]);
  };
  double nearest = std::numeric_limits<double>::infinity(), farthest = 0;
  for (int k = 0; k < lattice.points[c]; ++k)
  {
    for (int j = 0; j < lattice.points[b]; ++j)
    {
      const double r = radiusAt(j, k);
      nearest = std::min(nearest, r);
      farthest = std::max(farthest, r);
    }
  }
  const double spacing = std::min(lattice.spacing[b], lattice.spacing[c]);
  // Gas points need no distances.
  const Rows ofValues = this->rowsFor(lattice, spacing / rowsPerVoxel, nearest, farthest, false);
  // Scales distances to spacings of the lattice.
  const Rows ofPlaces = this->rowsFor(lattice, spacing, nearest, farthest, true);
  const std::array<std::size_t, 3> strides{ 1, static_cast<std::size_t>(lattice.points[0]),
    static_cast<std::size_t>(lattice.points[0]) * static_cast<std::size_t>(lattice.points[1]) };
  for (int k = 0; k < lattice.points[c]; ++k)
  {
    for (int j = 0; j < lattice.points[b]; ++j)
    {
      const double r = radiusAt(j, k);
      const auto [row, t] = ofPlaces.before(r);
      for (std::size_t i = 0; i < ofPlaces.columns; ++i)
      {
        const std::size_t point = i * strides[axis] + static_cast<std::size_t>(j) * strides[b] +
          static_cast<std::size_t>(k) * strides[c];
        const std::size_t before = ofPlaces.at(i, row), after = ofPlaces.at(i, row + 1);
        float distance =
          static_cast<float>((1 - t) * ofPlaces.distances[before] + t * ofPlaces.distances[after]);
        schlieren::Place place = ofPlaces.places[t < 0.5 ? before : after];
        double value = 0;
        if (distance > 0)
        {
          value = ofValues.valueAt(i, r);
          place = std::isfinite(value) ? schlieren::Place::Gas : place;
        }
        if (place != schlieren::Place::Gas || !(distance > 0))
        {
          const schlieren::Place ofBefore = ofPlaces.places[before],
                                 ofAfter = ofPlaces.places[after];
          const bool isBefore =
            ofBefore != schlieren::Place::Gas && (t < 0.5 || ofAfter == schlieren::Place::Gas);
          place = isBefore                     ? ofBefore
            : ofAfter != schlieren::Place::Gas ? ofAfter
                                               : schlieren::Place::Window;
          distance = -std::max(std::abs(distance), 1.f / 4096);
          value = 0;
        }
        else
        {
          distance = std::max(distance, 1.f / 4096);
        }
        places[point] = place;
        refractivity[point] = value;
        if (distances)
        {
          distances[point] = distance;
        }
      }
    }
  }
}

} // namespace filters
