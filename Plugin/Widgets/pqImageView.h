// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pqCutoffLight.h"

#include <QImage>
#include <QVector>
#include <QWidget>

/// A small view of an image. A colour filter is drawn as a square with the axes k eps_u and k eps_v from
/// -1 to 1, with the light on it, and signals where a brush paints: the mouse's, or that of the keyboard.
class pqImageView : public QWidget
{
  Q_OBJECT

public:
  explicit pqImageView(bool isColorFilter, QWidget* parent = nullptr);
  ~pqImageView() override;

  bool isColorFilter() const { return this->IsColorFilter; }

  /// A null image leaves the view empty, or with the wheel that a colour filter without an image is.
  void setImage(const QImage& image);

  /// Of a colour filter: the light to be drawn on it, and k.
  void setLight(const pqCutoffLight& light, double k);

public Q_SLOTS:
  /// As a fraction of the filter's side.
  void setBrushRadius(double radius);

Q_SIGNALS:
  void strokeBegan();
  /// The brush has been at these places, each coordinate from -1 to 1, v upwards.
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
  mutable QImage Shown; ///< null: has to be made again
  pqCutoffLight Light;
  double K = 0;
  double BrushRadius = 0.04;
  QPointF Brush; ///< where it is
  bool IsBrushShown = false, IsDown = false;
};
