// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "pqImageView.h"

#include "MousePlace.h"
#include "pqColorFilterImage.h"

#include <QFontMetrics>
#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>

#include <algorithm>
#include <cmath>

namespace
{

constexpr int imageSide = 128, filterSide = 192; // pixels
constexpr double keyStep = 1. / 64;              // of the filter's side
constexpr int largeStep = 8;                     // times a step

} // namespace

pqImageView::pqImageView(bool isColorFilter, QWidget* parentObject)
  : QWidget(parentObject)
  , IsColorFilter(isColorFilter)
  , Margin(isColorFilter ? this->fontMetrics().height() : 0)
{
  if (isColorFilter)
  {
    this->setFixedSize(filterSide + 3 * this->Margin, filterSide + 2 * this->Margin);
    this->setMouseTracking(true);
    this->setFocusPolicy(Qt::StrongFocus);
    this->setAccessibleName(tr("Colour filter"));
    const QString help = tr(
      "Which colour light has that is deflected there; grey is where no light is.\n"
      "Paint with the mouse; or move the brush with the arrow keys, further with Shift, and paint "
      "with Space.");
    this->setToolTip(help);
    this->setAccessibleDescription(help);
  }
}

pqImageView::~pqImageView() = default;

QRect pqImageView::place() const
{
  return this->IsColorFilter ? QRect(this->Margin, this->Margin, filterSide, filterSide)
                             : this->rect();
}

QPointF pqImageView::placeAt(const QPointF& pixel) const
{
  const QPointF inside = (pixel - this->place().topLeft()) / (filterSide / 2.);
  return { inside.x() - 1, 1 - inside.y() };
}

QPointF pqImageView::pixelAt(const QPointF& place) const
{
  return this->place().topLeft() + QPointF(1 + place.x(), 1 - place.y()) * (filterSide / 2.);
}

void pqImageView::setImage(const QImage& image)
{
  this->Image = image;
  this->Shown = QImage();
  if (!this->IsColorFilter)
  {
    this->setFixedSize(image.isNull()
        ? QSize(1, 1)
        : image.size().scaled(imageSide, imageSide, Qt::KeepAspectRatio));
  }
  this->update();
}

void pqImageView::setLight(const pqCutoffLight& light, double k)
{
  this->Light = light;
  this->K = k;
  this->Shown = QImage();
  this->update();
}

void pqImageView::setBrushRadius(double radius)
{
  this->BrushRadius = radius;
  this->update();
}

QImage pqImageView::shown() const
{
  const double ratio = this->devicePixelRatioF();
  const QSize size = (QSizeF(this->place().size()) * ratio).toSize();
  if (!this->IsColorFilter)
  {
    return this->Image.scaled(size, Qt::IgnoreAspectRatio, Qt::SmoothTransformation);
  }
  QImage image = pqColorFilterImage::paintable(this->Image)
                   .scaled(size, Qt::IgnoreAspectRatio, Qt::SmoothTransformation);
  if (!this->Light.isEmpty() && this->K > 0)
  {
    for (int row = 0; row < size.height(); ++row)
    {
      auto* line = reinterpret_cast<QRgb*>(image.scanLine(row));
      for (int column = 0; column < size.width(); ++column)
      {
        const QPointF place(
          2 * (column + 0.5) / size.width() - 1, 1 - 2 * (row + 0.5) / size.height());
        line[column] =
          pqColorFilterImage::lit(line[column], this->Light.brightnessAt(place / this->K));
      }
    }
  }
  return image;
}

void pqImageView::paintEvent(QPaintEvent*)
{
  QPainter painter(this);
  const double ratio = this->devicePixelRatioF();
  if (this->IsColorFilter || !this->Image.isNull())
  {
    if (this->Shown.isNull() || this->Shown.devicePixelRatioF() != ratio)
    {
      this->Shown = this->shown();
      this->Shown.setDevicePixelRatio(ratio);
    }
    painter.drawImage(this->place().topLeft(), this->Shown);
  }
  if (this->IsColorFilter)
  {
    this->drawAxes(painter);
    this->drawBrush(painter);
  }
}

