// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Sources/ImagePiece.h"

#include "Amr/AmrFaces.h"
#include "Common/FieldFromImage.h"
#include "Input/FlatBodies.h"
#include "Schlieren.h"
#include "Walls/BodySurfaces.h"

#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cmath>

namespace filters
{

namespace
{

/// Cell size in spacings: the spline has more detail than voxels of one spacing, as in AmrField.
constexpr double cellBySpacing = 0.5;

/// Tolerance of indices, so that points halfway between two ranks are not missed.
constexpr double rounding = 1e-6;

schlieren::Place kindAt(const schlieren::Field& field, std::size_t point)
{
  const unsigned char valid = field.valid ? field.valid[point] : 1;
  if (valid == schlieren::transparent)
  {
    return schlieren::Place::Window;
  }
  return valid != 0 && std::isfinite(valueAt(field, point)) ? schlieren::Place::Gas
                                                            : schlieren::Place::Wall;
}

/// Transforms a point to the axes that `direction` leads from.
Point turnedBack(const double* place, const std::array<double, 9>& direction)
{
  Point result;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    result[axis] =
      direction[axis] * place[0] + direction[3 + axis] * place[1] + direction[6 + axis] * place[2];
  }
  return result;
}

} // namespace

vtkSmartPointer<vtkDataObject> turnedBack(
  vtkDataObject* bodies, const std::array<double, 9>& direction)
{
  if (!bodies || direction == schlieren::Grid{}.direction)
  {
    return bodies;
  }
  return changedBodies(bodies,
    [&](vtkPolyData* surface)
    {
      vtkNew<vtkPoints> places;
      places->SetDataTypeToDouble();
      for (vtkIdType point = 0; point < surface->GetNumberOfPoints(); ++point)
      {
        double at[3];
        surface->GetPoint(point, at);
        places->InsertNextPoint(turnedBack(at, direction).data());
      }
      auto turned = vtkSmartPointer<vtkPolyData>::New();
      turned->ShallowCopy(surface);
      turned->SetPoints(places);
      return turned;
    });
}

ImagePiece::Extents ImagePiece::extentsOf(vtkImageData* whole)
{
  Extents extents{};
  whole->GetExtent(extents.whole.data());
  extents.own = extents.whole;
  return extents;
}

ImagePiece::ImagePiece(
  vtkImageData* refractivity, const Extents& extents, vtkDataObject* bodies, int threads)
{
  const schlieren::Field field = fieldFrom(refractivity);
  this->Spacing = field.grid.spacing;
  this->Direction = field.grid.direction;
  const Point origin = turnedBack(refractivity->GetOrigin(), this->Direction);
  int extent[6];
  refractivity->GetExtent(extent);
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    // Computes from the image's origin, which is equal on all ranks to the last bit.
    this->Origin[axis] = origin[axis] + extents.whole[2 * axis] * this->Spacing[axis];
    this->Whole[axis] = extents.whole[2 * axis + 1] + 1 - extents.whole[2 * axis];
    this->First[axis] = extent[2 * axis] - extents.whole[2 * axis];
    this->Points[axis] = extent[2 * axis + 1] + 1 - extent[2 * axis];
    this->Own.begin[axis] = extents.own[2 * axis] - extent[2 * axis];
    this->Own.end[axis] = extents.own[2 * axis + 1] + 1 - extent[2 * axis];
  }
  this->IsKnown = this->knownOf(field);
  if (std::find(this->IsKnown.begin(), this->IsKnown.end(), 0) != this->IsKnown.end())
  {
    this->Kinds.resize(this->IsKnown.size(), schlieren::Place::Gas);
    for (std::size_t at = 0; at < this->Kinds.size(); ++at)
    {
      this->Kinds[at] = kindAt(field, at);
    }
  }
  if (bodies)
  {
    Point first;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      first[axis] = this->Origin[axis] + this->First[axis] * this->Spacing[axis];
    }
    std::vector<unsigned char> isInBody;
    BodySurfaces(bodies).findInside({ first, this->Spacing, this->Points }, isInBody);
    for (std::size_t at = 0; at < isInBody.size(); ++at)
    {
      this->IsKnown[at] = this->IsKnown[at] && !isInBody[at] ? 1 : 0;
    }
  }
  this->findOuter(field);
  this->Spline =
    std::make_unique<const ImageSpline>(field, this->IsKnown, this->Points, this->First, threads);
}

