// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// What all code for packs of `lanes` numbers uses; ForInstructions.inl includes it once for each set of instructions.

typedef double Real __attribute__((vector_size(sizeof(double) * lanes)));
typedef std::int64_t Mask __attribute__((vector_size(sizeof(double) * lanes)));

SCHLIEREN_INLINE void load(const double* from, Real& pack)
{
  __builtin_memcpy(&pack, from, sizeof(pack));
}

SCHLIEREN_INLINE void store(const Real& pack, double* to)
{
  __builtin_memcpy(to, &pack, sizeof(pack));
}

SCHLIEREN_INLINE void choose(const Mask& mask, const Real& a, const Real& b, Real& result)
{
  result = (Real)(((Mask)a & mask) | ((Mask)b & ~mask));
}

SCHLIEREN_INLINE bool all(const Mask& mask)
{
  std::int64_t each = -1;
  for (int i = 0; i < lanes; ++i)
  {
    each &= mask[i];
  }
  return each != 0;
}

/// Computes the largest absolute value.
SCHLIEREN_INLINE void largest(const Real& a, const Real& b, const Real& c, Real& result)
{
  const Real absA = a < 0 ? -a : a, absB = b < 0 ? -b : b, absC = c < 0 ? -c : c;
  const Real more = absA > absB ? absA : absB;
  result = more > absC ? more : absC;
}

SCHLIEREN_INLINE void cross(const Real (&a)[3], const Real (&b)[3], Real (&result)[3])
{
  for (int axis = 0; axis < 3; ++axis)
  {
    const int next = (axis + 1) % 3, last = (axis + 2) % 3;
    result[axis] = a[next] * b[last] - a[last] * b[next];
  }
}
