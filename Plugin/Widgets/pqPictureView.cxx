// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "pqPictureView.h"

#include <QFontMetrics>
#include <QMouseEvent>
#include <QPainter>

#include <algorithm>
#include <cmath>

namespace
{

constexpr int shownSide = 128;       // pixels
constexpr int wheelSide = 256;       // pixels, to paint on
constexpr double brushRadius = 0.05; // of the filter's side

/// A filter that has no picture: the direction of deflection is the hue, its size the saturation.
QImage colorWheel()
{
  QImage wheel(wheelSide, wheelSide, QImage::Format_RGB32);
  for (int row = 0; row < wheelSide; ++row)
  {
    for (int column = 0; column < wheelSide; ++column)
    {
      const double u = 2 * (column + 0.5) / wheelSide - 1, v = 1 - 2 * (row + 0.5) / wheelSide;
      const double turn = std::atan2(v, u) / (2 * std::acos(-1));
      wheel.setPixelColor(column, row,
        QColor::fromHsvF(turn < 0 ? turn + 1 : turn, std::min(1., std::hypot(u, v)), 1));
    }
  }
  return wheel;
}

} // namespace

//------------------------------------------------------------------------------
pqPictureView::pqPictureView(bool isColorFilter, QWidget* parentObject)
  : QWidget(parentObject)
  , IsColorFilter(isColorFilter)
  , Margin(isColorFilter ? this->fontMetrics().height() : 0)
{
  this->setFixedSize(shownSide + 3 * this->Margin, shownSide + 2 * this->Margin);
  if (isColorFilter)
  {
    this->setToolTip(tr("Paint with the mouse: which colour light has that is deflected there."));
  }
}

//------------------------------------------------------------------------------
QRect pqPictureView::place() const
{
  return QRect(QPoint(this->Margin, this->Margin), this->Shown.size());
}

//------------------------------------------------------------------------------
void pqPictureView::setPicture(const QImage& picture)
{
  this->Picture = picture;
  if (this->IsColorFilter)
  {
    this->Picture = picture.isNull() ? colorWheel() : picture.convertToFormat(QImage::Format_RGB32);
  }
  this->Shown = this->Picture.isNull()
    ? QImage()
    : this->Picture.scaled(shownSide, shownSide,
        this->IsColorFilter ? Qt::IgnoreAspectRatio : Qt::KeepAspectRatio,
        Qt::SmoothTransformation);
  if (!this->IsColorFilter)
  {
    this->setFixedSize(this->Shown.size().expandedTo(QSize(1, 1)));
  }
  this->update();
}

//------------------------------------------------------------------------------
void pqPictureView::paintEvent(QPaintEvent*)
{
  QPainter painter(this);
  painter.drawImage(this->place(), this->Shown);
  if (this->IsColorFilter)
  {
    this->drawAxes(painter);
  }
}

//------------------------------------------------------------------------------
void pqPictureView::drawAxes(QPainter& painter) const
{
  const QRect square = this->place();
  const QPoint middle = square.center();
  painter.setPen(QPen(QColor(0, 0, 0, 128), 1, Qt::DashLine));
  painter.drawLine(square.left(), middle.y(), square.right(), middle.y());
  painter.drawLine(middle.x(), square.top(), middle.x(), square.bottom());

  painter.setPen(this->palette().color(QPalette::WindowText));
  const int line = this->Margin;
  const auto write = [&](int x, int y, const QString& text)
  { painter.drawText(QRect(x - 30, y - line / 2, 60, line), Qt::AlignCenter, text); };
  const QString minusOne = QString::fromUtf8("\u22121");
  write(middle.x(), line / 2, QString::fromUtf8("k ε\u1D65 = 1"));
  write(middle.x(), square.bottom() + line / 2 + 1, minusOne);
  write(line / 2, middle.y(), minusOne);
  painter.drawText(QRect(square.right() + 3, middle.y() - line, 2 * line, 2 * line),
    Qt::AlignLeft | Qt::AlignVCenter, QString::fromUtf8("k ε\u1D64\n= 1"));
}

//------------------------------------------------------------------------------
void pqPictureView::dab(const QPointF& at)
{
  const QPointF inside = at - QPointF(this->Margin, this->Margin);
  const double width = this->Picture.width(), height = this->Picture.height();
  QPainter painter(&this->Picture);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(Qt::NoPen);
  painter.setBrush(this->Brush);
  painter.drawEllipse(QPointF(inside.x() / shownSide * width, inside.y() / shownSide * height),
    brushRadius * width, brushRadius * height);
  painter.end();
  this->setPicture(this->Picture);
}

//------------------------------------------------------------------------------
void pqPictureView::mousePressEvent(QMouseEvent* event)
{
  if (this->IsColorFilter && event->button() == Qt::LeftButton)
  {
    this->dab(event->localPos());
  }
}

//------------------------------------------------------------------------------
void pqPictureView::mouseMoveEvent(QMouseEvent* event)
{
  if (this->IsColorFilter && event->buttons() & Qt::LeftButton)
  {
    this->dab(event->localPos());
  }
}

//------------------------------------------------------------------------------
void pqPictureView::mouseReleaseEvent(QMouseEvent* event)
{
  if (this->IsColorFilter && event->button() == Qt::LeftButton)
  {
    Q_EMIT this->painted();
  }
}
