// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Defines LocateInPart for packs of `lanes` points. PlacesInPart.cxx includes it once for each set
// of instructions.

/// Evaluates `count` polynomials and their slopes by Horner's rule: all at once, because each sum
/// waits for the one before it.
template <int count>
SCHLIEREN_INLINE void evaluate(
  const CurvedPart& part, int first, const Real at[3], Real sums[count], Real slopes[3][count])
{
  const Real zero = {};
  for (int of = 0; of < count; ++of)
  {
    sums[of] = slopes[0][of] = slopes[1][of] = slopes[2][of] = zero;
  }
  for (int i = part.orders[0]; i >= 0; --i)
  {
    Real row[count], rowBy1[count], rowBy2[count];
    for (int of = 0; of < count; ++of)
    {
      row[of] = rowBy1[of] = rowBy2[of] = zero;
    }
    for (int j = part.lastAlong1(i); j >= 0; --j)
    {
      const int begin = (i * (part.orders[1] + 1) + j) * (part.orders[2] + 1);
      const int last = part.lastAlong2(i, j);
      const double* term = part.coefficients + 4 * (begin + last) + first;
      Real line[count], lineBy2[count];
      for (int of = 0; of < count; ++of)
      {
        line[of] = zero + term[of];
        lineBy2[of] = zero;
      }
      for (int k = last - 1; k >= 0; --k)
      {
        term -= 4;
        for (int of = 0; of < count; ++of)
        {
          lineBy2[of] = lineBy2[of] * at[2] + line[of];
          line[of] = line[of] * at[2] + term[of];
        }
      }
      for (int of = 0; of < count; ++of)
      {
        rowBy1[of] = rowBy1[of] * at[1] + row[of];
        row[of] = row[of] * at[1] + line[of];
        rowBy2[of] = rowBy2[of] * at[1] + lineBy2[of];
      }
    }
    for (int of = 0; of < count; ++of)
    {
      slopes[0][of] = slopes[0][of] * at[0] + sums[of];
      sums[of] = sums[of] * at[0] + row[of];
      slopes[1][of] = slopes[1][of] * at[0] + rowBy1[of];
      slopes[2][of] = slopes[2][of] * at[0] + rowBy2[of];
    }
  }
}

/// Iterates Newton's method. Returns the points whose place was found.
SCHLIEREN_INLINE void iterate(
  const CurvedPart& part, const Real target[3], Real at[3], Mask& isFound)
{
  const Real zero = {};
  Mask isDone = zero != zero;
  isFound = isDone;
  Real least = zero + std::numeric_limits<double>::infinity(), withoutGain = zero;
  for (int step = 0; step < maxSteps; ++step)
  {
    Real rest[3], by[3][3]; // by each coordinate
    evaluate<3>(part, 0, at, rest, by);
    for (int axis = 0; axis < 3; ++axis)
    {
      rest[axis] = target[axis] - rest[axis];
    }
    Real minors[3][3]; // cross products of two columns
    for (int along = 0; along < 3; ++along)
    {
      cross(by[(along + 1) % 3], by[(along + 2) % 3], minors[along]);
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
    const Real more = withoutGain + 1;
    choose(left < 0.5 * least, zero, more, withoutGain);
    least = left < least ? left : least;
    isFound |= ~isDone & (isThere | (isFinite & (size <= lastStep)));
    isDone |= isFound | ~isFinite | ~hasMoved | (withoutGain >= maxWithoutGain);
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
    Real value[1], notUsed[3][1];
    evaluate<1>(part, 3, best, value, notUsed);
    store(value[0], points.value + first);
    store(least, points.miss + first);
  }
}
