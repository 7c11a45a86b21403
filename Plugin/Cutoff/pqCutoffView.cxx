// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "pqCutoffView.h"

#include "NumberText.h"
#include "pqColorFilterImage.h"

#include <QFontMetrics>
#include <QPainter>

#include <algorithm>
#include <cmath>

namespace
{

constexpr int smallestSide = 120, largestSide = 360, sideStep = 20; // pixels
constexpr double marginOfScale = 1.3;                               // around full scale
constexpr double marginOfLight = 1.1;
constexpr double leastRange = 1e-12; // radians, minimum that can be shown

const QColor lineColor(255, 160, 0);
constexpr int knife[] = { 40, 90, 160 }; // colour of a stop
constexpr double knifeOpacity = 0.75;

int blend(double a, double b, double fraction)
{
  return static_cast<int>(std::lround(a + fraction * (b - a)));
}

} // namespace

pqCutoffView::pqCutoffView(QWidget* parentObject)
  : QWidget(parentObject)
{
  this->setMouseTracking(true);
  this->setFocusPolicy(Qt::StrongFocus);
  QSizePolicy policy(QSizePolicy::Expanding, QSizePolicy::Preferred);
  policy.setHeightForWidth(true);
  this->setSizePolicy(policy);
  this->setMinimumWidth(smallestSide);
  this->setAccessibleName(tr("Cutoff plane"));
  const QString help = tr(
    "The light on the cutoff plane: how far it is deflected to the right and up. Blue is where the "
    "cutoff stops it.\nDrag the edge, the dashed lines of full scale, or the round handle that "
    "turns "
    "it (Shift: multiples of 15 degrees). Escape cancels.\nKeys: Left and Right move the edge, "
    "with "
    "Shift they turn it; Up and Down change the sensitivity k; + and - zoom, Home shows all.\n"
    "The wheel zooms once the plane has been clicked; a double click shows all.");
  this->setToolTip(help);
  this->setAccessibleDescription(help);
}

pqCutoffView::~pqCutoffView() = default;

QRectF pqCutoffView::square() const
{
  const int line = this->fontMetrics().height();
  const int room = std::min({ this->width() - line - 4, this->height() - line - 4, largestSide });
  const int side = room - room % sideStep;
  return { line + 2., 2., static_cast<double>(side), static_cast<double>(side) };
}

int pqCutoffView::heightForWidth(int width) const
{
  return std::min(width, largestSide + this->fontMetrics().height() + 4);
}

QSize pqCutoffView::sizeHint() const
{
  constexpr int usual = 250;
  return { usual, this->heightForWidth(usual) };
}

pqCutoffPlane pqCutoffView::plane() const { return { this->square(), this->Range }; }

void pqCutoffView::setCutoff(const pqCutoff& cutoff, const QImage& image)
{
  this->Cutoff = cutoff;
  this->Image = image;
  this->fit();
}

void pqCutoffView::setLight(const pqCutoffLight& light)
{
  this->Light = light;
  this->fit();
}

void pqCutoffView::fit()
{
  // Keeps the scale while a handle is dragged.
  if (!this->IsZoomed && !this->isGrabbed())
  {
    double range = marginOfLight * this->Light.extent();
    if (this->Cutoff.Kind != pqCutoff::NoCutoff && this->Cutoff.K > 0)
    {
      const double scale = this->Cutoff.HasEdge
        ? std::max(std::abs(this->Cutoff.deflectionOf(0)), std::abs(this->Cutoff.deflectionOf(1)))
        : 1 / this->Cutoff.K;
      range = std::max(range, marginOfScale * scale);
    }
    if (range > leastRange && std::isfinite(range))
    {
      this->Range = pqCutoffPlane::roundRange(range, 0);
    }
  }
  this->changed();
}

void pqCutoffView::changed()
{
  this->Composed = QImage();
  this->update();
}

void pqCutoffView::zoom(int steps)
{
  this->Range = std::max(leastRange, pqCutoffPlane::roundRange(this->Range, -steps));
  this->IsZoomed = true;
  this->changed();
}

QImage pqCutoffView::composed() const
{
  const double ratio = this->devicePixelRatioF();
  const QRectF square = this->square();
  const int side = static_cast<int>(std::lround(square.width() * ratio));
  const pqCutoffPlane plane(
    { 0, 0, static_cast<double>(side), static_cast<double>(side) }, this->Range);
  QImage image(side, side, QImage::Format_RGB32);
  for (int row = 0; row < side; ++row)
  {
    auto* line = reinterpret_cast<QRgb*>(image.scanLine(row));
    for (int column = 0; column < side; ++column)
    {
      const QPointF deflection = plane.deflectionAt({ column + 0.5, row + 0.5 });
      const double light = this->Light.brightnessAt(deflection);
      if (this->Cutoff.Kind == pqCutoff::ColorFilter)
      {
        line[column] = pqColorFilterImage::lit(
          pqColorFilterImage::colorAt(this->Image, this->Cutoff.K * deflection), light);
      }
      else
      {
        const double grey = light > 0 ? 60 + 195 * light : 0; // sRGB: perceptually even steps
        const double stopped = knifeOpacity * (1 - this->Cutoff.transmission(deflection));
        line[column] = qRgb(blend(grey, knife[0], stopped), blend(grey, knife[1], stopped),
          blend(grey, knife[2], stopped));
      }
    }
  }
  image.setDevicePixelRatio(ratio);
  return image;
}

