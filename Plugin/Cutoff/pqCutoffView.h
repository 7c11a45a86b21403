// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pqCutoffLight.h"
#include "pqCutoffPlane.h"

#include <QImage>
#include <QWidget>

/// Draws the cutoff plane with the light, before and behind the cutoff. Mouse and keys change the
/// cutoff's edge, scale and angle.
class pqCutoffView : public QWidget
{
  Q_OBJECT
  Q_PROPERTY(double range READ range)
  Q_PROPERTY(double side READ side)

public:
  explicit pqCutoffView(QWidget* parent = nullptr);
  ~pqCutoffView() override;

  /// `image`: of a colour filter; null: the wheel.
  void setCutoff(const pqCutoff& cutoff, const QImage& image);
  const pqCutoff& cutoff() const { return this->Cutoff; }
  void setLight(const pqCutoffLight& light);

  /// Whether a handle is dragged, from grabbed() to released().
  bool isGrabbed() const { return this->Grabbed != pqCutoffPlane::NoHandle; }
  const pqCutoff& before() const { return this->Before; }
  pqCutoffPlane::Handle handle() const { return this->Grabbed; }

  /// Returns the largest deflection shown along both axes, radians.
  double range() const { return this->Range; }
  /// Returns the drawn square, pixels of the widget.
  QRectF square() const;
  double side() const { return this->square().width(); }

  QSize sizeHint() const override;
  bool hasHeightForWidth() const override { return true; }
  int heightForWidth(int width) const override;

Q_SIGNALS:
  void grabbed();
  void dragged();
  /// The new cutoff is kept or, if not `keep`, the old one was restored.
  void released(bool keep);

protected:
  bool event(QEvent* event) override;
  void paintEvent(QPaintEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  void keyReleaseEvent(QKeyEvent* event) override;
  void focusOutEvent(QFocusEvent* event) override;

private:
  pqCutoffPlane plane() const;
  void grab(pqCutoffPlane::Handle handle);
  void moveTo(const pqCutoff& cutoff);
  void follow(QMouseEvent* event);
  void release(bool keep);
  void zoom(int steps);
  void fit();
  void changed();
  QImage composed() const;
  void drawLines(QPainter& painter) const;
  void drawAxes(QPainter& painter) const;

  pqCutoff Cutoff, Before;
  QImage Image; ///< of a colour filter
  pqCutoffLight Light;
  double Range = 1e-3;
  bool IsZoomed = false; ///< by the user
  pqCutoffPlane::Handle Hovered = pqCutoffPlane::NoHandle, Grabbed = pqCutoffPlane::NoHandle;
  QPointF GrabbedAt;
  QPointF LastPlace; ///< of the mouse in a drag
  bool ByKeys = false;
  mutable QImage Composed; ///< null: outdated
};
