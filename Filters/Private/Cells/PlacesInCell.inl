// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Defines LocateInCell for packs of `lanes` points. PlacesInCell.cxx includes it once for each set
// of instructions.

SCHLIEREN_INLINE void maximum(const Real& a, const Real& b, Real& result)
{
  result = a > b ? a : b;
}

/// A pack of places in a cell, in coordinates in which it is affine, to find in its own coordinates from its middle.
class PackOfPlaces
{
public:
  SCHLIEREN_INLINE PackOfPlaces(
    const NormalCell& cell, const double (&middle)[3], const Real (&target)[3])
    : Cell{ cell }
    , Middle{ middle }
    , Target{ target }
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      this->At[axis] = target[axis];
    }
  }

  /// Iterates Newton's method.
  SCHLIEREN_INLINE void find(bool isNearlyAffine)
  {
    const auto& b = this->Cell.bend;
    if (isNearlyAffine)
    {
      // Saves half of Newton's steps: corrects the bends of a step without them.
      Real products[4];
      this->multiply(products);
      for (int axis = 0; axis < 3; ++axis)
      {
        this->At[axis] = this->Target[axis] - b[axis][0] * products[0] - b[axis][1] * products[1] -
          b[axis][2] * products[2] - b[axis][3] * products[3];
      }
    }
    for (int axis = 0; axis < 3; ++axis)
    {
      this->keepWithin(this->At[axis], axis);
    }
    Mask isDone = this->Zero != this->Zero;
    this->IsFound = isDone;
    for (int i = 0; i < maxSteps; ++i)
    {
      Real rest[3], step[3], left, size;
      this->newtonStep(rest, step);
      largest(rest[0], rest[1], rest[2], left);
      largest(step[0], step[1], step[2], size);
      const Mask isThere = left <= nothing;
      const Mask isFinite = (step[0] + step[1] + step[2]) * 0 == 0;
      const Mask isMoving = ~isDone & ~isThere & isFinite;
      Mask hasMoved = this->Zero != this->Zero;
      for (int axis = 0; axis < 3; ++axis)
      {
        Real next = this->At[axis] + step[axis];
        this->keepWithin(next, axis);
        hasMoved |= next != this->At[axis];
        choose(isMoving, next, this->At[axis], this->At[axis]);
      }
      this->IsFound |= ~isDone & (isThere | (isFinite & (size <= lastStep)));
      isDone |= this->IsFound | ~isFinite | ~hasMoved;
      if (all(isDone))
      {
        break;
      }
    }
  }

  /// Computes how far the worst of the coordinates is outside of the cell, infinite for places that were not found.
  SCHLIEREN_INLINE void miss(Real& result) const
  {
    const bool isTetrahedron = this->Cell.shape == CellShape::Tetrahedron;
    const Real r = this->At[0] + this->Middle[0], s = this->At[1] + this->Middle[1],
               t = this->At[2] + this->Middle[2];
    Real miss = this->Zero;
    maximum(-r, miss, miss);
    maximum(-s, miss, miss);
    maximum(-t, miss, miss);
    if (isTetrahedron)
    {
      maximum(r + s + t - 1, miss, miss);
    }
    else
    {
      if (this->Cell.shape == CellShape::Wedge)
      {
        maximum(r + s - 1, miss, miss);
      }
      else
      {
        maximum(r - 1, miss, miss);
        maximum(s - 1, miss, miss);
      }
      maximum(t - 1, miss, miss);
    }
    const Real infinite = this->Zero + std::numeric_limits<double>::infinity();
    choose(this->IsFound, miss, infinite, result);
  }

  SCHLIEREN_INLINE void value(Real& result) const
  {
    Real products[4];
    this->multiply(products);
    const auto polynomial = [&](const double* n, Real& sum)
    {
      sum = n[0] + n[1] * this->At[0] + n[2] * this->At[1] + n[3] * this->At[2] +
        n[4] * products[0] + n[5] * products[1] + n[6] * products[2] + n[7] * products[3];
    };
    polynomial(this->Cell.value, result);
    if (this->Cell.isSmooth)
    {
      for (int axis = 0; axis < 3; ++axis)
      {
        Real slope;
        polynomial(this->Cell.slope[axis], slope);
        result += this->Target[axis] * slope;
      }
      Real limit;
      polynomial(this->Cell.limit[0], limit);
      result = result > limit ? result : limit;
      polynomial(this->Cell.limit[1], limit);
      result = result < limit ? result : limit;
    }
  }