/// Counts its known points, and finds those on the faces of the whole image.
void ImagePiece::findOuter(const schlieren::Field& field)
{
  forCells(this->Own.begin, this->Own.size(),
    [&](int i, int j, int k)
    {
      const std::size_t at = this->all().index(i, j, k);
      if (!this->IsKnown[at])
      {
        return;
      }
      ++this->KnownPoints;
      const Counts inWhole{ this->First[0] + i, this->First[1] + j, this->First[2] + k };
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        // Of two points, as of an extruded plane, all would be on the faces across the axis.
        const int last = this->Whole[axis] - 1;
        if (last > 1 && (inWhole[axis] == 0 || inWhole[axis] == last))
        {
          const CellBox whole{ { 0, 0, 0 }, this->Whole };
          this->Outer.push_back(
            { static_cast<std::int64_t>(whole.index(inWhole[0], inWhole[1], inWhole[2])),
              valueAt(field, at) });
          break;
        }
      }
    });
}

/// Returns whether the field has a value at each point.
std::vector<unsigned char> ImagePiece::knownOf(const schlieren::Field& field) const
{
  std::vector<unsigned char> isKnown(volume(this->Points), 1);
  for (std::size_t at = 0; at < isKnown.size(); ++at)
  {
    isKnown[at] = kindAt(field, at) == schlieren::Place::Gas ? 1 : 0;
  }
  return isKnown;
}

schlieren::Box ImagePiece::bounds() const
{
  schlieren::Box box{};
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    // Extends to its own points and halfway to those of others.
    const int first = this->First[axis] + this->Own.begin[axis];
    const int last = this->First[axis] + this->Own.end[axis] - 1;
    const double low = first > 0 ? first - 0.5 : 0;
    const double high = last < this->Whole[axis] - 1 ? last + 0.5 : last;
    box.low[axis] = this->Origin[axis] + low * this->Spacing[axis];
    box.high[axis] = this->Origin[axis] + high * this->Spacing[axis];
  }
  return box;
}

double ImagePiece::ambientOf(std::vector<OuterValue> values)
{
  std::sort(values.begin(), values.end(),
    [](const OuterValue& a, const OuterValue& b) { return a.point < b.point; });
  values.erase(std::unique(values.begin(), values.end(),
                 [](const OuterValue& a, const OuterValue& b) { return a.point == b.point; }),
    values.end());
  std::vector<schlieren::WeightedValue> weighted;
  for (const OuterValue& outer : values)
  {
    weighted.push_back({ outer.value, 1 });
  }
  return schlieren::ambientOf(std::move(weighted));
}

schlieren::Place ImagePiece::kindOf(const Counts& point) const
{
  return this->Kinds.empty() ? schlieren::Place::Gas
                             : this->Kinds[this->all().index(point[0], point[1], point[2])];
}

BoundaryFaces ImagePiece::faces() const
{
  std::array<double, 3> corner{};
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    corner[axis] = this->Origin[axis] - 0.5 * this->Spacing[axis];
  }
  AmrFaces faces(
    corner, { { this->Spacing, this->Whole } },
    [&](std::size_t, const Counts& point)
    {
      const schlieren::Place place = this->kindOf(
        { point[0] - this->First[0], point[1] - this->First[1], point[2] - this->First[2] });
      return place == schlieren::Place::Gas ? CellState::Gas
        : place == schlieren::Place::Wall   ? CellState::Solid
                                            : CellState::None;
    },
    Extent::Volume);
  if (!this->Kinds.empty())
  {
    // Selects the points whose neighbours are all in the piece.
    CellBox inner = this->Own;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const bool isFirst = this->First[axis] == 0;
      const bool isLast = this->First[axis] + this->Points[axis] == this->Whole[axis];
      inner.begin[axis] = std::max(inner.begin[axis], isFirst ? 0 : 1);
      inner.end[axis] = std::min(inner.end[axis], this->Points[axis] - (isLast ? 0 : 1));
    }
    forCells(inner.begin, inner.size(),
      [&](int i, int j, int k)
      {
        if (const schlieren::Place kind = this->kindOf({ i, j, k }); kind != schlieren::Place::Gas)
        {
          faces.addAround(0, { this->First[0] + i, this->First[1] + j, this->First[2] + k },
            kind == schlieren::Place::Wall);
        }
      });
  }
  return faces.take();
}

