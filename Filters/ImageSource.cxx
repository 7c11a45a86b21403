// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "ImageSource.h"

#include "AmrFaces.h"
#include "FieldFromImage.h"
#include "Medium/Solids.h"

#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace filters
{

namespace
{

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

/// Points along each edge of blocks whose ranges are known.
constexpr int blockEdge = 8;

/// The spline has more detail than voxels of the image's spacing show, as in AmrSource.
constexpr double cellBySpacing = 0.5;

/// Calls visit(i, j, k) for all points, x fastest.
template <class Visit>
void forPoints(const std::array<int, 3>& points, const Visit& visit)
{
  forCells({ 0, 0, 0 }, points, visit);
}

double valueAt(const schlieren::Field& field, std::size_t point)
{
  return field.singles ? static_cast<double>(field.singles[point]) : field.doubles[point];
}

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

/// A place in the axes that `direction` leads from.
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

/// Surfaces in these axes.
vtkSmartPointer<vtkDataObject> turnedBack(
  vtkDataObject* bodies, const std::array<double, 9>& direction)
{
  if (direction == schlieren::Grid{}.direction)
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

/// The median of what is known on the faces, or of all; NaN: nothing is.
double medianOf(const schlieren::Field& field, const std::vector<unsigned char>& isKnown,
  const std::array<int, 3>& points, bool onFaces)
{
  std::vector<double> used;
  std::size_t at = 0;
  forPoints(points,
    [&](int i, int j, int k)
    {
      const bool isOnFace = i == 0 || j == 0 || k == 0 || i == points[0] - 1 ||
        j == points[1] - 1 || k == points[2] - 1;
      if (isKnown[at] && (isOnFace || !onFaces))
      {
        used.push_back(valueAt(field, at));
      }
      ++at;
    });
  if (used.empty())
  {
    return nan;
  }
  const auto middle = used.begin() + static_cast<std::ptrdiff_t>(used.size() / 2);
  std::nth_element(used.begin(), middle, used.end());
  return *middle;
}

/// As the tracer takes it of a grid.
double ambientOf(const schlieren::Field& field, const std::vector<unsigned char>& isKnown,
  const std::array<int, 3>& points)
{
  const double ofFaces = medianOf(field, isKnown, points, true);
  return std::isnan(ofFaces) ? medianOf(field, isKnown, points, false) : ofFaces;
}

/// Of a quadratic B-spline (Unser, Aldroubi & Eden 1993): the first of three coefficients, and their weights.
struct Taps
{
  int first;
  double weights[3];

  explicit Taps(double place, int points)
  {
    const int nearest = std::clamp(static_cast<int>(std::lround(place)), 0, points - 1);
    const double t = place - nearest;
    this->first = nearest - 1;
    this->weights[0] = 0.5 * (0.5 - t) * (0.5 - t);
    this->weights[1] = 0.75 - t * t;
    this->weights[2] = 0.5 * (0.5 + t) * (0.5 + t);
  }
};

} // namespace

//------------------------------------------------------------------------------
ImageSource::Spline::Spline(const schlieren::Field& field,
  const std::vector<unsigned char>& isKnown, const std::array<int, 3>& points, int threads)
  : Offset(0)
  , Coefficients({ points[0], points[1], points[2] })
  , Blocks{ (points[0] - 1) / blockEdge + 1, (points[1] - 1) / blockEdge + 1,
    (points[2] - 1) / blockEdge + 1 }
  , Ranges(volume(this->Blocks), FieldRange{ infinity, -infinity })
{
  schlieren::PointMask unknown({ points[0], points[1], points[2] });
  std::fill(unknown.words.begin(), unknown.words.end(), 0);
  FieldRange all{ infinity, -infinity };
  std::size_t at = 0;
  const CellBox blocks{ { 0, 0, 0 }, this->Blocks };
  forPoints(points,
    [&](int i, int j, int k)
    {
      if (isKnown[at])
      {
        FieldRange& range = this->Ranges[blocks.index(i / blockEdge, j / blockEdge, k / blockEdge)];
        const double value = valueAt(field, at);
        range = { std::min(range.lowest, value), std::max(range.highest, value) };
        all = { std::min(all.lowest, value), std::max(all.highest, value) };
      }
      else
      {
        unknown.row(j, k)[i / 64] |= std::uint64_t{ 1 } << (i % 64);
      }
      ++at;
    });
  this->Offset = all.lowest <= all.highest ? 0.5 * (all.lowest + all.highest) : 0;
  at = 0;
  forPoints(points,
    [&](int i, int j, int k)
    {
      this->Coefficients.at(i, j, k) =
        isKnown[at] ? static_cast<float>(valueAt(field, at) - this->Offset) : 0.f;
      ++at;
    });
  if (unknown.any())
  {
    schlieren::fillEmpty(
      this->Coefficients, std::move(unknown), threads, schlieren::Continuation::Linear);
  }
  schlieren::prefilterQuadratic(this->Coefficients, threads);
  schlieren::fillGhosts(this->Coefficients, 2);
}

//------------------------------------------------------------------------------
void ImageSource::Spline::sample(
  const std::array<std::vector<double>, 3>& places, double* values) const
{
  std::array<std::vector<Taps>, 3> taps;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    for (const double place : places[axis])
    {
      taps[axis].emplace_back(place, static_cast<int>(this->Coefficients.dimensions[axis]));
    }
  }
  // Row by row: along y and z first, so that the rest is along one line.
  const int first = taps[0].front().first;
  std::vector<double> row(static_cast<std::size_t>(taps[0].back().first + 3 - first));
  for (const Taps& z : taps[2])
  {
    for (const Taps& y : taps[1])
    {
      std::fill(row.begin(), row.end(), 0.);
      for (int n = 0; n < 9; ++n)
      {
        const double weight = y.weights[n % 3] * z.weights[n / 3];
        const float* from = this->Coefficients.samples.data() +
          this->Coefficients.index(first, y.first + n % 3, z.first + n / 3);
        for (std::size_t i = 0; i < row.size(); ++i)
        {
          row[i] += weight * static_cast<double>(from[i]);
        }
      }
      for (const Taps& x : taps[0])
      {
        const double* of = row.data() + (x.first - first);
        *values++ =
          this->Offset + x.weights[0] * of[0] + x.weights[1] * of[1] + x.weights[2] * of[2];
      }
    }
  }
}

//------------------------------------------------------------------------------
schlieren::MediumSource::FieldRange ImageSource::Spline::rangeIn(
  const std::array<int, 3>& first, const std::array<int, 3>& last) const
{
  Counts begin, count;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    // One more on each side has a part in the spline.
    begin[axis] = std::max(0, (first[axis] - 1) / blockEdge);
    count[axis] = std::min(this->Blocks[axis] - 1, (last[axis] + 1) / blockEdge) + 1 - begin[axis];
  }
  FieldRange range{ infinity, -infinity };
  const CellBox blocks{ { 0, 0, 0 }, this->Blocks };
  forCells(begin, count,
    [&](int i, int j, int k)
    {
      const FieldRange& one = this->Ranges[blocks.index(i, j, k)];
      range = { std::min(range.lowest, one.lowest), std::max(range.highest, one.highest) };
    });
  return range;
}

