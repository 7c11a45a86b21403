// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "pqColorFilterImage.h"

#include <QBuffer>
#include <QPainter>
#include <QPainterPath>

#include <algorithm>
#include <cmath>

namespace pqColorFilterImage
{

namespace
{

constexpr int side = 256;        // pixels of the wheel, minimum of painted images
constexpr int paintedSide = 512; // pixels, maximum of painted images
constexpr double colorWithoutLight = 0.35;
constexpr int grey = 128;

double limited(double fraction) { return std::min(1., std::max(0., fraction)); }

} // namespace

QRgb wheelColor(const QPointF& place)
{
  const double saturation = std::min(1., std::hypot(place.x(), place.y()));
  const double sixths = std::atan2(place.y(), place.x()) * 3 / std::acos(-1); // -3 ... 3
  const auto value = [saturation](double light)
  { return static_cast<int>(std::round(255 * (1 - saturation * (1 - limited(light))))); };
  return qRgb(value(2 - std::abs(sixths)),
    value(2 - std::abs(sixths < -1 ? sixths + 4 : sixths - 2)),
    value(2 - std::abs(sixths > 1 ? sixths - 4 : sixths + 2)));
}

QImage wheel()
{
  QImage image(side, side, QImage::Format_RGB32);
  for (int row = 0; row < side; ++row)
  {
    for (int column = 0; column < side; ++column)
    {
      image.setPixel(
        column, row, wheelColor({ 2 * (column + 0.5) / side - 1, 1 - 2 * (row + 0.5) / side }));
    }
  }
  return image;
}

QRgb colorAt(const QImage& image, const QPointF& place)
{
  if (image.isNull())
  {
    return wheelColor(place);
  }
  const auto pixel = [](double fraction, int size)
  { return static_cast<int>(std::min(limited(fraction) * size, size - 1.)); };
  return image.pixel(
    pixel((1 + place.x()) / 2, image.width()), pixel((1 - place.y()) / 2, image.height()));
}

QRgb lit(QRgb color, double light)
{
  const double fraction = colorWithoutLight + (1 - colorWithoutLight) * light;
  const auto mixed = [fraction](int value)
  { return static_cast<int>(std::lround(grey + fraction * (value - grey))); };
  return qRgb(mixed(qRed(color)), mixed(qGreen(color)), mixed(qBlue(color)));
}

QImage decoded(const QString& text)
{
  if (text.startsWith("data:"))
  {
    return QImage::fromData(QByteArray::fromBase64(text.mid(text.indexOf(',') + 1).toLatin1()));
  }
  return text.isEmpty() ? QImage() : QImage(text);
}

QString encoded(const QImage& image)
{
  QBuffer png;
  image.save(&png, "PNG");
  return "data:image/png;base64," + QString::fromLatin1(png.data().toBase64());
}

QImage opaque(const QImage& read)
{
  QImage image(read.size(), QImage::Format_RGB888);
  image.fill(Qt::white);
  QPainter(&image).drawImage(0, 0, read);
  if (std::max(image.width(), image.height()) > largestSide)
  {
    image = image.scaled(largestSide, largestSide, Qt::KeepAspectRatio, Qt::SmoothTransformation);
  }
  return image;
}

QImage paintable(const QImage& image)
{
  if (image.isNull())
  {
    return wheel();
  }
  const QSize size =
    image.size().expandedTo({ side, side }).boundedTo({ paintedSide, paintedSide });
  return image.convertToFormat(QImage::Format_RGB32)
    .scaled(size, Qt::IgnoreAspectRatio, Qt::SmoothTransformation);
}

void paint(
  QImage& image, const QImage& underneath, const Brush& brush, const QVector<QPointF>& places)
{
  const double width = image.width(), height = image.height();
  QPainterPath dabs;
  dabs.setFillRule(Qt::WindingFill);
  for (const QPointF& place : places)
  {
    dabs.addEllipse(QPointF((1 + place.x()) / 2 * width, (1 - place.y()) / 2 * height),
      brush.Radius * width, brush.Radius * height);
  }
  // Disables antialiasing, with which the eraser would leave a rim.
  QPainter painter(&image);
  if (brush.Spares && !brush.Erases)
  {
    QPainterPath all, middle;
    all.addRect(image.rect());
    middle.addEllipse(
      QPointF(width / 2, height / 2), undeflected / 2 * width, undeflected / 2 * height);
    painter.setClipPath(all - middle);
  }
  painter.fillPath(dabs, brush.Erases ? QBrush(underneath) : QBrush(brush.Color));
}

QVector<QPointF> stroke(const QPointF& from, const QPointF& to, double radius)
{
  const QPointF line = to - from;
  const int steps =
    std::max(1, static_cast<int>(std::ceil(std::hypot(line.x(), line.y()) / radius)));
  QVector<QPointF> places;
  for (int step = 1; step <= steps; ++step)
  {
    places.append(from + line * step / steps);
  }
  return places;
}

} // namespace pqColorFilterImage
