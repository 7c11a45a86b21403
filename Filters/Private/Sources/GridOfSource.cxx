// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Sources/GridOfSource.h"

#include "Common/AvailableMemory.h"
#include "Common/FieldFromImage.h"
#include "Input/RefractivityValues.h"

#include "vtkDoubleArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkSMPTools.h"
#include "vtkUnsignedCharArray.h"

#include "Schlieren.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace filters
{

namespace
{

/// Layers of a lattice sampled at once, a constant, because samples may depend on the lattice.
constexpr int layersAtATime = 8;

/// Maps the points of a grid to a lattice of a source, axis by axis.
struct LatticeOfGrid
{
  schlieren::Lattice lattice;
  std::array<vtkIdType, 3>
    strides{};         ///< of the grid, between neighbours of the lattice along each axis
  vtkIdType first = 0; ///< grid index of the lattice's first point
  int copies = 1;      ///< grid layers for each layer of the lattice
  vtkIdType copyStride = 0;
  std::size_t slow = 2; ///< axis across which it is divided into chunks

  LatticeOfGrid(const schlieren::MediumSource& source, vtkImageData* image)
  {
    const schlieren::Grid grid = gridFrom(image);
    const std::array<double, 9> direction = source.direction();
    vtkIdType stride = 1;
    std::array<double, 3> origin{};
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      for (std::size_t row = 0; row < 3; ++row)
      {
        origin[axis] += direction[3 * row + axis] * grid.origin[row];
      }
    }
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      // Finds the axis of the source along the grid's axis, within rounding.
      std::array<double, 3> along{};
      for (std::size_t own = 0; own < 3; ++own)
      {
        for (std::size_t row = 0; row < 3; ++row)
        {
          along[own] += direction[3 * row + own] * grid.direction[3 * row + axis];
        }
      }
      const auto own =
        static_cast<std::size_t>(std::max_element(along.begin(), along.end(),
                                   [](double a, double b) { return std::abs(a) < std::abs(b); }) -
          along.begin());
      const auto count = static_cast<int>(grid.dimensions[axis]);
      const bool isReversed = along[own] < 0;
      this->lattice.points[own] = count;
      this->lattice.spacing[own] = grid.spacing[axis];
      this->lattice.first[own] = origin[own] - (isReversed ? (count - 1) * grid.spacing[axis] : 0);
      this->strides[own] = isReversed ? -stride : stride;
      this->first += isReversed ? (count - 1) * stride : 0;
      stride *= count;
    }
    if (source.isFlat())
    {
      this->copies = this->lattice.points[2];
      this->copyStride = this->strides[2];
      const schlieren::Box bounds = source.bounds();
      this->lattice.points[2] = 1;
      this->lattice.first[2] = 0.5 * (bounds.low[2] + bounds.high[2]);
      this->lattice.spacing[2] = std::max(this->lattice.spacing[0], this->lattice.spacing[1]);
    }
    while (this->slow > 0 && this->lattice.points[this->slow] == 1)
    {
      --this->slow;
    }
  }

  /// Calls work(sublattice, map from its points to the grid's) for all chunks, in several threads.
  template <class Work>
  void forChunks(const WorkProgress& progress, const Work& work) const
  {
    filters::forChunks(
      this->lattice.points[this->slow], progress,
      [&](vtkIdType begin, vtkIdType end)
      {
        schlieren::Lattice some = this->lattice;
        some.points[this->slow] = static_cast<int>(end - begin);
        some.first[this->slow] += static_cast<double>(begin) * some.spacing[this->slow];
        work(some, this->first + begin * this->strides[this->slow]);
      },
      layersAtATime);
  }

  /// Calls set(point of the chunk, point of the grid) for all of them.
  template <class Set>
  void forPoints(const schlieren::Lattice& part, vtkIdType begin, const Set& set) const
  {
    std::size_t point = 0;
    for (int k = 0; k < part.points[2]; ++k)
    {
      for (int j = 0; j < part.points[1]; ++j)
      {
        for (int i = 0; i < part.points[0]; ++i, ++point)
        {
          const vtkIdType at =
            begin + i * this->strides[0] + j * this->strides[1] + k * this->strides[2];
          for (int copy = 0; copy < this->copies; ++copy)
          {
            set(point, at + copy * this->copyStride);
          }
        }
      }
    }
  }
};

