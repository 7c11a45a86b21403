// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// What the mouse and keys do on the cutoff plane.
#include "pqCutoffView.h"

#include "MousePlace.h"

#include <QKeyEvent>
#include <QMouseEvent>
#include <QWheelEvent>

#include <cmath>

namespace
{

constexpr double edgeStep = 0.01;        // of the range, per key
constexpr double turnStep = 1;           // degrees, per key
constexpr double sensitivityStep = 1.02; // per key

} // namespace

void pqCutoffView::grab(pqCutoffPlane::Handle handle)
{
  this->Before = this->Cutoff;
  this->Grabbed = handle;
  Q_EMIT this->grabbed();
}

void pqCutoffView::moveTo(const pqCutoff& cutoff)
{
  this->Cutoff = cutoff;
  this->changed();
  Q_EMIT this->dragged();
}

void pqCutoffView::release(bool keep)
{
  if (this->isGrabbed())
  {
    this->Grabbed = pqCutoffPlane::NoHandle;
    this->ByKeys = false;
    if (!keep)
    {
      this->Cutoff = this->Before;
    }
    Q_EMIT this->released(keep);
    this->fit();
  }
}

void pqCutoffView::mousePressEvent(QMouseEvent* event)
{
  if (event->button() != Qt::LeftButton || this->isGrabbed())
  {
    return;
  }
  const pqCutoffPlane::Handle handle = this->plane().handleAt(this->Cutoff, mousePlace(event));
  if (handle != pqCutoffPlane::NoHandle)
  {
    this->GrabbedAt = this->LastPlace = mousePlace(event);
    this->grab(handle);
  }
}

void pqCutoffView::mouseMoveEvent(QMouseEvent* event)
{
  if (this->isGrabbed() && !this->ByKeys)
  {
    this->follow(event);
    return;
  }
  const pqCutoffPlane::Handle handle = this->plane().handleAt(this->Cutoff, mousePlace(event));
  if (handle != this->Hovered)
  {
    this->Hovered = handle;
    this->setCursor(handle == pqCutoffPlane::NoHandle ? Qt::ArrowCursor : Qt::OpenHandCursor);
    this->update();
  }
}

void pqCutoffView::follow(QMouseEvent* event)
{
  this->LastPlace = mousePlace(event);
  this->moveTo(this->plane().dragged(this->Before, this->Grabbed, this->GrabbedAt, this->LastPlace,
    event->modifiers() & Qt::ShiftModifier));
}

void pqCutoffView::mouseReleaseEvent(QMouseEvent* event)
{
  if (event->button() == Qt::LeftButton && !this->ByKeys)
  {
    // A quick drag ends beyond the last move.
    if (this->isGrabbed() && mousePlace(event) != this->LastPlace)
    {
      this->follow(event);
    }
    this->release(true);
  }
}

void pqCutoffView::mouseDoubleClickEvent(QMouseEvent* event)
{
  if (event->button() == Qt::LeftButton)
  {
    this->IsZoomed = false;
    this->fit();
  }
}

void pqCutoffView::wheelEvent(QWheelEvent* event)
{
  // Leaves the wheel to the panel, which could not be scrolled otherwise.
  if (!this->hasFocus() || event->angleDelta().y() == 0)
  {
    event->ignore();
    return;
  }
  if (!this->isGrabbed())
  {
    this->zoom(event->angleDelta().y() > 0 ? 1 : -1);
  }
  event->accept();
}

void pqCutoffView::keyPressEvent(QKeyEvent* event)
{
  const bool isAlone = !this->isGrabbed();
  switch (event->key())
  {
    case Qt::Key_Plus:
      this->zoom(isAlone ? 1 : 0);
      return;
    case Qt::Key_Minus:
      this->zoom(isAlone ? -1 : 0);
      return;
    case Qt::Key_Home:
      this->IsZoomed = false;
      this->fit();
      return;
    case Qt::Key_Escape:
      if (isAlone)
      {
        break;
      }
      this->release(false);
      return;
    default:
      break;
  }
  using Plane = pqCutoffPlane;
  const bool right = event->key() == Qt::Key_Right, up = event->key() == Qt::Key_Up;
  const bool moves = right || event->key() == Qt::Key_Left;
  const bool scales = up || event->key() == Qt::Key_Down;
  if (!(this->Cutoff.K > 0) || this->Cutoff.Kind == pqCutoff::NoCutoff ||
    !(scales || (moves && this->Cutoff.HasEdge)) || (this->isGrabbed() && !this->ByKeys))
  {
    QWidget::keyPressEvent(event);
    return;
  }
  const bool turns = moves && event->modifiers() & Qt::ShiftModifier;
  const Plane::Handle handle = turns ? Plane::TurnHandle
    : moves                          ? Plane::EdgeLine
    : this->Cutoff.HasEdge           ? Plane::BrightLine
                                     : Plane::SizeHandle;
  if (this->ByKeys && this->Grabbed != handle)
  {
    this->release(true);
  }
  if (!this->ByKeys)
  {
    this->ByKeys = true;
    this->grab(handle);
  }
  pqCutoff cutoff = this->Cutoff;
  if (turns)
  {
    cutoff.Angle = std::fmod(cutoff.Angle + (right ? 360 - turnStep : turnStep), 360);
  }
  else if (moves)
  {
    const double shift = (right ? 1 : -1) * edgeStep * this->Range;
    cutoff.Offset = rounded(cutoff.Offset + cutoff.K * shift, 3);
  }
  else
  {
    cutoff.K = rounded(cutoff.K * (up ? sensitivityStep : 1 / sensitivityStep), 4);
  }
  this->moveTo(cutoff);
}

void pqCutoffView::keyReleaseEvent(QKeyEvent* event)
{
  if (this->ByKeys && !event->isAutoRepeat())
  {
    this->release(true);
  }
}

void pqCutoffView::focusOutEvent(QFocusEvent* event)
{
  if (this->ByKeys)
  {
    this->release(true);
  }
  QWidget::focusOutEvent(event);
}

bool pqCutoffView::event(QEvent* event)
{
  // Overrides the window's shortcut Escape.
  if (event->type() == QEvent::ShortcutOverride && this->isGrabbed())
  {
    event->accept();
    return true;
  }
  if (event->type() == QEvent::Leave)
  {
    this->Hovered = pqCutoffPlane::NoHandle;
    this->update();
  }
  return QWidget::event(event);
}