void pqCutoffView::paintEvent(QPaintEvent*)
{
  QPainter painter(this);
  const QRectF square = this->square();
  if (square.width() < 1)
  {
    return;
  }
  if (!this->isEnabled())
  {
    painter.fillRect(square, this->palette().brush(QPalette::Window));
  }
  else
  {
    if (this->Composed.isNull() || this->Composed.devicePixelRatioF() != this->devicePixelRatioF())
    {
      this->Composed = this->composed();
    }
    painter.drawImage(square.topLeft(), this->Composed);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.save();
    painter.setClipRect(square);
    this->drawLines(painter);
    painter.restore();
  }
  this->drawAxes(painter);
}

void pqCutoffView::drawLines(QPainter& painter) const
{
  const pqCutoffPlane plane = this->plane();
  const QPointF centre = plane.pixelAt({ 0, 0 });
  painter.setPen(QPen(QColor(255, 255, 255, 90), 1));
  const double half = this->square().width() / 2;
  painter.drawLine(centre - QPointF(half, 0), centre + QPointF(half, 0));
  painter.drawLine(centre - QPointF(0, half), centre + QPointF(0, half));
  if (this->Cutoff.Kind == pqCutoff::NoCutoff || !(this->Cutoff.K > 0))
  {
    return;
  }
  const pqCutoffPlane::Handle lit = this->isGrabbed() ? this->Grabbed : this->Hovered;
  const auto setPen = [&](pqCutoffPlane::Handle handle, Qt::PenStyle style)
  { painter.setPen(QPen(lineColor, handle == lit ? 3 : 1.6, style)); };
  painter.setBrush(Qt::NoBrush);
  if (!this->Cutoff.HasEdge)
  {
    const double size = 1 / this->Cutoff.K / plane.deflectionPerPixel();
    const QRectF box(centre - QPointF(size, size), QSizeF(2 * size, 2 * size));
    setPen(pqCutoffPlane::SizeHandle, Qt::SolidLine);
    this->Cutoff.IsSquare ? painter.drawRect(box) : painter.drawEllipse(box);
    return;
  }
  const QPointF normal = this->Cutoff.normal();
  const QPointF along(-normal.y(), normal.x());
  const auto draw = [&](pqCutoffPlane::Handle handle, double place, const QString& name)
  {
    setPen(handle, handle == pqCutoffPlane::EdgeLine ? Qt::SolidLine : Qt::DashLine);
    const QPointF deflection = this->Cutoff.deflectionOf(place) * normal;
    const double length = 2 * this->Range;
    painter.drawLine(
      plane.pixelAt(deflection - length * along), plane.pixelAt(deflection + length * along));
    const QPointF at = plane.pixelAt(deflection - 0.75 * this->Range * along);
    const QRectF label(at - QPointF(20, 10), QSizeF(40, 20));
    painter.setPen(Qt::white);
    painter.drawText(label.translated(8, 0), Qt::AlignCenter, name);
  };
  draw(pqCutoffPlane::DarkLine, 0, "0");
  draw(pqCutoffPlane::BrightLine, 1, "1");
  draw(pqCutoffPlane::EdgeLine, 0.5, QString::fromUtf8("½"));

  setPen(pqCutoffPlane::TurnHandle, Qt::DotLine);
  painter.drawLine(centre, plane.turnHandle(this->Cutoff));
  setPen(pqCutoffPlane::TurnHandle, Qt::SolidLine);
  painter.setBrush(Qt::black);
  painter.drawEllipse(plane.turnHandle(this->Cutoff), 5, 5);
}

void pqCutoffView::drawAxes(QPainter& painter) const
{
  const QRectF square = this->square();
  painter.setBrush(Qt::NoBrush);
  const bool hasFocus = this->hasFocus();
  painter.setPen(
    QPen(this->palette().color(hasFocus ? QPalette::Highlight : QPalette::Mid), hasFocus ? 2 : 1));
  painter.drawRect(square.adjusted(-1, -1, 1, 1));
  painter.setPen(this->palette().color(QPalette::WindowText));
  if (!this->isEnabled())
  {
    painter.drawText(square.adjusted(8, 8, -8, -8), Qt::AlignCenter | Qt::TextWordWrap,
      tr("The light on the cutoff plane is known with the image."));
    return;
  }
  const UnitPrefix prefix = unitPrefixOf(this->Range);
  const QString end = QString::number(this->Range / prefix.factor);
  const QString minus = QString::fromUtf8("\u2212") + end;
  const int line = this->fontMetrics().height();
  const QRectF below(square.left(), square.bottom() + 2, square.width(), line);
  const auto write = [&](const QRectF& row, const QString& axis)
  {
    painter.drawText(row, Qt::AlignLeft | Qt::AlignVCenter, minus);
    painter.drawText(row, Qt::AlignRight | Qt::AlignVCenter, end);
    painter.drawText(
      row, Qt::AlignCenter, QString("%1, %2rad").arg(axis, QString::fromUtf8(prefix.name)));
  };
  write(below, QString::fromUtf8("ε\u1D64"));
  painter.save();
  painter.translate(square.left() - 2, square.bottom());
  painter.rotate(-90);
  write(QRectF(0, -line, square.height(), line), QString::fromUtf8("ε\u1D65"));
  painter.restore();
}

void pqCutoffView::resizeEvent(QResizeEvent*) { this->changed(); }