/// Finds a grid's wall points: in and on bodies, and within a voxel's reach of open walls.
class WallsOfGrid
{
public:
  WallsOfGrid(const schlieren::MediumSource& source, vtkImageData* grid)
    : Bounds(source.bounds())
    , Grid(grid)
    , Places(static_cast<std::size_t>(grid->GetNumberOfPoints()))
    , Near(this->Places.size())
  {
  }

  /// Sets a grid point. `distances`: those of the source on the same lattice.
  void set(vtkIdType point, schlieren::Place place, const schlieren::Lattice& lattice,
    std::size_t ofLattice, const std::vector<float>& distances)
  {
    const auto at = static_cast<std::size_t>(point);
    this->Places[at] = place;
    if (place == schlieren::Place::Gas && this->isWithin(lattice, ofLattice))
    {
      const float distance = std::abs(distances[ofLattice]);
      this->Near[at] = distance <= rounding ? On : distance <= reachOfVoxel ? Beside : 0;
    }
  }

  /// Returns whether a point stops light, also with gas: on a body's surface, or near a wall
  /// without an inside. All points must be set before.
  bool isWall(vtkIdType point) const
  {
    const auto at = static_cast<std::size_t>(point);
    if (this->Places[at] != schlieren::Place::Gas || this->Near[at] == 0)
    {
      return this->Places[at] == schlieren::Place::Wall;
    }
    const auto [besideWall, besideWindow] = this->neighboursOf(point);
    return !besideWindow && (this->Near[at] == On || !besideWall);
  }

private:
  enum Nearness : unsigned char
  {
    Beside = 1,
    On = 2
  };
  static constexpr float rounding = 1e-3f; // for surfaces through points of the grid
  /// Half of a voxel's diagonal: no step to a neighbour, even a diagonal one, crosses a wall
  /// between points that are farther from it.
  static constexpr float reachOfVoxel = 0.8661f;

  /// Returns whether the near boundary is not the end of the data.
  bool isWithin(const schlieren::Lattice& lattice, std::size_t point) const
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const auto count = static_cast<std::size_t>(lattice.points[axis]);
      const double x =
        lattice.first[axis] + static_cast<double>(point % count) * lattice.spacing[axis];
      point /= count;
      const double reach = reachOfVoxel * lattice.spacing[axis];
      if (x - reach < this->Bounds.low[axis] || x + reach > this->Bounds.high[axis])
      {
        return false;
      }
    }
    return true;
  }

  /// Returns whether there are walls and windows next to a point.
  std::array<bool, 2> neighboursOf(vtkIdType point) const
  {
    int n[3];
    this->Grid->GetDimensions(n);
    const std::array<int, 3> at{ static_cast<int>(point % n[0]),
      static_cast<int>(point / n[0] % n[1]), static_cast<int>(point / n[0] / n[1]) };
    std::array<bool, 2> found{};
    for (int k = std::max(at[2] - 1, 0); k <= std::min(at[2] + 1, n[2] - 1); ++k)
    {
      for (int j = std::max(at[1] - 1, 0); j <= std::min(at[1] + 1, n[1] - 1); ++j)
      {
        for (int i = std::max(at[0] - 1, 0); i <= std::min(at[0] + 1, n[0] - 1); ++i)
        {
          const schlieren::Place place =
            this->Places[static_cast<std::size_t>((vtkIdType{ k } * n[1] + j) * n[0] + i)];
          found[0] = found[0] || place == schlieren::Place::Wall;
          found[1] = found[1] || place == schlieren::Place::Window;
        }
      }
    }
    return found;
  }

  schlieren::Box Bounds;
  vtkImageData* Grid;
  std::vector<schlieren::Place> Places; // of each point
  std::vector<unsigned char> Near;      // of each point: gas near its boundary
};