private:
  SCHLIEREN_INLINE void multiply(Real (&products)[4]) const
  {
    products[0] = this->At[0] * this->At[1];
    products[1] = this->At[1] * this->At[2];
    products[2] = this->At[0] * this->At[2];
    products[3] = products[0] * this->At[2];
  }

  SCHLIEREN_INLINE void keepWithin(Real& place, int axis) const
  {
    const Real low = this->Zero - (farthest + this->Middle[axis]);
    const Real high = this->Zero + (1 + farthest - this->Middle[axis]);
    place = place > low ? place : low;
    place = place < high ? place : high;
  }

  /// Computes the distance that is left, and by Cramer's rule the step that removes its linear part.
  SCHLIEREN_INLINE void newtonStep(Real (&rest)[3], Real (&step)[3]) const
  {
    const auto& b = this->Cell.bend;
    const Real &u = this->At[0], &v = this->At[1], &w = this->At[2];
    Real products[4], by[3][3]; // by[i][k]: change of coordinate k by the cell's coordinate i
    this->multiply(products);
    for (int k = 0; k < 3; ++k)
    {
      rest[k] = this->Target[k] - this->At[k] - b[k][0] * products[0] - b[k][1] * products[1] -
        b[k][2] * products[2] - b[k][3] * products[3];
      by[0][k] = b[k][0] * v + b[k][2] * w + b[k][3] * products[1];
      by[1][k] = b[k][0] * u + b[k][1] * w + b[k][3] * products[2];
      by[2][k] = b[k][1] * v + b[k][2] * u + b[k][3] * products[0];
      by[k][k] = by[k][k] + 1;
    }
    Real minor[3], crossed[3], outer[3];
    cross(by[1], by[2], minor);
    cross(rest, by[2], crossed);
    cross(by[1], rest, outer);
    const Real perVolume = 1 / (by[0][0] * minor[0] + by[0][1] * minor[1] + by[0][2] * minor[2]);
    step[0] = (rest[0] * minor[0] + rest[1] * minor[1] + rest[2] * minor[2]) * perVolume;
    step[1] = (by[0][0] * crossed[0] + by[0][1] * crossed[1] + by[0][2] * crossed[2]) * perVolume;
    step[2] = (by[0][0] * outer[0] + by[0][1] * outer[1] + by[0][2] * outer[2]) * perVolume;
  }

  const NormalCell& Cell;
  const double (&Middle)[3];
  const Real (&Target)[3];
  const Real Zero = {};
  Real At[3];
  Mask IsFound = this->Zero == this->Zero;
};

inline void locate(const NormalCell& cell, int count, CellPoints& points)
{
  const bool isTetrahedron = cell.shape == CellShape::Tetrahedron;
  const double third = 1. / 3;
  const double side = isTetrahedron ? 0.25 : (cell.shape == CellShape::Wedge ? third : 0.5);
  const double middle[3] = { side, side,
    isTetrahedron || cell.shape == CellShape::Pyramid ? 0.25 : 0.5 };
  bool isNearlyAffine = true;
  for (int axis = 0; axis < 3; ++axis)
  {
    double sum = 0;
    for (int i = 0; i < 4; ++i)
    {
      sum += cell.bend[axis][i] < 0 ? -cell.bend[axis][i] : cell.bend[axis][i];
    }
    isNearlyAffine = isNearlyAffine && sum < nearlyAffine;
  }
  for (int first = 0; first < count; first += lanes)
  {
    Real target[3], miss, value;
    for (int axis = 0; axis < 3; ++axis)
    {
      load(points.normal[axis] + first, target[axis]);
    }
    PackOfPlaces places(cell, middle, target);
    if (!cell.isAffine)
    {
      places.find(isNearlyAffine);
    }
    places.miss(miss);
    store(miss, points.miss + first);
    places.value(value);
    store(value, points.value + first);
  }
}
