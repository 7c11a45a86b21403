// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Defines LocateInCell for packs of `lanes` points. PlacesInCell.cxx includes it once for each set
// of instructions.

SCHLIEREN_INLINE void maximum(const Real& a, const Real& b, Real& result)
{
  result = a > b ? a : b;
}

inline void locate(const NormalCell& cell, int count, CellPoints& points)
{
  const auto& b = cell.bend;
  const bool isTetrahedron = cell.shape == CellShape::Tetrahedron;
  const bool isSimplex = isTetrahedron || cell.shape == CellShape::Wedge;
  const double third = 1. / 3;
  const double middle[3] = { isTetrahedron ? 0.25 : (isSimplex ? third : 0.5),
    isTetrahedron ? 0.25 : (isSimplex ? third : 0.5),
    isTetrahedron || cell.shape == CellShape::Pyramid ? 0.25 : 0.5 };
  const Real zero = {};
  bool isNearlyAffine = true;
  for (int axis = 0; axis < 3; ++axis)
  {
    double sum = 0;
    for (int i = 0; i < 4; ++i)
    {
      sum += b[axis][i] < 0 ? -b[axis][i] : b[axis][i];
    }
    isNearlyAffine = isNearlyAffine && sum < nearlyAffine;
  }
  for (int first = 0; first < count; first += lanes)
  {
    Real x, y, z;
    load(points.normal[0] + first, x);
    load(points.normal[1] + first, y);
    load(points.normal[2] + first, z);
    Real u = x, v = y, w = z;
    Mask isFound = zero == zero;
    if (!cell.isAffine)
    {
      const auto within = [&](Real& place, int axis)
      {
        const Real low = zero - (farthest + middle[axis]);
        const Real high = zero + (1 + farthest - middle[axis]);
        place = place > low ? place : low;
        place = place < high ? place : high;
      };
      if (isNearlyAffine)
      {
        // Saves half of Newton's steps: corrects the bends of a step without them.
        const Real uv = u * v, vw = v * w, uw = u * w, uvw = uv * w;
        u = x - b[0][0] * uv - b[0][1] * vw - b[0][2] * uw - b[0][3] * uvw;
        v = y - b[1][0] * uv - b[1][1] * vw - b[1][2] * uw - b[1][3] * uvw;
        w = z - b[2][0] * uv - b[2][1] * vw - b[2][2] * uw - b[2][3] * uvw;
      }
      within(u, 0);
      within(v, 1);
      within(w, 2);
      Mask isDone = zero != zero;
      isFound = isDone;
      for (int i = 0; i < maxSteps; ++i)
      {
        const Real uv = u * v, vw = v * w, uw = u * w, uvw = uv * w;
        const Real restX = x - u - b[0][0] * uv - b[0][1] * vw - b[0][2] * uw - b[0][3] * uvw;
        const Real restY = y - v - b[1][0] * uv - b[1][1] * vw - b[1][2] * uw - b[1][3] * uvw;
        const Real restZ = z - w - b[2][0] * uv - b[2][1] * vw - b[2][2] * uw - b[2][3] * uvw;
        const Real xu = b[0][0] * v + b[0][2] * w + b[0][3] * vw + 1;
        const Real yu = b[1][0] * v + b[1][2] * w + b[1][3] * vw;
        const Real zu = b[2][0] * v + b[2][2] * w + b[2][3] * vw;
        const Real xv = b[0][0] * u + b[0][1] * w + b[0][3] * uw;
        const Real yv = b[1][0] * u + b[1][1] * w + b[1][3] * uw + 1;
        const Real zv = b[2][0] * u + b[2][1] * w + b[2][3] * uw;
        const Real xw = b[0][1] * v + b[0][2] * u + b[0][3] * uv;
        const Real yw = b[1][1] * v + b[1][2] * u + b[1][3] * uv;
        const Real zw = b[2][1] * v + b[2][2] * u + b[2][3] * uv + 1;
        const Real minorX = yv * zw - zv * yw, minorY = zv * xw - xv * zw,
                   minorZ = xv * yw - yv * xw;
        const Real perVolume = 1 / (xu * minorX + yu * minorY + zu * minorZ);
        const Real crossX = restY * zw - restZ * yw, crossY = restZ * xw - restX * zw,
                   crossZ = restX * yw - restY * xw;
        const Real stepU = (restX * minorX + restY * minorY + restZ * minorZ) * perVolume;
        const Real stepV = (xu * crossX + yu * crossY + zu * crossZ) * perVolume;
        const Real outerX = yv * restZ - zv * restY, outerY = zv * restX - xv * restZ,
                   outerZ = xv * restY - yv * restX;
        const Real stepW = (xu * outerX + yu * outerY + zu * outerZ) * perVolume;

        const auto sizeOf = [&](const Real& a, const Real& c, const Real& d, Real& size)

        {
          const Real absA = a < 0 ? -a : a, absC = c < 0 ? -c : c, absD = d < 0 ? -d : d;
          maximum(absA, absC, size);
          maximum(size, absD, size);
        };
        Real rest, step;
        sizeOf(restX, restY, restZ, rest);
        sizeOf(stepU, stepV, stepW, step);
        const Mask isThere = rest <= nothing;
        const Mask isFinite = (stepU + stepV + stepW) * 0 == 0;
        const Mask isMoving = ~isDone & ~isThere & isFinite;
        Real nextU = u + stepU, nextV = v + stepV, nextW = w + stepW;
        within(nextU, 0);
        within(nextV, 1);
        within(nextW, 2);
        const Mask hasMoved = (nextU != u) | (nextV != v) | (nextW != w);
        choose(isMoving, nextU, u, u);
        choose(isMoving, nextV, v, v);
        choose(isMoving, nextW, w, w);
        isFound |= ~isDone & (isThere | (isFinite & (step <= lastStep)));
        isDone |= isFound | ~isFinite | ~hasMoved;
        if (all(isDone))
        {
          break;
        }
      }
    }

    const Real r = u + middle[0], s = v + middle[1], t = w + middle[2];
    Real miss = zero;
    maximum(-r, miss, miss);
    maximum(-s, miss, miss);
    maximum(-t, miss, miss);
    if (isTetrahedron)
    {
      maximum(r + s + t - 1, miss, miss);
    }
    else
    {
      if (isSimplex)
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
    const Real infinite = zero + std::numeric_limits<double>::infinity();
    choose(isFound, miss, infinite, miss);
    store(miss, points.miss + first);
    const Real uv = u * v, vw = v * w, uw = u * w, uvw = uv * w;
    const auto polynomial = [&](const double* n, Real& result)
    {
      result =
        n[0] + n[1] * u + n[2] * v + n[3] * w + n[4] * uv + n[5] * vw + n[6] * uw + n[7] * uvw;
    };
    Real value;
    polynomial(cell.value, value);
    if (cell.isSmooth)
    {
      Real slope;
      polynomial(cell.slope[0], slope);
      value += x * slope;
      polynomial(cell.slope[1], slope);
      value += y * slope;
      polynomial(cell.slope[2], slope);
      value += z * slope;
      Real limit;
      polynomial(cell.limit[0], limit);
      value = value > limit ? value : limit;
      polynomial(cell.limit[1], limit);
      value = value < limit ? value : limit;
    }
    store(value, points.value + first);
  }
}