/// Calls set(point, refractivity, place) for all points of a grid, sampled from a source, in
/// several threads. `walls`: may be null.
template <class Set>
void sampleAt(const LatticeOfGrid& points, const schlieren::MediumSource& source,
  const WorkProgress& progress, WallsOfGrid* walls, const Set& set)
{
  points.forChunks(progress,
    [&](const schlieren::Lattice& part, vtkIdType begin)
    {
      const auto size = static_cast<std::size_t>(part.size());
      std::vector<double> refractivity(size);
      std::vector<schlieren::Place> places(size);
      std::vector<float> distances(walls ? size : 0);
      source.sample(part, refractivity.data(), places.data(), walls ? distances.data() : nullptr);
      points.forPoints(part, begin,
        [&](std::size_t i, vtkIdType at)
        {
          set(at, refractivity[i], places[i]);
          if (walls)
          {
            walls->set(at, places[i], part, i, distances);
          }
        });
    });
}

} // namespace

//------------------------------------------------------------------------------
void fillGrid(const schlieren::MediumSource& source, Numbers numbers, bool thinSurfaces,
  const WorkProgress& progress, vtkImageData* grid)
{
  const vtkIdType count = grid->GetNumberOfPoints();
  vtkNew<vtkDoubleArray> values;
  setTuples(values, count);
  const auto valid = newMask(count);
  const auto outside = newMask(count);
  outside->SetName(transparentName);
  std::optional<WallsOfGrid> walls;
  if (thinSurfaces)
  {
    walls.emplace(source, grid);
  }
  sampleAt(LatticeOfGrid(source, grid), source, progress, walls ? &*walls : nullptr,
    [&](vtkIdType at, double refractivity, schlieren::Place place)
    {
      values->SetValue(at, refractivity);
      valid->SetValue(at, place == schlieren::Place::Gas ? 1 : 0);
      outside->SetValue(at, place == schlieren::Place::Window ? 1 : 0);
    });
  if (walls)
  {
    for (vtkIdType at = 0; at < count; ++at)
    {
      if (walls->isWall(at))
      {
        valid->SetValue(at, 0);
      }
    }
  }
  setArrays(grid, { values }, Linear(), valid, numbers);
  setOutside(outside, grid);
}

//------------------------------------------------------------------------------
std::vector<float> fieldsAtGrid(
  const schlieren::MediumSource& source, const WorkProgress& progress, vtkImageData* grid)
{
  const LatticeOfGrid points(source, grid);
  const auto count = static_cast<std::size_t>(grid->GetNumberOfPoints());
  const auto fields = static_cast<std::size_t>(source.fields());
  std::vector<float> all(fields * count);
  points.forChunks(progress,
    [&](const schlieren::Lattice& part, vtkIdType begin)
    {
      const auto size = static_cast<std::size_t>(part.size());
      std::vector<double> refractivity(size), values(fields * size);
      std::vector<schlieren::Place> places(size);
      source.sampleWithFields(part, refractivity.data(), places.data(), nullptr, values.data());
      points.forPoints(part, begin,
        [&](std::size_t i, vtkIdType at)
        {
          for (std::size_t field = 0; field < fields; ++field)
          {
            all[field * count + static_cast<std::size_t>(at)] =
              static_cast<float>(values[field * size + i]);
          }
        });
    });
  return all;
}

//------------------------------------------------------------------------------
bool maskWalls(
  const schlieren::MediumSource& source, const WorkProgress& progress, vtkImageData* image)
{
  WallsOfGrid walls(source, image);
  sampleAt(LatticeOfGrid(source, image), source, progress, &walls,
    [](vtkIdType, double, schlieren::Place) {});
  bool isAny = false;
  vtkPointData* arrays = image->GetPointData();
  for (vtkIdType at = 0; at < image->GetNumberOfPoints(); ++at)
  {
    if (walls.isWall(at))
    {
      isAny = true;
      for (const char* name : { arrayName, maskName, transparentName })
      {
        if (vtkDataArray* array = arrays->GetArray(name))
        {
          array->SetComponent(at, 0, 0);
        }
      }
    }
  }
  return isAny;
}

} // namespace filters
