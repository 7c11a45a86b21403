// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QColor>
#include <QImage>
#include <QPointF>
#include <QString>
#include <QVector>

/// A colour filter as an image that can be painted on. A place on it is k times a deflection, from -1 to 1
/// both ways, v upwards.
namespace pqColorFilterImage
{

/// The wheel that a filter without an image is: the direction is the hue, the distance the saturation.
QRgb wheelColor(const QPointF& place);
QImage wheel();

/// What the filter does to light there; beyond the image, as at its edge. A null image is the wheel.
QRgb colorAt(const QImage& image, const QPointF& place);

/// A colour of the filter, greyed where no light (0 to 1) is, so that one sees where there is.
QRgb lit(QRgb color, double light);

/// What a property holds: a file's name, a data URI or nothing. Null where that is no image.
QImage decoded(const QString& text);

/// What a property is to hold: a PNG with the image's texts in it.
QString encoded(const QImage& image);

/// The image, large enough to be painted on and small enough to be sent while that is done.
QImage paintable(const QImage& image);

struct Brush
{
  QColor Color = Qt::black;
  double Radius = 0.04; ///< of the filter's side
  bool Erases = false;  ///< what was underneath comes back
};

/// Dabs a brush on some places of an image, as large as what is underneath.
void paint(
  QImage& image, const QImage& underneath, const Brush& brush, const QVector<QPointF>& places);

/// Places from one to the other, so close that a brush leaves no gaps.
QVector<QPointF> stroke(const QPointF& from, const QPointF& to, double radius);

} // namespace pqColorFilterImage
