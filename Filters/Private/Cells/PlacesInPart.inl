// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Defines LocateInPart for packs of `lanes` points. PlacesInPart.cxx includes it once for each set
// of instructions.

SCHLIEREN_INLINE void largest(const Real& a, const Real& b, const Real& c, Real& result)
{
  const Real absA = a < 0 ? -a : a, absB = b < 0 ? -b : b, absC = c < 0 ? -c : c;
  const Real more = absA > absB ? absA : absB;
  result = more > absC ? more : absC;
}

/// Evaluates a polynomial and its slopes by Horner's rule.
SCHLIEREN_INLINE void evaluate(
  const CurvedPart& part, const double* coefficients, const Real at[3], Real& sum, Real slopes[3])
{
  const Real zero = {};
  sum = slopes[0] = slopes[1] = slopes[2] = zero;
  for (int i = part.orders[0]; i >= 0; --i)
  {
    Real row = zero, rowBy1 = zero, rowBy2 = zero;
    for (int j = part.lastAlong1(i); j >= 0; --j)
    {
      const double* of = coefficients + (i * (part.orders[1] + 1) + j) * (part.orders[2] + 1);
      const int last = part.lastAlong2(i, j);
      Real line = zero + of[last], lineBy2 = zero;
      for (int k = last - 1; k >= 0; --k)
      {
        lineBy2 = lineBy2 * at[2] + line;
        line = line * at[2] + of[k];
      }
      rowBy1 = rowBy1 * at[1] + row;
      row = row * at[1] + line;
      rowBy2 = rowBy2 * at[1] + lineBy2;
    }
    slopes[0] = slopes[0] * at[0] + sum;
    sum = sum * at[0] + row;
    slopes[1] = slopes[1] * at[0] + rowBy1;
    slopes[2] = slopes[2] * at[0] + rowBy2;
  }
}

/// Iterates Newton's method. Returns the points whose place was found.
SCHLIEREN_INLINE void iterate(
  const CurvedPart& part, const Real target[3], Real at[3], Mask& isFound)
{
  const Real zero = {};
  Mask isDone = zero != zero;
  isFound = isDone;
  for (int step = 0; step < maxSteps; ++step)
  {
    Real rest[3], by[3][3]; // by each coordinate
    for (int axis = 0; axis < 3; ++axis)
    {
      Real reached, slopes[3];
      evaluate(part, part.coefficients[axis], at, reached, slopes);
      rest[axis] = target[axis] - reached;
      for (int along = 0; along < 3; ++along)
      {
        by[along][axis] = slopes[along];
      }
    }
    Real minors[3][3]; // cross products of two columns
    for (int along = 0; along < 3; ++along)
    {
      const Real* a = by[(along + 1) % 3];
      const Real* b = by[(along + 2) % 3];
      for (int axis = 0; axis < 3; ++axis)
      {
        const int next = (axis + 1) % 3, last = (axis + 2) % 3;
        minors[along][axis] = a[next] * b[last] - a[last] * b[next];
      }
    }
    const Real perVolume =
      1 / (by[0][0] * minors[0][0] + by[0][1] * minors[0][1] + by[0][2] * minors[0][2]);
    Real change[3], size, left;
    for (int along = 0; along < 3; ++along)
    {
      const Real* minor = minors[along];
      change[along] = (minor[0] * rest[0] + minor[1] * rest[1] + minor[2] * rest[2]) * perVolume;
    }
    largest(change[0], change[1], change[2], size);
    largest(rest[0], rest[1], rest[2], left);
    const Mask isThere = left <= (part.isRegular ? nothing : nothingInFolds);
    const Mask isFinite = (change[0] + change[1] + change[2]) * 0 == 0;
    const Mask isMoving = ~isDone & ~isThere & isFinite;
    Mask hasMoved = zero != zero;
    for (int along = 0; along < 3; ++along)
    {
      const Real high = zero + farthest;
      Real next = at[along] + change[along];
      next = next > -high ? next : -high;
      next = next < high ? next : high;
      hasMoved |= next != at[along];
      choose(isMoving, next, at[along], at[along]);
    }
    isFound |= ~isDone & (isThere | (isFinite & (size <= lastStep)));
    isDone |= isFound | ~isFinite | ~hasMoved;
    if (all(isDone))
    {
      return;
    }
  }
}

/// Computes how far the worst of the cell's parametric coordinates is outside of its range.
SCHLIEREN_INLINE void missOf(const CurvedPart& part, const Real at[3], Real& miss)
{
  const Real zero = {};
  Real place[3];
  miss = zero;
  const auto add = [&miss](const Real& more) { miss = more > miss ? more : miss; };
  for (int axis = 0; axis < 3; ++axis)
  {
    place[axis] = part.middle[axis] + part.half[axis] * at[axis];
    add(-place[axis]);
  }
  switch (part.reference)
  {
    case Reference::Simplex:
      add(place[0] + place[1] + place[2] - 1);
      break;
    case Reference::Wedge:
      add(place[0] + place[1] - 1);
      add(place[2] - 1);
      break;
    default:
      add(place[0] - 1);
      add(place[1] - 1);
      add(place[2] - 1);
  }
}

inline void locate(const CurvedPart& part, int count, CellPoints& points)
{
  const Real zero = {};
  const Real infinite = zero + std::numeric_limits<double>::infinity();
  for (int first = 0; first < count; first += lanes)
  {
    Real target[3], best[3] = { zero, zero, zero }, least = infinite;
    for (int axis = 0; axis < 3; ++axis)
    {
      load(points.normal[axis] + first, target[axis]);
    }
    for (int attempt = 0; attempt < (part.isRegular ? 1 : attempts); ++attempt)
    {
      Real at[3];
      for (int axis = 0; axis < 3; ++axis)
      {
        at[axis] = part.isRegular ? target[axis] : zero + starts[attempt][axis];
        at[axis] = at[axis] > -1 ? at[axis] : zero - 1;
        at[axis] = at[axis] < 1 ? at[axis] : zero + 1;
      }
      Mask isFound;
      iterate(part, target, at, isFound);
      Real miss;
      missOf(part, at, miss);
      const Mask isBetter = isFound & (miss < least);
      choose(isBetter, miss, least, least);
      for (int axis = 0; axis < 3; ++axis)
      {
        choose(isBetter, at[axis], best[axis], best[axis]);
      }
      if (all(least <= part.tolerance))
      {
        break;
      }
    }
    Real value, notUsed[3];
    evaluate(part, part.coefficients[3], best, value, notUsed);
    store(value, points.value + first);
    store(least, points.miss + first);
  }
}
