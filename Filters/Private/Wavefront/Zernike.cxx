// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Wavefront/Zernike.h"

#include <array>
#include <cmath>
#include <cstdlib>

namespace filters
{

namespace
{

double factorial(int n) { return n > 1 ? n * factorial(n - 1) : 1; }

} // namespace

Zernike::Zernike(int number)
{
  int degree = 0, among = number - 1; // n, and which of its n + 1 terms this is
  for (; among > degree; among -= degree)
  {
    ++degree;
  }
  const int m = degree % 2 + 2 * ((among + (degree + 1) % 2) / 2);
  this->Frequency = number % 2 == 0 ? m : -m;
  const double norm = std::sqrt((m == 0 ? 1. : 2.) * (degree + 1));
  for (int k = (degree - m) / 2; k >= 0; --k)
  {
    this->OfSquares.push_back(norm * (k % 2 == 0 ? 1 : -1) * factorial(degree - k) /
      (factorial(k) * factorial((degree + m) / 2 - k) * factorial((degree - m) / 2 - k)));
  }
}

double Zernike::operator()(double x, double y) const
{
  const double square = x * x + y * y;
  double value = 0;
  for (auto coefficient = this->OfSquares.rbegin(); coefficient != this->OfSquares.rend();
       ++coefficient)
  {
    value = value * square + *coefficient;
  }
  if (this->Frequency == 0)
  {
    return value;
  }
  const int m = std::abs(this->Frequency);
  const double angle = m * std::atan2(y, x);
  return value * std::pow(square, 0.5 * m) *
    (this->Frequency > 0 ? std::cos(angle) : std::sin(angle));
}

std::string nameOfZernike(int number)
{
  static const std::array<const char*, 15> names = { "Piston", "Tilt Right", "Tilt Up", "Defocus",
    "Oblique Astigmatism", "Vertical Astigmatism", "Vertical Coma", "Horizontal Coma",
    "Vertical Trefoil", "Oblique Trefoil", "Spherical", "Vertical Secondary Astigmatism",
    "Oblique Secondary Astigmatism", "Vertical Quadrafoil", "Oblique Quadrafoil" };
  const auto index = static_cast<std::size_t>(number - 1);
  return "Z" + std::to_string(number) +
    (index < names.size() ? std::string(" ") + names[index] : std::string());
}

} // namespace filters
