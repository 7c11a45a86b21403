// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef MousePlace_h
#define MousePlace_h

#include <QMouseEvent>

/// Returns the mouse position, pixels: Qt 6 deprecates the only name that Qt 5 has for it.
inline QPointF mousePlace(const QMouseEvent* event)
{
#if QT_VERSION < QT_VERSION_CHECK(6, 0, 0)
  return event->localPos();
#else
  return event->position();
#endif
}

#endif
