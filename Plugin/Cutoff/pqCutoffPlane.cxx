// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "pqCutoffPlane.h"

#include "Schlieren.h"

#include <QtMath>

#include <algorithm>
#include <cmath>

namespace
{

constexpr double reach = 8;           // pixels around the mouse
constexpr double turnFraction = 0.84; // of half the square's side
constexpr int digitsOfK = 4;          // precision of dragging
constexpr double offsetSteps = 1000;  // across the source's image
constexpr double angleStep = 0.1;     // degrees
constexpr double largeAngleStep = 15; // degrees

double sizeOf(const pqCutoff& cutoff, const QPointF& deflection)
{
  return cutoff.IsSquare ? std::max(std::abs(deflection.x()), std::abs(deflection.y()))
                         : std::hypot(deflection.x(), deflection.y());
}

} // namespace

double rounded(double value, int digits)
{
  if (value == 0 || !std::isfinite(value))
  {
    return value;
  }
  const int exponent = digits - 1 - static_cast<int>(std::floor(std::log10(std::abs(value))));
  // Divides by powers of ten, because 0.123 is 123 / 10^3, not 123 * 10^-3.
  const double scale = std::pow(10., std::abs(exponent));
  return exponent > 0 ? std::round(value * scale) / scale : std::round(value / scale) * scale;
}

QPointF pqCutoff::normal() const
{
  const double angle = qDegreesToRadians(this->Angle);
  return { std::cos(angle), std::sin(angle) };
}

double pqCutoff::placeOf(const QPointF& deflection) const
{
  return 0.5 - this->Offset + this->K * QPointF::dotProduct(deflection, this->normal());
}

double pqCutoff::deflectionOf(double place) const { return (place - 0.5 + this->Offset) / this->K; }

double pqCutoff::transmission(const QPointF& deflection) const
{
  schlieren::RayAtFilm ray{};
  ray.deflection[0] = deflection.x();
  ray.deflection[1] = deflection.y();
  double light[1] = { 1 };
  switch (this->Kind)
  {
    case KnifeEdge:
      schlieren::KnifeEdge::at(this->Angle, this->K, this->Offset,
        this->IsOfDisc ? schlieren::SourceShape::Disc : schlieren::SourceShape::Slit)
        .shade(ray, light);
      break;
    case BrightField:
      schlieren::BrightField{ this->K }.shade(ray, light);
      break;
    case DarkField:
      schlieren::DarkField{ this->K }.shade(ray, light);
      break;
    case NumericalSchlieren:
      schlieren::NumericalSchlieren{ this->K }.shade(ray, light);
      break;
    case GradedFilter:
    {
      const double place = schlieren::limited(this->placeOf(deflection));
      const double fraction = this->Graded ? schlieren::limited(this->Graded(place)) : place;
      light[0] = fraction;
      break;
    }
    case NoCutoff:
    case ColorFilter:
      break; // lets all pass
  }
  return light[0];
}

pqCutoffPlane::pqCutoffPlane(const QRectF& square, double range)
  : Square(square)
  , Range(range)
{
}

double pqCutoffPlane::deflectionPerPixel() const { return 2 * this->Range / this->Square.width(); }

QPointF pqCutoffPlane::pixelAt(const QPointF& deflection) const
{
  return this->centre() + QPointF(deflection.x(), -deflection.y()) / this->deflectionPerPixel();
}

QPointF pqCutoffPlane::deflectionAt(const QPointF& pixel) const
{
  const QPointF from = pixel - this->centre();
  return QPointF(from.x(), -from.y()) * this->deflectionPerPixel();
}

double pqCutoffPlane::turnRadius() const { return turnFraction * this->Square.width() / 2; }

QPointF pqCutoffPlane::turnHandle(const pqCutoff& cutoff) const
{
  const QPointF normal = cutoff.normal();
  return this->centre() + this->turnRadius() * QPointF(normal.x(), -normal.y());
}

pqCutoffPlane::Handle pqCutoffPlane::handleAt(const pqCutoff& cutoff, const QPointF& pixel) const
{
  if (cutoff.Kind == pqCutoff::NoCutoff || !(cutoff.K > 0))
  {
    return NoHandle;
  }
  const QPointF deflection = this->deflectionAt(pixel);
  const double near = reach * this->deflectionPerPixel();
  if (!cutoff.HasEdge)
  {
    return std::abs(sizeOf(cutoff, deflection) - 1 / cutoff.K) < near ? SizeHandle : NoHandle;
  }
  const QPointF toHandle = pixel - this->turnHandle(cutoff);
  if (std::hypot(toHandle.x(), toHandle.y()) < reach)
  {
    return TurnHandle;
  }
  const double along = QPointF::dotProduct(deflection, cutoff.normal());
  Handle nearest = NoHandle;
  double distance = near;
  const auto tryLine = [&](Handle handle, double place)
  {
    const double away = std::abs(along - cutoff.deflectionOf(place));
    if (away < distance)
    {
      nearest = handle;
      distance = away;
    }
  };
  tryLine(EdgeLine, 0.5);
  tryLine(DarkLine, 0);
  tryLine(BrightLine, 1);
  return nearest;
}

pqCutoff pqCutoffPlane::dragged(
  const pqCutoff& start, Handle handle, const QPointF& from, const QPointF& to, bool inSteps) const
{
  pqCutoff cutoff = start;
  const double pixel = this->deflectionPerPixel();
  const double shift =
    QPointF::dotProduct(this->deflectionAt(to) - this->deflectionAt(from), start.normal());
  switch (handle)
  {
    case EdgeLine:
      cutoff.Offset = std::round((start.Offset + start.K * shift) * offsetSteps) / offsetSteps;
      break;
    case DarkLine:
    case BrightLine:
    {
      const double before = start.deflectionOf(handle == DarkLine ? 0 : 1);
      if (std::abs(before) > 1e-6 / start.K)
      {
        const double sign = before < 0 ? -1 : 1;
        const double after = std::max(pixel, sign * (before + shift));
        cutoff.K = rounded(start.K * sign * before / after, digitsOfK);
      }
      break;
    }
    case TurnHandle:
    {
      const QPointF a = from - this->centre(), b = to - this->centre();
      const double turned =
        start.Angle + qRadiansToDegrees(std::atan2(-b.y(), b.x()) - std::atan2(-a.y(), a.x()));
      const double step = inSteps ? largeAngleStep : angleStep;
      const double angle = std::fmod(std::round(turned / step) * step, 360);
      cutoff.Angle = rounded(angle < 0 ? angle + 360 : angle, digitsOfK);
      break;
    }
    case SizeHandle:
    {
      const double outwards =
        sizeOf(start, this->deflectionAt(to)) - sizeOf(start, this->deflectionAt(from));
      cutoff.K = rounded(1 / std::max(pixel, 1 / start.K + outwards), digitsOfK);
      break;
    }
    case NoHandle:
      break;
  }
  return cutoff;
}

double pqCutoffPlane::roundRange(double range, int step)
{
  constexpr double slack = 1e-9; // keeps round numbers
  int exponent = static_cast<int>(std::floor(std::log10(range) + slack));
  const double digits = range / std::pow(10., exponent);
  const double steps[] = { 1, 2, 5, 10 };
  int index = 0;
  while (index < 3 && steps[index] < digits * (1 - slack))
  {
    ++index;
  }
  for (index += step; index < 0; index += 3)
  {
    --exponent;
  }
  for (; index > 2; index -= 3)
  {
    ++exponent;
  }
  return rounded(steps[index] * std::pow(10., exponent), 1);
}
