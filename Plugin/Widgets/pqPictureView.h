// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QColor>
#include <QImage>
#include <QWidget>

/// A small view of a picture. A colour filter is drawn as a square with the axes k eps_u and k eps_v from
/// -1 to 1, and can be painted on with the mouse.
class pqPictureView : public QWidget
{
  Q_OBJECT

public:
  explicit pqPictureView(bool isColorFilter, QWidget* parent = nullptr);

  bool isColorFilter() const { return this->IsColorFilter; }

  /// A null image leaves the view empty, or with the wheel that a colour filter without a picture is.
  void setPicture(const QImage& picture);
  const QImage& picture() const { return this->Picture; }

public Q_SLOTS:
  void setBrush(const QColor& color) { this->Brush = color; }

Q_SIGNALS:
  /// A stroke has ended.
  void painted();

protected:
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;

private:
  QRect place() const;
  void dab(const QPointF& at);
  void drawAxes(QPainter& painter) const;

  const bool IsColorFilter;
  const int Margin;
  QColor Brush = Qt::black;
  QImage Picture;
  QImage Shown;
};