void pqImageView::drawAxes(QPainter& painter) const
{
  const QRect square = this->place();
  const QPoint middle = square.center();
  painter.setPen(QPen(QColor(0, 0, 0, 128), 1, Qt::DashLine));
  painter.drawLine(square.left(), middle.y(), square.right(), middle.y());
  painter.drawLine(middle.x(), square.top(), middle.x(), square.bottom());
  if (this->hasFocus())
  {
    painter.setPen(QPen(this->palette().color(QPalette::Highlight), 2));
    painter.drawRect(square.adjusted(-1, -1, 1, 1));
  }

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

void pqImageView::drawBrush(QPainter& painter) const
{
  if (this->IsBrushShown)
  {
    painter.setRenderHint(QPainter::Antialiasing);
    const double radius = this->BrushRadius * filterSide;
    for (const QColor& color : { Qt::black, Qt::white }) // visible on any colour
    {
      painter.setPen(QPen(color, color == Qt::black ? 3 : 1));
      painter.drawEllipse(this->pixelAt(this->Brush), radius, radius);
    }
  }
}

void pqImageView::mousePressEvent(QMouseEvent* event)
{
  if (this->IsColorFilter && event->button() == Qt::LeftButton)
  {
    this->Brush = this->placeAt(mousePlace(event));
    this->IsDown = true;
    Q_EMIT this->strokeBegan();
    Q_EMIT this->brushed({ this->Brush });
  }
}

void pqImageView::mouseMoveEvent(QMouseEvent* event)
{
  if (this->IsColorFilter)
  {
    const QPointF before = this->Brush;
    this->Brush = this->placeAt(mousePlace(event));
    this->IsBrushShown = true;
    if (this->IsDown)
    {
      Q_EMIT this->brushed(pqColorFilterImage::stroke(before, this->Brush, this->BrushRadius));
    }
    this->update();
  }
}

void pqImageView::mouseReleaseEvent(QMouseEvent* event)
{
  if (this->IsDown && event->button() == Qt::LeftButton)
  {
    this->IsDown = false;
    Q_EMIT this->strokeEnded();
  }
}

void pqImageView::keyPressEvent(QKeyEvent* event)
{
  QPointF direction;
  switch (event->key())
  {
    case Qt::Key_Left:
      direction = { -1, 0 };
      break;
    case Qt::Key_Right:
      direction = { 1, 0 };
      break;
    case Qt::Key_Up:
      direction = { 0, 1 };
      break;
    case Qt::Key_Down:
      direction = { 0, -1 };
      break;
    case Qt::Key_Space:
      break;
    default:
      QWidget::keyPressEvent(event);
      return;
  }
  if (!this->IsColorFilter || this->IsDown)
  {
    return;
  }
  if (direction.isNull())
  {
    Q_EMIT this->strokeBegan();
    Q_EMIT this->brushed({ this->Brush });
    Q_EMIT this->strokeEnded();
    return;
  }
  const int steps = event->modifiers() & Qt::ShiftModifier ? largeStep : 1;
  const QPointF to = this->Brush + direction * (2 * keyStep * steps);
  this->Brush = { qBound(-1., to.x(), 1.), qBound(-1., to.y(), 1.) };
  this->IsBrushShown = true;
  this->update();
}

void pqImageView::leaveEvent(QEvent* event)
{
  this->IsBrushShown = this->hasFocus();
  this->update();
  QWidget::leaveEvent(event);
}

void pqImageView::focusInEvent(QFocusEvent* event)
{
  this->IsBrushShown = true;
  QWidget::focusInEvent(event);
}

void pqImageView::focusOutEvent(QFocusEvent* event)
{
  this->IsBrushShown = false;
  QWidget::focusOutEvent(event);
}
