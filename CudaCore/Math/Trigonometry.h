// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Sines and angles from sums and products alone: the same to the last bit on host and device, and quicker
// than the libraries' ones. The polynomials are minimax fits.
#pragma once

#include "Math/HostDevice.h"
#include "Math/Units.h"

#include <cmath>

namespace schlieren
{

/// sin(pi x) / x for x in -1/2 ... 1/2; error 1e-13.
SCHLIEREN_HD double sinPiByX(double x)
{
  const double s = x * x;
  double sum = 0.0004461717981030233;
  sum = sum * s - 0.007362932577734682;
  sum = sum * s + 0.08214445932069481;
  sum = sum * s - 0.5992643836180047;
  sum = sum * s + 2.5501640322361787;
  sum = sum * s - 5.167712779873202;
  return sum * s + 3.1415926535886105;
}

/// sin(pi x) for x in -1/2 ... 1/2; error 4e-14.
SCHLIEREN_HD double sinPi(double x) { return x * sinPiByX(x); }

/// Added to a number and taken away again, it leaves the nearest whole one (|x| < 2^51).
constexpr double wholes = 6755399441055744.; // 1.5 * 2^52

/// How far x is from the nearest whole number, -1/2 ... 1/2. Where x is too large to have a fraction, or not
/// finite: 0.
SCHLIEREN_HD double fromNearestWhole(double x)
{
  const double fraction = x - ((x + wholes) - wholes);
  return fraction >= -0.5 && fraction <= 0.5 ? fraction : 0;
}

/// sin(pi x) / (pi x); error 1e-13.
SCHLIEREN_HD double sincPi(double x)
{
  constexpr double perPi = 1 / pi;
  if (fabs(x) <= 0.5)
  {
    return perPi * sinPiByX(x);
  }
  const double half = fromNearestWhole(0.5 * x); // the angle, by 2 pi
  const double quarter = sinPi(0.5 * half);
  return perPi * 2 * sinPi(half) * (1 - 2 * quarter * quarter) / x;
}

/// The direction of (x, y) in radians, counterclockwise from x; -pi ... pi, error 2e-13. Of (0, 0): 0.
SCHLIEREN_HD double angleOf(double x, double y)
{
  const double right = fabs(x);
  const double up = fabs(y);
  const double shorter = right < up ? right : up;
  const double longer = right < up ? up : right;
  double slope = longer > 0 ? shorter / longer : 0;
  double angle = 0;
  if (slope > 0.41421356237309503) // tan(pi / 8)
  {
    slope = (slope - 1) / (slope + 1);
    angle = pi / 4;
  }
  const double s = slope * slope;
  double sum = -0.036429376569762376;
  sum = sum * s + 0.06895144569849711;
  sum = sum * s - 0.08972150565240797;
  sum = sum * s + 0.111007739986089;
  sum = sum * s - 0.14285197485551668;
  sum = sum * s + 0.19999986207659232;
  sum = sum * s - 0.3333333316748642;
  angle += slope * (sum * s + 0.999999999994174);
  angle = right < up ? pi / 2 - angle : angle;
  angle = x < 0 ? pi - angle : angle;
  return y < 0 ? -angle : angle;
}

} // namespace schlieren
