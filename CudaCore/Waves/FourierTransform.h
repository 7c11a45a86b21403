// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Fourier transforms of fields in two dimensions. Those in one are Eigen's (kissfft, a header).
#pragma once

#include "Types.h"

#include <complex>
#include <cstdint>
#include <functional>
#include <vector>

namespace schlieren
{

/// Complex numbers at the points of a rectangle, row by row.
struct ComplexField
{
  using Value = std::complex<double>;

  ComplexField(std::int64_t ofColumns, std::int64_t ofRows)
    : columns(ofColumns)
    , rows(ofRows)
    , values(static_cast<std::size_t>(ofColumns * ofRows))
  {
  }

  Value* row(std::int64_t number) { return values.data() + number * columns; }
  const Value* row(std::int64_t number) const { return values.data() + number * columns; }

  std::int64_t columns, rows;
  std::vector<Value> values; ///< 0 at first
};

/// The least number that is no smaller and has no prime factor but 2, 3 and 5: transforms of such lengths are fast.
std::int64_t fastLength(std::int64_t points);

/// The frequency of number `index` of a spectrum of `points` values, `spacing` apart, in cycles by the unit of that.
double frequencyOf(std::int64_t index, std::int64_t points, double spacing);

/// Multiplies the spectrum along y of one column of a field's spectrum, by its number along x.
using SpectrumFilter = std::function<void(std::int64_t column, std::complex<double>* alongY)>;

/// Replaces a field by its spectrum, multiplied. False if aborted.
bool makeSpectrum(
  ComplexField& field, const SpectrumFilter& filter, int threads, const Monitor& monitor = {});

/// The rows from `begin` up to before `end`.
struct RowRange
{
  std::int64_t begin, end;
};

/// Makes some rows of the field of a spectrum, multiplied; its other rows are left as they are. `field`: as large. False if
/// aborted.
bool makeField(const ComplexField& spectrum, const SpectrumFilter& filter, ComplexField& field,
  const RowRange& rows, int threads, const Monitor& monitor = {});

/// Multiplies the spectrum of a field: both in one. The result does not depend on the number of threads. False if aborted.
bool filterSpectrum(
  ComplexField& field, const SpectrumFilter& filter, int threads, const Monitor& monitor = {});

} // namespace schlieren