double ImagePiece::indexAt(double place, std::size_t axis) const
{
  const double inWhole = (place - this->Origin[axis]) / this->Spacing[axis];
  return std::clamp(inWhole, 0., static_cast<double>(this->Whole[axis] - 1)) - this->First[axis];
}

double ImagePiece::indexWithin(double place, std::size_t axis) const
{
  return std::clamp(this->indexAt(place, axis), 0., static_cast<double>(this->Points[axis] - 1));
}

Counts ImagePiece::nearestPoint(const Point& place) const
{
  Counts nearest;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    nearest[axis] = static_cast<int>(std::lround(this->indexAt(place[axis], axis)));
  }
  return nearest;
}

ImageSpline::Range ImagePiece::rangeOf(const schlieren::Box& box) const
{
  Counts first, last;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    first[axis] = static_cast<int>(std::floor(this->indexWithin(box.low[axis], axis)));
    last[axis] = static_cast<int>(std::ceil(this->indexWithin(box.high[axis], axis)));
  }
  return this->Spline->rangeIn(first, last);
}

void ImagePiece::sample(const schlieren::Lattice& lattice, double* refractivity,
  unsigned char* found, CellsOfLattice*) const
{
  constexpr int ofOthers = -1;
  std::array<std::vector<double>, 3> indices;
  std::array<std::vector<int>, 3> nearest;
  bool hasOwn = true;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    for (int i = 0; i < lattice.points[axis]; ++i)
    {
      const double place = lattice.first[axis] + i * lattice.spacing[axis];
      const double index = this->indexAt(place, axis);
      const bool isOwn =
        index >= this->Own.begin[axis] - 0.5 && index < this->Own.end[axis] - 0.5 + rounding;
      indices[axis].push_back(std::clamp(index, 0., this->Points[axis] - 1.));
      nearest[axis].push_back(
        isOwn ? static_cast<int>(std::lround(indices[axis].back())) : ofOthers);
    }
    hasOwn = hasOwn && *std::max_element(nearest[axis].begin(), nearest[axis].end()) != ofOthers;
  }
  forCells({ 0, 0, 0 }, lattice.points,
    [&](int i, int j, int k)
    {
      const Counts point{ nearest[0][static_cast<std::size_t>(i)],
        nearest[1][static_cast<std::size_t>(j)], nearest[2][static_cast<std::size_t>(k)] };
      const bool isOwn = *std::min_element(point.begin(), point.end()) != ofOthers;
      *found++ = isOwn && this->kindOf(point) == schlieren::Place::Gas ? 1 : 0;
    });
  if (!hasOwn)
  {
    return;
  }
  this->Spline->sample(indices, refractivity);
}

DataPiece::Facts ImagePiece::facts() const
{
  const schlieren::Box box = this->bounds();
  return { this->KnownPoints, box, this->contentOf(box), this->Spacing, this->Direction, false };
}

CellTree::Content ImagePiece::contentOf(const schlieren::Box& box) const
{
  const schlieren::Box own = this->bounds();
  schlieren::Box part{};
  CellTree::Content content{};
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    part.low[axis] = std::clamp(box.low[axis], own.low[axis], own.high[axis]);
    part.high[axis] = std::clamp(box.high[axis], own.low[axis], own.high[axis]);
    content.cellSize[axis] = cellBySpacing * this->Spacing[axis];
  }
  const ImageSpline::Range range = this->rangeOf(part);
  content.lowest = range.lowest;
  content.highest = range.highest;
  return content;
}

bool ImagePiece::holds(const Point& place) const
{
  // Accepts points halfway to other ranks' in both pieces.
  const Counts nearest = this->nearestPoint(place);
  bool isOwn = true;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    isOwn = isOwn && nearest[axis] >= this->Own.begin[axis] && nearest[axis] < this->Own.end[axis];
  }
  return isOwn && this->kindOf(nearest) == schlieren::Place::Gas;
}

} // namespace filters
