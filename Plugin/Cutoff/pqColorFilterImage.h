// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QColor>
#include <QImage>
#include <QPointF>
#include <QString>
#include <QVector>

/// A colour filter as an image to paint on. A point is k times a deflection, -1 to 1 in u and v.
namespace pqColorFilterImage
{

/// Returns the colour of the wheel: direction is hue, distance is saturation.
QRgb wheelColor(const QPointF& place);
QImage wheel();

/// Returns the colour of an image, or of the wheel if it is null, clamped to its edge.
QRgb colorAt(const QImage& image, const QPointF& place);

/// Mixes a colour with grey by the light on it (0 to 1), to show where there is light.
QRgb lit(QRgb color, double light);

/// Decodes a property's value: a file name, a data URI or nothing. Null where that is no image.
QImage decoded(const QString& text);

/// Encodes an image as PNG with its texts.
QString encoded(const QImage& image);

/// Blends with white, which lets all light pass, and limits the size, for the sake of state files.
constexpr int largestSide = 2048; // pixels
QImage opaque(const QImage& read);

/// Resizes an image: large enough to paint on, small enough to send while painting.
QImage paintable(const QImage& image);

struct Brush
{
  QColor Color = Qt::magenta; ///< stands out from white and from the wheel
  double Radius = 0.04;       ///< fraction of the filter's side
  bool Erases = false;        ///< restores what was underneath
  bool Spares = false; ///< leaves the middle as it is, where light goes that is not deflected
};

/// Distance from the middle, of half the filter's side, within which light counts as not deflected.
constexpr double undeflected = 0.02;

/// Paints dabs on an image of the same size as the one underneath.
void paint(
  QImage& image, const QImage& underneath, const Brush& brush, const QVector<QPointF>& places);

/// Interpolates points so densely that a brush leaves no gaps.
QVector<QPointF> stroke(const QPointF& from, const QPointF& to, double radius);

} // namespace pqColorFilterImage
