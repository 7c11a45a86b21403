// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Zernike's polynomials in the order and normalization of R. J. Noll, J. Opt. Soc. Am. 66, 207 (1976), equations 1 to 3: the
// mean square of each over the unit circle is 1.
#pragma once

#include <string>
#include <vector>

namespace filters
{

class Zernike
{
public:
  /// `number`: Noll's, from 1.
  explicit Zernike(int number);

  /// Returns the value at a point; the circle's radius is 1.
  double operator()(double x, double y) const;

private:
  int Frequency;                 ///< m: of the cosine; negative: of the sine
  std::vector<double> OfSquares; ///< coefficients of powers of the squared radius, the lowest first
};

/// Returns the name of a term, such as `Z4 Defocus`; beyond the fifteenth, the number alone.
std::string nameOfZernike(int number);

} // namespace filters