//------------------------------------------------------------------------------
ImageSource::ImageSource(
  vtkImageData* refractivity, vtkDataObject* bodies, int threads, const WorkProgress& progress)
{
  const schlieren::Field field = fieldFrom(refractivity);
  const Point origin = turnedBack(field.grid.origin.data(), field.grid.direction);
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    this->Points[axis] = static_cast<int>(field.grid.dimensions[axis]);
    this->Origin[axis] = origin[axis];
  }
  this->Spacing = field.grid.spacing;
  this->Direction = field.grid.direction;
  const std::size_t count = volume(this->Points);
  this->IsKnown.assign(count, 1);
  for (std::size_t at = 0; at < count; ++at)
  {
    const schlieren::Place kind = kindAt(field, at);
    if (kind != schlieren::Place::Gas)
    {
      this->Kinds.resize(count, schlieren::Place::Gas);
      this->Kinds[at] = kind;
      this->IsKnown[at] = 0;
    }
  }
  progress.reach(0.2);
  const auto ownBodies = turnedBack(bodies, this->Direction);
  std::vector<unsigned char> isInBody;
  BodySurfaces(ownBodies).findInside({ this->Origin, this->Spacing, this->Points }, isInBody);
  for (std::size_t at = 0; at < isInBody.size(); ++at)
  {
    this->IsKnown[at] = this->IsKnown[at] && !isInBody[at] ? 1 : 0;
  }
  progress.reach(0.4);
  this->HasGas = std::find(this->IsKnown.begin(), this->IsKnown.end(), 1) != this->IsKnown.end();
  this->Ambient = ambientOf(field, this->IsKnown, this->Points);
  this->Refractivity = std::make_unique<const Spline>(field, this->IsKnown, this->Points, threads);
  progress.reach(0.8);
  this->Boundary =
    std::make_unique<const GasBoundary>(this->findFaces(), ownBodies, Outside::Passes);
}

//------------------------------------------------------------------------------
void ImageSource::addField(vtkImageData* image, int threads)
{
  const schlieren::Field field = fieldFrom(image);
  std::vector<unsigned char> isKnown = this->IsKnown;
  for (std::size_t at = 0; at < isKnown.size(); ++at)
  {
    isKnown[at] = isKnown[at] && kindAt(field, at) == schlieren::Place::Gas ? 1 : 0;
  }
  this->Fields.push_back(std::make_unique<const Spline>(field, isKnown, this->Points, threads));
}

