// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pqCutoffLight.h"

#include <QImage>
#include <QVector>
#include <QWidget>

/// A small view of an image. A colour filter is a square with axes k eps_u and k eps_v from -1 to 1
/// and the light on it, and signals strokes of the mouse's or the keyboard's brush.
class pqImageView : public QWidget
{
  Q_OBJECT

public:
  explicit pqImageView(bool isColorFilter, QWidget* parent = nullptr);
  ~pqImageView() override;

  bool isColorFilter() const { return this->IsColorFilter; }

  /// Sets an image; null: an empty view, or the colour wheel of a colour filter.
  void setImage(const QImage& image);

  /// Sets the light to draw on a colour filter, and k.
  void setLight(const pqCutoffLight& light, double k);

public Q_SLOTS:
  /// Sets the radius as a fraction of the filter's side.
  void setBrushRadius(double radius);

Q_SIGNALS:
  void strokeBegan();
  /// Sends points of a stroke, each coordinate from -1 to 1, v upwards.
  void brushed(const QVector<QPointF>& places);
  void strokeEnded();

protected:
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  void leaveEvent(QEvent* event) override;
  void focusInEvent(QFocusEvent* event) override;
  void focusOutEvent(QFocusEvent* event) override;

private:
  QRect place() const;
  QPointF placeAt(const QPointF& pixel) const;
  QPointF pixelAt(const QPointF& place) const;
  QImage shown() const;
  void drawAxes(QPainter& painter) const;
  void drawBrush(QPainter& painter) const;

  const bool IsColorFilter;
  const int Margin;
  QImage Image;
  mutable QImage Shown; ///< null: outdated
  pqCutoffLight Light;
  double K = 0;
  double BrushRadius = 0.04;
  QPointF Brush; ///< its position
  bool IsBrushShown = false, IsDown = false;
};