//------------------------------------------------------------------------------
BoundaryFaces ImageSource::findFaces() const
{
  std::array<double, 3> corner{};
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    corner[axis] = this->Origin[axis] - 0.5 * this->Spacing[axis];
  }
  const CellBox all{ { 0, 0, 0 }, this->Points };
  const auto kindOf = [&](int i, int j, int k) { return this->Kinds[all.index(i, j, k)]; };
  AmrFaces faces(
    corner, { { this->Spacing, this->Points } },
    [&](std::size_t, const Counts& point)
    {
      switch (kindOf(point[0], point[1], point[2]))
      {
        case schlieren::Place::Gas:
          return CellState::Gas;
        case schlieren::Place::Wall:
          return CellState::Solid;
        default:
          return CellState::None;
      }
    },
    Extent::Volume);
  if (!this->Kinds.empty())
  {
    forPoints(this->Points,
      [&](int i, int j, int k)
      {
        if (const schlieren::Place kind = kindOf(i, j, k); kind != schlieren::Place::Gas)
        {
          faces.addAround(0, { i, j, k }, kind == schlieren::Place::Wall);
        }
      });
  }
  return faces.take();
}

//------------------------------------------------------------------------------
schlieren::Box ImageSource::bounds() const
{
  schlieren::Box box{ this->Origin, this->Origin };
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    box.high[axis] += (this->Points[axis] - 1) * this->Spacing[axis];
  }
  return box;
}

//------------------------------------------------------------------------------
double ImageSource::indexAt(double place, std::size_t axis) const
{
  return std::clamp((place - this->Origin[axis]) / this->Spacing[axis], 0.,
    static_cast<double>(this->Points[axis] - 1));
}

//------------------------------------------------------------------------------
std::size_t ImageSource::nearestPoint(const Point& place) const
{
  Counts nearest;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    nearest[axis] = static_cast<int>(std::lround(this->indexAt(place[axis], axis)));
  }
  return CellBox{ { 0, 0, 0 }, this->Points }.index(nearest[0], nearest[1], nearest[2]);
}

//------------------------------------------------------------------------------
std::array<std::vector<double>, 3> ImageSource::indicesOf(const schlieren::Lattice& lattice) const
{
  std::array<std::vector<double>, 3> indices;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    for (int i = 0; i < lattice.points[axis]; ++i)
    {
      indices[axis].push_back(this->indexAt(lattice.first[axis] + i * lattice.spacing[axis], axis));
    }
  }
  return indices;
}

//------------------------------------------------------------------------------
schlieren::MediumSource::FieldRange ImageSource::rangeOf(
  const Spline& values, const schlieren::Box& box) const
{
  Counts first, last;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    first[axis] = static_cast<int>(std::floor(this->indexAt(box.low[axis], axis)));
    last[axis] = static_cast<int>(std::ceil(this->indexAt(box.high[axis], axis)));
  }
  return values.rangeIn(first, last);
}

//------------------------------------------------------------------------------
schlieren::MediumSource::Content ImageSource::contentOf(const schlieren::Box& box) const
{
  Content content{ infinity, -infinity, { infinity, infinity, infinity }, false, true, false };
  this->Boundary->findPlaces(
    box,
    [this](const Point& place) {
      return this->Kinds.empty() || this->Kinds[this->nearestPoint(place)] == schlieren::Place::Gas;
    },
    content);
  if (content.hasGas)
  {
    const FieldRange range = this->rangeOf(*this->Refractivity, box);
    content.lowest = range.lowest;
    content.highest = range.highest;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      content.cellSize[axis] = cellBySpacing * this->Spacing[axis];
    }
  }
  return content;
}

//------------------------------------------------------------------------------
void ImageSource::sample(const schlieren::Lattice& lattice, double* refractivity,
  schlieren::Place* places, float* distances) const
{
  const std::array<std::vector<double>, 3> indices = this->indicesOf(lattice);
  this->Refractivity->sample(indices, refractivity);
  std::vector<unsigned char> hasGas(static_cast<std::size_t>(lattice.size()), 1);
  if (!this->Kinds.empty())
  {
    const CellBox all{ { 0, 0, 0 }, this->Points };
    std::size_t point = 0;
    forPoints(lattice.points,
      [&](int i, int j, int k)
      {
        const auto nearest = [&](std::size_t axis, int n)
        { return static_cast<int>(std::lround(indices[axis][static_cast<std::size_t>(n)])); };
        hasGas[point++] = this->Kinds[all.index(nearest(0, i), nearest(1, j), nearest(2, k))] ==
            schlieren::Place::Gas
          ? 1
          : 0;
      });
  }
  this->Boundary->sample(lattice, hasGas.data(), places, distances);
}

//------------------------------------------------------------------------------
schlieren::MediumSource::FieldRange ImageSource::rangeOfField(
  int field, const schlieren::Box& box) const
{
  return this->rangeOf(*this->Fields[static_cast<std::size_t>(field)], box);
}

//------------------------------------------------------------------------------
void ImageSource::sampleWithFields(const schlieren::Lattice& lattice, double* refractivity,
  schlieren::Place* places, float* distances, double* values) const
{
  this->sample(lattice, refractivity, places, distances);
  const std::array<std::vector<double>, 3> indices = this->indicesOf(lattice);
  const auto size = static_cast<std::size_t>(lattice.size());
  for (const auto& field : this->Fields)
  {
    field->sample(indices, values);
    for (std::size_t point = 0; point < size; ++point)
    {
      values[point] = places[point] == schlieren::Place::Gas ? values[point] : nan;
    }
    values += size;
  }
}

} // namespace filters
